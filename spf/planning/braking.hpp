// Braking to rest from any state: always available, checked like any plan, broadcast when used. Frame: world.
#pragma once

#include "spf/robot/robot_parameters.hpp"
#include "spf/trajectory/trajectory.hpp"

namespace spf {

/// Three pieces that end at rest without acceleration: the acceleration turns linearly from the head's into a
/// constant braking one of at most max_acceleration, holds, and fades out linearly; ramps take about
/// max_acceleration / max_jerk. Straight when the head's acceleration lies along its velocity. The
/// acceleration never exceeds the larger of the head's and max_acceleration. The heading stops too. A head at
/// rest gives a trajectory at rest.
[[nodiscard]] Trajectory braking_trajectory(const FlatState& head, const HeadingState& heading,
                                            double start_time, const RobotParameters& robot);

/// The heading that stops turning as fast as the limits allow.
[[nodiscard]] HeadingProfile stopping_heading(const HeadingState& heading, double start_time,
                                              const RobotParameters& robot);

}  // namespace spf
