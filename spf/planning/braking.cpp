#include "spf/planning/braking.hpp"

#include <algorithm>
#include <cmath>

#include "spf/planning/steering.hpp"

namespace spf {
namespace {

constexpr double kRestTime = 1.0;       // [s] duration of a trajectory at rest
constexpr double kRestSpeed = 1e-9;     // [m/s]
constexpr double kShortestRamp = 0.05;  // [s] keeps pieces well conditioned

/// A piece of constant jerk from a state over `duration`; moves the state to its end.
QuinticPiece constant_jerk_piece(FlatState& state, const Eigen::Vector2d& jerk, double duration) {
  QuinticPiece piece;
  piece.duration = duration;
  piece.coefficients.row(0) = state.position_world.transpose();
  piece.coefficients.row(1) = state.velocity_world.transpose();
  piece.coefficients.row(2) = 0.5 * state.acceleration_world.transpose();
  piece.coefficients.row(3) = jerk.transpose() / 6.0;
  const Eigen::Vector2d a = state.acceleration_world;
  state.position_world += duration * (state.velocity_world + duration * (0.5 * a + duration / 6.0 * jerk));
  state.velocity_world += duration * (a + 0.5 * duration * jerk);
  state.acceleration_world += duration * jerk;
  return piece;
}

/// Along the heading, turning until that stops too.
Trajectory steered_braking(const FlatState& head, const HeadingState& heading, double start_time,
                           const RobotParameters& robot) {
  constexpr int kPieces = 20;
  const Steering steering{robot};
  Trajectory trajectory{start_time};
  const SteeredState state = steering.state_of(head, heading);
  steering.append_braking(state, kPieces, trajectory);
  if (trajectory.empty()) {
    SteeredState rest = state;
    rest.speed = rest.yaw_rate = 0.0;
    Steering::append(rest, rest, kRestTime, trajectory);
  }
  return trajectory;
}

}  // namespace

HeadingProfile stopping_heading(const HeadingState& heading, double start_time,
                                const RobotParameters& robot) {
  const double stop_angle =
      heading.yaw_rate * std::abs(heading.yaw_rate) / (2.0 * robot.max_yaw_acceleration);
  return {start_time, heading, wrap_angle(heading.heading + stop_angle), std::max(robot.max_yaw_rate, 1e-3),
          robot.max_yaw_acceleration};
}

Trajectory braking_trajectory(const FlatState& head, const HeadingState& heading, double start_time,
                              const RobotParameters& robot) {
  if (steers(robot.drive)) return steered_braking(head, heading, start_time, robot);
  const HeadingProfile turn = stopping_heading(heading, start_time, robot);
  const double head_acceleration = head.acceleration_world.norm();
  const double limit = robot.max_acceleration;
  const double ramp_in = std::max(kShortestRamp, (head_acceleration + limit) / robot.max_jerk);
  const double ramp_out = std::max(kShortestRamp, limit / robot.max_jerk);

  // With the braking acceleration -b u the velocity ends at zero when
  // b (ramp_in / 2 + hold + ramp_out / 2) u = velocity + head acceleration * ramp_in / 2.
  const Eigen::Vector2d to_lose = head.velocity_world + 0.5 * ramp_in * head.acceleration_world;
  const double amount = to_lose.norm();
  if (head.velocity_world.norm() < kRestSpeed && head_acceleration < kRestSpeed)
    return Trajectory::standing(head.position_world, start_time, kRestTime, turn);
  const double ramps = 0.5 * (ramp_in + ramp_out);
  const double hold = std::max(0.0, amount / limit - ramps);
  const Eigen::Vector2d braking = -to_lose / (ramps + hold);

  Trajectory trajectory{start_time};
  FlatState state = head;
  trajectory.append(constant_jerk_piece(state, (braking - head.acceleration_world) / ramp_in, ramp_in));
  if (hold > 1e-6) {
    state.acceleration_world = braking;
    trajectory.append(constant_jerk_piece(state, Eigen::Vector2d::Zero(), hold));
  }
  trajectory.append(constant_jerk_piece(state, -state.acceleration_world / ramp_out, ramp_out));
  trajectory.set_heading(turn);
  return trajectory;
}

}  // namespace spf
