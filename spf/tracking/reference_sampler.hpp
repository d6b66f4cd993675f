// Self-sampling (eq. 18): the MPC's reference, read from the committed trajectory at t, t + dt, ..., t + H dt
// for the current time t, whatever the plan's own sampling. Eq. 18 starts at k = 1 for the time t itself;
// here point k belongs to t + k dt, so that point k is what the predicted state z_k is compared with. Frame:
// world. A pose here is the vector (x, y, heading) [m, m, rad] whose heading is unwrapped along the horizon.
#pragma once

#include <Eigen/Core>

#include <array>

#include "spf/math/parameters.hpp"
#include "spf/math/pose2.hpp"
#include "spf/robot/drive.hpp"
#include "spf/trajectory/trajectory.hpp"

namespace spf {

/// Longest horizon of the MPC.
inline constexpr int kMaxHorizon = 20;

struct ReferenceParameters {
  bool self_sampling = true;         ///< false: the ablation "without self-sampling"
  double plan_point_interval = 0.5;  ///< [s] spacing of the plan's points that the ablation holds

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("self_sampling", self.self_sampling,
          "read the reference from the trajectory at every tick (eq. 18); false: hold the plan's discrete "
          "points");
    visit("plan_point_interval", self.plan_point_interval, "s", Range{0.01, 10.0},
          "without self-sampling: spacing of the plan's points; our choice");
  }
};

struct ReferenceRequest {
  double time = 0.0;  ///< [s] now
  double dt = 0.1;    ///< [s]
  int steps = 5;      ///< H, at most kMaxHorizon
  double preview =
      0.0;  ///< [s] every pose is moved ahead by preview times its velocity (for motors with that lag)
  /// [s] for which the first command is held before the next reference, in (0, dt]; 0 = dt. The MPC takes its
  /// first step to last dt; on a curve the first command would then run ahead by half the difference.
  /// Points 1..H are shifted so that the first step has the mean velocity of the time it is held.
  double hold_time = 0.0;
  Pose2 robot_world;  ///< for the number of turns of the heading
};

struct Reference {
  int steps = 0;
  std::array<Eigen::Vector3d, kMaxHorizon + 1> pose;   ///< points 0..H
  std::array<Eigen::Vector3d, kMaxHorizon + 1> twist;  ///< world [m/s, m/s, rad/s], points 0..H
  std::array<DriveInput, kMaxHorizon> wheel_speeds;  ///< [m/s] within the limits, steps 0..H-1: they move the
                                                     ///< MPC's model from point k to point k + 1
};

/// Never throws, never allocates. Requires a trajectory that is not empty, 1 <= steps <= kMaxHorizon, dt > 0.
[[nodiscard]] Reference sample_reference(const Trajectory& trajectory, const ReferenceRequest& request,
                                         const Drive& drive, const ReferenceParameters& parameters);

}  // namespace spf
