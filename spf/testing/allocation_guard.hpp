// Counts heap allocations in a scope, to prove that a hot loop makes none. Programs that link spf_testing get
// counting versions of operator new (all forms) and, by the linker's --wrap, of malloc and its relatives,
// which Eigen calls directly. Both work under the sanitizers. Allocations made inside shared libraries are
// not seen.
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

 private:
  long before_;
};

}  // namespace spf
