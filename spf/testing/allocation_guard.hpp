// Counts heap allocations in a scope, to prove that a hot loop makes none, and the bytes that are held, to
// prove that a thing stays within bounds. Programs that link spf_testing get counting versions of operator
// new (all forms) and, by the linker's --wrap, of malloc and its relatives, which Eigen calls directly. Both
// work under the sanitizers. Allocations made inside shared libraries are not seen.
#pragma once

namespace spf {

/// Counts the allocations of the calling thread.
class AllocationGuard {
 public:
  AllocationGuard();
  AllocationGuard(const AllocationGuard&) = delete;
  AllocationGuard& operator=(const AllocationGuard&) = delete;
  ~AllocationGuard() = default;

  /// Allocations of this thread since the guard was made.
  [[nodiscard]] long allocations() const;
  /// What this thread has allocated since then, less what it has freed [byte], as the allocator rounds it.
  [[nodiscard]] long bytes() const;

 private:
  long allocations_before_;
  long bytes_before_;
};

}  // namespace spf
