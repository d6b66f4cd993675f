#include "spf/tracking/command_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace spf {
namespace {

constexpr double kWheelRounding = 1e-9;  // [1] of the largest rim speed
constexpr double kLittleTurn = 0.5;  // [1] of what one step may change: the body's frame has turned by less

/// The largest factor up to 1 that brings a size within its limit.
double factor_within(double size, double limit) {
  return size > limit ? limit / size : 1.0;
}

}  // namespace

CommandLimiter::CommandLimiter(const RobotParameters& robot, const Drive& drive, double period)
    : drive_{drive},
      largest_speed_{kSpeedSpare * validated(robot).max_speed},
      max_speed_{largest_speed_},
      max_acceleration_{kAccelerationSpare * robot.max_acceleration},
      max_yaw_rate_{kSpeedSpare * robot.max_yaw_rate},
      max_yaw_acceleration_{kAccelerationSpare * robot.max_yaw_acceleration},
      period_{period} {}

void CommandLimiter::set_max_speed(double max_speed) {
  if (max_speed > 0.0) max_speed_ = std::min(kSpeedSpare * max_speed, largest_speed_);
}

DriveInput CommandLimiter::limited(const DriveInput& wanted, const DriveInput& previous,
                                   double elapsed) const {
  if (previous.size() != drive_.inputs() || !previous.allFinite() || !std::isfinite(elapsed))
    return drive_.standstill();
  const double duration = std::clamp(elapsed, 0.0, period_);

  // 1. The motion before: as it was seen from the body then, and from the body that has turned on since.
  const Eigen::Vector3d then = drive_.twist_body(previous);
  const Eigen::Vector3d turned = twist_in_body(then, duration * then.z());
  const double apart_by = (turned - then).norm();
  const bool turns = apart_by > kLittleTurn * max_acceleration_ * duration;

  // 2. A possible motion.
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  if (wanted.size() == drive_.inputs() && wanted.allFinite()) {
    target = drive_.twist_body(wanted);
    if (keeps_limits(wanted, target, turned, duration) &&
        (turns || keeps_limits(wanted, target, then, duration)))
      return wanted;
    target = possible(target);
  }

  // 3. As near to it as one step leads. On the straight line from one possible motion to another all are
  // possible; driving and turning may differ in how far they get as far as the wheels allow it.
  const Eigen::Vector3d before = turns ? turned : Eigen::Vector3d{0.5 * (then + turned)};
  const double farthest = max_acceleration_ * duration - (turns ? 0.0 : 0.5 * apart_by);  // [m/s]
  const Eigen::Vector3d change = target - before;
  const double driving = factor_within(change.head<2>().norm(), farthest);
  const double turning = factor_within(std::abs(change.z()), max_yaw_acceleration_ * duration);
  const Eigen::Vector3d together = before + std::min(driving, turning) * change;
  const Eigen::Vector3d apart =
      before + Eigen::Vector3d{driving * change.x(), driving * change.y(), turning * change.z()};
  const Eigen::Vector3d twist = together + share_within_wheels(together, apart) * (apart - together);
  return drive_.saturated(drive_.input_for(twist));
}

bool CommandLimiter::keeps_limits(const DriveInput& wheel_speeds, const Eigen::Vector3d& twist_body,
                                  const Eigen::Vector3d& before_body, double duration) const {
  const Eigen::Vector3d change = twist_body - before_body;
  const double largest_rim_speed = (1.0 + kWheelRounding) * drive_.max_wheel_speed();
  return twist_body.head<2>().norm() <= max_speed_ && std::abs(twist_body.z()) <= max_yaw_rate_ &&
         change.head<2>().norm() <= max_acceleration_ * duration &&
         std::abs(change.z()) <= max_yaw_acceleration_ * duration &&
         wheel_speeds.lpNorm<Eigen::Infinity>() <= largest_rim_speed;
}

/// Within the limits of speed, yaw rate and wheels: less turning rather than less driving, since driving is
/// what was planned around things.
Eigen::Vector3d CommandLimiter::possible(const Eigen::Vector3d& twist_body) const {
  Eigen::Vector3d twist = twist_body;
  twist.head<2>() *= factor_within(twist.head<2>().norm(), max_speed_);
  twist.z() = std::clamp(twist.z(), -max_yaw_rate_, max_yaw_rate_);
  Eigen::Vector3d straight{twist.x(), twist.y(), 0.0};
  straight *= std::min(1.0, drive_.scale_to_limit(drive_.input_for(straight)));
  const Eigen::Vector3d turning{straight.x(), straight.y(), twist.z()};
  return straight + share_within_wheels(straight, turning) * (turning - straight);
}

/// How far the line from one motion to another is within the limits of the wheels [1]; its start must be.
double CommandLimiter::share_within_wheels(const Eigen::Vector3d& from_body,
                                           const Eigen::Vector3d& to_body) const {
  const DriveInput from = drive_.input_for(from_body);
  const DriveInput to = drive_.input_for(to_body);
  double share = 1.0;
  for (int wheel = 0; wheel < drive_.inputs(); ++wheel) {
    const double limit = std::copysign(drive_.max_wheel_speed(), to[wheel]);
    if (std::abs(to[wheel]) <= std::abs(limit)) continue;
    const double change = to[wheel] - from[wheel];
    share = std::min(share, std::clamp((limit - from[wheel]) / change, 0.0, 1.0));
  }
  return share;
}

}  // namespace spf
