#include "host/dead_reckoning.hpp"

#include <algorithm>

#include "spf/math/angles.hpp"
#include "spf/robot/drive.hpp"

namespace spf::host {
namespace {

/// A pose after a motion of constant twist in the body.
Pose2 carried(const Pose2& from, const Eigen::Vector3d& twist_body, double duration) {
  const double middle = from.heading + 0.5 * duration * twist_body.z();
  const Eigen::Vector3d displacement = duration * twist_in_world(twist_body, middle);
  return {from.position_world + displacement.head<2>(), wrap_angle(from.heading + displacement.z())};
}

}  // namespace

void DeadReckoning::advance(double time, const Eigen::Vector3d& twist_body) {
  if (kept_ == 0) {
    marks_[newest_] = {time, Pose2{}, twist_body};
    kept_ = 1;
    return;
  }
  const Mark last = newest();
  if (!(time > last.time)) return;
  const Mark mark{time, carried(last.pose, 0.5 * (last.twist_body + twist_body), time - last.time),
                  twist_body};
  // Marks in quick succession take each other's place, so that memory reaches far enough.
  const bool crowded = kept_ > 1 && last.time - before(newest_).time < kSpacing;
  if (!crowded) {
    newest_ = (newest_ + 1) % kMarks;
    kept_ = std::min(kept_ + 1, kMarks);
  }
  marks_[newest_] = mark;
}

Pose2 DeadReckoning::at(double time) const {
  if (time >= newest().time) return carried(newest().pose, newest().twist_body, time - newest().time);
  std::size_t after = newest_;
  for (std::size_t i = 1; i < kept_; ++i) {
    const Mark& to = marks_[after];
    const Mark& from = before(after);
    if (time >= from.time) {
      const double share = (time - from.time) / (to.time - from.time);
      const double turn = angle_difference(to.pose.heading, from.pose.heading);
      return {from.pose.position_world + share * (to.pose.position_world - from.pose.position_world),
              wrap_angle(from.pose.heading + share * turn)};
    }
    after = (after + kMarks - 1) % kMarks;
  }
  return marks_[after].pose;
}

}  // namespace spf::host
