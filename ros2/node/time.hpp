// ROS time: nanoseconds since 1970, or what /clock says.
#pragma once

#include <chrono>
#include <cstdint>
#include <ros2_messages/builtin_interfaces/Time.hpp>

namespace ros2 {

using Nanoseconds = std::int64_t;
constexpr Nanoseconds kSecond = 1'000'000'000;

[[nodiscard]] constexpr Nanoseconds nanoseconds_of(double seconds) {
  return static_cast<Nanoseconds>(seconds * 1e9);
}
[[nodiscard]] inline Nanoseconds nanoseconds_of(const builtin_interfaces::Time& time) {
  return time.sec * kSecond + time.nanosec;
}
/// Whole seconds towards the past; the ends of its range for what lies beyond.
[[nodiscard]] inline builtin_interfaces::Time time_of(Nanoseconds time) {
  Nanoseconds seconds = time / kSecond - (time % kSecond < 0 ? 1 : 0);
  const Nanoseconds rest = time - seconds * kSecond;
  if (seconds > INT32_MAX) seconds = INT32_MAX;
  if (seconds < INT32_MIN) seconds = INT32_MIN;
  builtin_interfaces::Time result;
  result.sec = static_cast<std::int32_t>(seconds);
  result.nanosec = static_cast<std::uint32_t>(rest);
  return result;
}

/// The clock of a node. With simulated time it stands where it was set last, first at 0.
class Clock {
 public:
  [[nodiscard]] Nanoseconds now() const { return simulated_ ? time_ : wall(); }
  [[nodiscard]] builtin_interfaces::Time stamp() const { return time_of(now()); }
  [[nodiscard]] bool simulated() const { return simulated_; }
  void set_simulated(bool simulated) { simulated_ = simulated; }
  void set(Nanoseconds time) { time_ = time; }

  [[nodiscard]] static Nanoseconds wall() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
  }

 private:
  bool simulated_ = false;
  Nanoseconds time_ = 0;
};

}  // namespace ros2
