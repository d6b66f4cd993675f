// Motion primitives: what the robot could do in the next seconds, rolled out with the velocity moving
// straight towards its target at the largest acceleration. The space-time method chooses its motion (side,
// speed, waiting) among them. Frame: world.
#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>

#include "spf/planning/cost_to_go.hpp"
#include "spf/planning/space_time/passage_speed.hpp"
#include "spf/planning/space_time/space_time_risk.hpp"
#include "spf/planning/steering.hpp"
#include "spf/trajectory/trajectory.hpp"

namespace spf {

/// The robot takes up a velocity and holds it until a time, then heads for the goal, holds on, or brakes.
struct MotionPrimitive {
  enum class Then { goal, hold, brake };
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();  ///< [m/s] taken up first
  double until = 0.0;                                        ///< [s] from the start; 0 = straight to `then`
  Then then = Then::goal;
  double pace = 1.0;          ///< [1] of max_speed, on the way to the goal; below 1 it follows every bend
  Gear gear = Gear::forward;  ///< of a robot that steers, until `until`; then forward
};

/// Positions and velocities at steps of dt; the acceleration is constant within a step.
struct RollOut {
  int steps = 0;
  std::array<Eigen::Vector2d, SpaceTimeRisk::kMaxSteps + 1> position_world;
  std::array<Eigen::Vector2d, SpaceTimeRisk::kMaxSteps + 1> velocity_world;
  std::array<HeadingState, SpaceTimeRisk::kMaxSteps + 1> heading;  ///< of a robot that steers

  /// Of a robot that steers.
  [[nodiscard]] SteeredState state(const Steering& steering, int step) const;
};

/// Limits and time grid of the roll-outs.
struct RollOutSettings {
  double max_speed = 1.0;         ///< [m/s]
  double max_acceleration = 1.0;  ///< [m/s^2]
  double step = 0.1;              ///< [s]
  int steps = 30;
  const PassageSpeed* passage = nullptr;  ///< limits the speed on the way to the goal; null: nothing does
  const Steering* steering = nullptr;     ///< of a robot that cannot move sideways; null: it can
  std::optional<double> goal_heading;     ///< [rad] to which such a robot turns at the goal
};

/// Velocity towards the goal from a position: along the guide at max_speed, slower where the robot has to
/// stop at the goal. `pace` [1] of max_speed; `speed_now` [m/s] tells
/// how early a turn has to begin. `ahead`: unit vector of the heading of a robot that steers, which brakes
/// the less the more it has to turn meanwhile; null: it moves every way.
[[nodiscard]] Eigen::Vector2d goal_velocity(const Eigen::Vector2d& position_world, const CostToGo& guide,
                                            const RollOutSettings& settings, double pace = 1.0,
                                            double speed_now = 0.0, const Eigen::Vector2d* ahead = nullptr);

/// Rolls a primitive out from a head state (its acceleration is not continued). `heading`: of a robot that
/// steers, which turns towards each velocity instead of taking it up at once.
void roll_out(const MotionPrimitive& primitive, const FlatState& head, const HeadingState& heading,
              const CostToGo& guide, const RollOutSettings& settings, RollOut& result);

/// The roll-out as a trajectory; steps of equal acceleration become one piece. A last piece brakes to rest,
/// so that a plan which is not renewed ends at rest.
[[nodiscard]] Trajectory to_trajectory(const RollOut& roll_out, double start_time,
                                       const RollOutSettings& settings);

/// Appends braking to rest, with which every plan ends, from the trajectory's end state; nothing when that is
/// at rest.
void append_braking(const FlatState& end, const RollOutSettings& settings, Trajectory& trajectory);

}  // namespace spf
