#include "host/pose_history.hpp"

#include <algorithm>

#include "spf/math/angles.hpp"

namespace spf::host {

void PoseHistory::add(double time, const Pose2& pose_world) {
  if (count_ > 0 && !(time > back(0).time)) return;
  // The newest always counts; it replaces the one before where that is too near to its own predecessor.
  if (count_ > 1 && back(0).time - back(1).time < spacing_) {
    entries_[(next_ + kMost - 1) % kMost] = {time, pose_world};
    return;
  }
  entries_[next_] = {time, pose_world};
  next_ = (next_ + 1) % kMost;
  count_ = std::min(count_ + 1, kMost);
}

std::optional<Pose2> PoseHistory::at(double time) const {
  if (count_ == 0 || !(time <= back(0).time)) return std::nullopt;
  std::size_t number = 0;
  while (number + 1 < count_ && back(number + 1).time >= time) ++number;
  const Entry& after = back(number);
  if (number + 1 == count_ || after.time == time) return after.pose_world;
  const Entry& before = back(number + 1);
  const double share = (time - before.time) / (after.time - before.time);
  const double turn = angle_difference(after.pose_world.heading, before.pose_world.heading);
  return Pose2{before.pose_world.position_world +
                   share * (after.pose_world.position_world - before.pose_world.position_world),
               wrap_angle(before.pose_world.heading + share * turn)};
}

}  // namespace spf::host
