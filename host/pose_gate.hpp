// Which poses are believed: finite, in order, and where the robot can be. A jump is a fault until it has
// persisted; then the robot was relocalised. Frame: world; times are the host's [s].
#pragma once

#include <optional>

#include "host/host_parameters.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/world/observation.hpp"

namespace spf::host {

enum class PoseVerdict {
  accepted,
  relocalised,  ///< a jump that persisted: accepted, and the past is to be forgotten
  malformed,    ///< not finite, or farther away than any robot
  future,       ///< stamped ahead of the clock
  late,         ///< not newer than the last one
  jump,         ///< where the robot cannot be; not believed yet
};
[[nodiscard]] const char* to_string(PoseVerdict verdict);

[[nodiscard]] inline bool believed(PoseVerdict verdict) {
  return verdict == PoseVerdict::accepted || verdict == PoseVerdict::relocalised;
}

class PoseGate {
 public:
  PoseGate(const HostParameters& parameters, const RobotParameters& robot)
      : parameters_{parameters}, robot_{robot} {}

  PoseVerdict judge(const PoseMeasurement& pose, double now);
  /// The last pose that was believed.
  [[nodiscard]] const std::optional<PoseMeasurement>& last() const { return last_; }
  /// Seconds since the believed pose was measured; infinite without one.
  [[nodiscard]] double age(double now) const;
  void reset();

 private:
  [[nodiscard]] bool reachable(const PoseMeasurement& from, const PoseMeasurement& to) const;

  HostParameters parameters_;
  RobotParameters robot_;
  std::optional<PoseMeasurement> last_;
  std::optional<PoseMeasurement> elsewhere_;  // the newest of a run of jumped poses that agree
  double elsewhere_since_ = 0.0;              // [s]
};

}  // namespace spf::host
