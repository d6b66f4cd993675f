#include "simulator/simulated_bases.hpp"

#include <algorithm>
#include <cmath>

namespace spf::simulator {

SimulatedBases::SimulatedBases(const std::vector<spf::RobotParameters>& robots, double period)
    : period_{period} {
  for (const spf::RobotParameters& robot : robots) bases_.emplace_back(spf::Drive{robot});
}

void SimulatedBases::command_twist(int robot, const Eigen::Vector3d& twist_body, double time) {
  Base& base = bases_[spf::as_index(robot)];
  if (!twist_body.allFinite()) {
    ++base.record.refused;
    return;
  }
  const spf::DriveInput wanted = base.drive.input_for(twist_body);
  constexpr double kRounding = 1e-9;
  if (base.drive.scale_to_limit(wanted) < 1.0 - kRounding) ++base.record.cut;
  take(base, base.drive.saturated(wanted), time);
}

void SimulatedBases::command_wheels(int robot, const std::vector<double>& wheel_speeds, double time) {
  Base& base = bases_[spf::as_index(robot)];
  if (wheel_speeds.size() != static_cast<std::size_t>(base.drive.inputs()) ||
      !std::all_of(wheel_speeds.begin(), wheel_speeds.end(),
                   [](double speed) { return std::isfinite(speed); })) {
    ++base.record.refused;
    return;
  }
  const spf::DriveInput wanted = Eigen::Map<const Eigen::VectorXd>(wheel_speeds.data(), base.drive.inputs());
  const spf::DriveInput possible = wanted.cwiseMax(base.drive.lower()).cwiseMin(base.drive.upper());
  if (possible != wanted) ++base.record.cut;
  take(base, possible, time);
}

void SimulatedBases::take(Base& base, const spf::DriveInput& wheel_speeds, double time) const {
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

spf::DriveInput SimulatedBases::wheels(int robot, double time) const {
  const Base& base = bases_[spf::as_index(robot)];
  if (!base.commanded || time - base.time > kWatchdog) return base.drive.standstill();
  return base.wheel_speeds;
}

}  // namespace spf::simulator
