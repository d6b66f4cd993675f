// Between ROS time and the hosts' seconds since an epoch, which keep nanoseconds in a double for months.
#pragma once

#include <ros/time.h>

#include <cmath>
#include <cstdint>

namespace spf_empc_ros {

class ClockEdge {
 public:
  /// The epoch is the whole second of `start`.
  explicit ClockEdge(const ros::Time& start) : epoch_{static_cast<std::int64_t>(start.sec)} {}

  [[nodiscard]] double seconds(const ros::Time& time) const {
    return static_cast<double>(static_cast<std::int64_t>(time.sec) - epoch_) + 1e-9 * time.nsec;
  }
  /// To the nanosecond; the ends of ROS time for what lies beyond, its zero for what is not finite.
  [[nodiscard]] ros::Time time(double seconds) const {
    if (!std::isfinite(seconds)) return ros::Time{};
    const double whole = std::floor(seconds);
    auto second = static_cast<std::int64_t>(std::fmin(std::fmax(whole, -1e10), 1e10)) + epoch_;
    auto nanoseconds = static_cast<std::int64_t>(std::llround((seconds - whole) * 1e9));
    if (nanoseconds >= 1000000000) {
      nanoseconds -= 1000000000;
      ++second;
    }
    if (second < 0) return ros::Time{};
    if (second > UINT32_MAX) return ros::TIME_MAX;
    return {static_cast<std::uint32_t>(second), static_cast<std::uint32_t>(nanoseconds)};
  }

 private:
  std::int64_t epoch_;  // [s]
};

}  // namespace spf_empc_ros
