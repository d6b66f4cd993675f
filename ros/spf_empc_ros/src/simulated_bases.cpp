#include "spf_empc_ros/simulated_bases.hpp"

#include <algorithm>
#include <cmath>

namespace spf_empc_ros {

SimulatedBases::SimulatedBases(int robots, const spf::RobotParameters& robot, double period)
    : kinematics_{robot}, period_{period}, bases_(static_cast<std::size_t>(robots)) {}

void SimulatedBases::command_twist(int robot, const Eigen::Vector3d& twist_body, double time) {
  Base& base = bases_[spf::as_index(robot)];
  if (!twist_body.allFinite()) {
    ++base.record.refused;
    return;
  }
  const Eigen::Vector3d wanted = kinematics_.wheel_speeds(twist_body.head<2>(), twist_body.z());
  const double fastest = wanted.cwiseAbs().maxCoeff();
  const double limit = kinematics_.max_wheel_speed();
  constexpr double kRounding = 1e-9;
  if (fastest > limit * (1.0 + kRounding)) ++base.record.cut;
  take(base, fastest > limit ? Eigen::Vector3d{wanted * (limit / fastest)} : wanted, time);
}

void SimulatedBases::command_wheels(int robot, const std::vector<double>& wheel_speeds, double time) {
  Base& base = bases_[spf::as_index(robot)];
  if (wheel_speeds.size() != 3 || !std::all_of(wheel_speeds.begin(), wheel_speeds.end(),
                                               [](double speed) { return std::isfinite(speed); })) {
    ++base.record.refused;
    return;
  }
  const Eigen::Vector3d wanted{wheel_speeds[0], wheel_speeds[1], wheel_speeds[2]};
  const double limit = kinematics_.max_wheel_speed();
  if (wanted.cwiseAbs().maxCoeff() > limit) ++base.record.cut;
  take(base, wanted.cwiseMax(-limit).cwiseMin(limit), time);
}

void SimulatedBases::take(Base& base, const Eigen::Vector3d& wheel_speeds, double time) const {
  if (base.commanded) {
    const double gap = time - base.time;
    base.record.longest_gap = std::max(base.record.longest_gap, gap);
    if (gap > 1.5 * period_) ++base.record.late;
  }
  ++base.record.count;
  base.commanded = true;
  base.time = time;
  base.wheel_speeds = wheel_speeds;
}

Eigen::Vector3d SimulatedBases::wheels(int robot, double time) const {
  const Base& base = bases_[spf::as_index(robot)];
  if (!base.commanded || time - base.time > kWatchdog) return Eigen::Vector3d::Zero();
  return base.wheel_speeds;
}

}  // namespace spf_empc_ros
