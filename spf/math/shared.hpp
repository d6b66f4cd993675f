// An immutable value with many owners.
#pragma once

#include <memory>
#include <utility>

namespace spf {

/// Reads like a `const T`; copying it shares the one T in memory. A robot's broadcast reaches a hundred
/// others, each of which would otherwise keep kilobytes of the same numbers. Making one from a T allocates;
/// copies may be held and read on different threads.
template <class T>
class Shared {
 public:
  Shared(T value)  // NOLINT(google-explicit-constructor): a Shared<T> is used like a T
      : value_{std::make_shared<const T>(std::move(value))} {}
  /// A part of a shared whole; the whole lives as long as any part of it is held.
  template <class Whole>
  Shared(const Shared<Whole>& whole, const T& part) : value_{whole.value_, &part} {}

  [[nodiscard]] const T& operator*() const { return *value_; }
  [[nodiscard]] const T* operator->() const { return value_.get(); }
  operator const T&() const {  // NOLINT(google-explicit-constructor): as above
    return *value_;
  }

 private:
  template <class Other>
  friend class Shared;
  std::shared_ptr<const T> value_;  // never null, unless moved from
};

}  // namespace spf
