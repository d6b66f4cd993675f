// Runs that last: without the interpreter's lock, and ended by Ctrl-C.
#pragma once

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>

#include "python/bind.hpp"

namespace spf::python {

/// Seconds of a steady clock, for timings of computing alone.
[[nodiscard]] inline double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Asked often while a run goes on. A signal (Ctrl-C) or an exception of a callback ends it, and is raised
/// when it has ended.
class Interruption {
 public:
  /// On any thread, without the lock. Signals are seen on Python's main thread alone, which works as well.
  [[nodiscard]] bool wanted() {
    if (wanted_) return true;
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) keep_error();
    return wanted_;
  }
  /// With the lock, after Python has set an error.
  void keep_error() {
    if (!wanted_.exchange(true)) {
      PyErr_Fetch(&type_, &value_, &trace_);
    } else {
      PyErr_Clear();
    }
  }
  /// With the lock, at the end.
  void raise_if_wanted() {
    if (!wanted_) return;
    PyErr_Restore(type_, value_, trace_);
    throw py::error_already_set{};
  }

 private:
  std::atomic<bool> wanted_{false};
  PyObject* type_ = nullptr;
  PyObject* value_ = nullptr;
  PyObject* trace_ = nullptr;
};

/// Runs without the lock, and raises what has ended the run. Ctrl-C while a method in Python planned is told
/// as that method's failure, and is still waiting here (methods.cpp).
template <class Run>
void run_unlocked(Interruption& interruption, const Run& run) {
  try {
    const py::gil_scoped_release release;
    run();
  } catch (const std::runtime_error&) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set{};
    throw;
  }
  interruption.raise_if_wanted();
}

/// A whole number within limits. Throws by refuse().
[[nodiscard]] inline int whole_number(const py::object& value, const char* key, int low, int high) {
  const py::object index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  PyErr_Clear();
  int overflow = 0;
  const long number = index ? PyLong_AsLongAndOverflow(index.ptr(), &overflow) : 0;
  if (!index || overflow != 0 || number < low || number > high)
    refuse(key, value,
           "must be a whole number in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
  return static_cast<int>(number);
}
inline constexpr int kMostJobs = 1024;
inline constexpr int kLastTrial = 1'000'000'000;

}  // namespace spf::python
