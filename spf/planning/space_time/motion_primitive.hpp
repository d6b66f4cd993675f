// Motion primitives: what the robot could do in the next seconds, rolled out with velocities that move
// straight in velocity space at the largest acceleration. They choose the way (side, speed, waiting) of the
// space-time method. Frame: world.
#pragma once

#include <Eigen/Core>

#include <array>

#include "spf/planning/cost_to_go.hpp"
#include "spf/planning/space_time/space_time_risk.hpp"
#include "spf/trajectory/trajectory.hpp"

namespace spf {

/// First a velocity is taken up and held until a time, then the robot goes for its goal, goes on, or brakes.
struct MotionPrimitive {
  enum class Then { goal, hold, brake };
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();  ///< [m/s] taken up first
  double until = 0.0;                                        ///< [s] from the start; 0 = straight to `then`
  Then then = Then::goal;
};

/// Positions and velocities at steps of dt; the acceleration is constant within a step.
struct RollOut {
  int steps = 0;
  std::array<Eigen::Vector2d, SpaceTimeRisk::kMaxSteps + 1> position_world;
  std::array<Eigen::Vector2d, SpaceTimeRisk::kMaxSteps + 1> velocity_world;
};

/// Limits and time grid of the roll-outs.
struct RollOutSettings {
  double max_speed = 1.0;         ///< [m/s]
  double max_acceleration = 1.0;  ///< [m/s^2]
  double step = 0.1;              ///< [s]
  int steps = 30;
};

/// The velocity that leads to the goal from here: along the guide at max_speed, slowing down so as to stop
/// there.
[[nodiscard]] Eigen::Vector2d goal_velocity(const Eigen::Vector2d& position_world, const CostToGo& guide,
                                            const RollOutSettings& settings);

/// Rolls a primitive out from a head state (its acceleration is not continued).
void roll_out(const MotionPrimitive& primitive, const FlatState& head, const CostToGo& guide,
              const RollOutSettings& settings, RollOut& result);

/// The roll-out as a trajectory; steps of equal acceleration become one piece. A last piece brakes to rest,
/// so that a plan which is not renewed ends standing.
[[nodiscard]] Trajectory to_trajectory(const RollOut& roll_out, double start_time,
                                       const RollOutSettings& settings);

/// Appends the braking to rest with which every plan ends, from the state in which the trajectory ends;
/// nothing when that is at rest.
void append_braking(const FlatState& end, const RollOutSettings& settings, Trajectory& trajectory);

}  // namespace spf
