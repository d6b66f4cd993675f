// Between ROS time and the hosts' seconds since an epoch, which keep nanoseconds in a double for months.
#pragma once

#include <cmath>

#include "ros2/node/time.hpp"

namespace spf_ros2 {

class ClockEdge {
 public:
  /// The epoch is the whole second of `start`.
  explicit ClockEdge(ros2::Nanoseconds start) : epoch_{start / ros2::kSecond * ros2::kSecond} {}

  [[nodiscard]] double seconds(ros2::Nanoseconds time) const {
    const ros2::Nanoseconds since = time - epoch_;
    return static_cast<double>(since / ros2::kSecond) + 1e-9 * static_cast<double>(since % ros2::kSecond);
  }
  [[nodiscard]] double seconds(const ros2::builtin_interfaces::Time& stamp) const {
    return seconds(ros2::nanoseconds_of(stamp));
  }
  /// To the nanosecond; 0 for what is not finite, the ends of ROS time for what lies beyond.
  [[nodiscard]] ros2::builtin_interfaces::Time time(double seconds) const {
    if (!std::isfinite(seconds)) return {};
    const double whole = std::floor(std::fmin(std::fmax(seconds, -4e9), 4e9));
    const auto nanoseconds = std::llround((std::fmin(std::fmax(seconds, -4e9), 4e9) - whole) * 1e9);
    return ros2::time_of(epoch_ + static_cast<ros2::Nanoseconds>(whole) * ros2::kSecond + nanoseconds);
  }

 private:
  ros2::Nanoseconds epoch_;  // a whole second
};

}  // namespace spf_ros2
