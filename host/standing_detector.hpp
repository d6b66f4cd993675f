// Whether a robot of whose past nothing is known stands, by its poses: a planner that starts while the robot
// still moves would begin from a standstill that is none. Frame: world; times are the host's [s].
#pragma once

#include <optional>
#include <vector>

#include "host/host_parameters.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/world/observation.hpp"

namespace spf::host {

class StandingDetector {
 public:
  StandingDetector(const HostParameters& host, const RobotParameters& robot);

  /// A pose that is believed.
  void add(const PoseMeasurement& pose);
  void forget();

  /// Seen to stand, or here for so long without a plan that its controller must have stopped it.
  [[nodiscard]] bool stands(double now) const;
  /// The newest pose; null without one.
  [[nodiscard]] const PoseMeasurement* last() const { return recent_.empty() ? nullptr : &recent_.back(); }

 private:
  double stopping_time_;                 // [s] from any motion, without a plan
  double standing_speed_;                // [m/s]
  std::vector<PoseMeasurement> recent_;  // of the last moments
  std::optional<double> first_time_;     // [s] of the first pose
};

}  // namespace spf::host
