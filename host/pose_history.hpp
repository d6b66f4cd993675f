// Where the robot was in the last moments, so that what was sensed then is seen from there. Frame: world;
// times are the host's [s].
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "spf/math/pose2.hpp"

namespace spf::host {

/// Never allocates.
class PoseHistory {
 public:
  /// Reaches back over `span` [s] at least, whatever the rate of poses.
  explicit PoseHistory(double span) : spacing_{2.0 * span / static_cast<double>(kMost)} {}

  /// Times must grow; others are ignored.
  void add(double time, const Pose2& pose_world);
  void clear() { count_ = 0; }
  /// Between the two nearest poses; the oldest for times before it, none after the newest.
  [[nodiscard]] std::optional<Pose2> at(double time) const;

 private:
  static constexpr std::size_t kMost = 64;
  struct Entry {
    double time = 0.0;
    Pose2 pose_world;
  };
  /// The newest is number 0.
  [[nodiscard]] const Entry& back(std::size_t number) const {
    return entries_[(next_ + kMost - 1 - number) % kMost];
  }

  double spacing_;  // [s]
  std::array<Entry, kMost> entries_;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace spf::host
