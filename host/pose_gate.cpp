#include "host/pose_gate.hpp"

#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"

namespace spf::host {

const char* to_string(PoseVerdict verdict) {
  switch (verdict) {
    case PoseVerdict::accepted:
      return "accepted";
    case PoseVerdict::relocalised:
      return "relocalised";
    case PoseVerdict::malformed:
      return "malformed";
    case PoseVerdict::future:
      return "from the future";
    case PoseVerdict::late:
      return "late or duplicated";
    case PoseVerdict::jump:
      return "jumped";
  }
  return "?";
}

PoseVerdict PoseGate::judge(const PoseMeasurement& pose, double now) {
  const Eigen::Vector2d& position = pose.pose_world.position_world;
  const bool usable = std::isfinite(pose.time) && position.allFinite() &&
                      position.lpNorm<Eigen::Infinity>() <= kFarthest &&
                      std::isfinite(pose.pose_world.heading);
  if (!usable) return PoseVerdict::malformed;
  if (pose.time > now + parameters_.clock_error) return PoseVerdict::future;
  if (last_ && pose.time <= last_->time) return PoseVerdict::late;
  if (!last_ || reachable(*last_, pose)) {
    last_ = pose;
    elsewhere_.reset();
    return PoseVerdict::accepted;
  }
  if (elsewhere_ && pose.time <= elsewhere_->time) return PoseVerdict::late;
  if (!elsewhere_ || !reachable(*elsewhere_, pose)) elsewhere_since_ = pose.time;
  elsewhere_ = pose;
  if (pose.time - elsewhere_since_ < parameters_.jump_persistence) return PoseVerdict::jump;
  last_ = pose;
  elsewhere_.reset();
  return PoseVerdict::relocalised;
}

bool PoseGate::reachable(const PoseMeasurement& from, const PoseMeasurement& to) const {
  constexpr double kSpare =
      2.0;  // [1] of the planned limits: pushed robots and their controllers exceed them
  const double dt = to.time - from.time;
  const double moved = (to.pose_world.position_world - from.pose_world.position_world).norm();
  const double turned = std::abs(angle_difference(to.pose_world.heading, from.pose_world.heading));
  return moved <= parameters_.jump_distance + kSpare * robot_.max_speed * dt &&
         turned <= parameters_.jump_heading + kSpare * robot_.max_yaw_rate * dt;
}

double PoseGate::age(double now) const {
  return last_ ? now - last_->time : std::numeric_limits<double>::infinity();
}

void PoseGate::reset() {
  last_.reset();
  elsewhere_.reset();
}

}  // namespace spf::host
