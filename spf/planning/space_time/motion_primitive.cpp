#include "spf/planning/space_time/motion_primitive.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "spf/math/plane.hpp"
#include "spf/trajectory/constant_acceleration.hpp"

namespace spf {
namespace {

constexpr double kArrived = 0.3;  // [1] of a step at max_speed

/// Moves a velocity towards a target by at most `change`.
Eigen::Vector2d approach(const Eigen::Vector2d& velocity, const Eigen::Vector2d& target, double change) {
  const Eigen::Vector2d difference = target - velocity;
  const double size = difference.norm();
  if (size <= change) return target;
  return velocity + difference * (change / size);
}

/// A car that has just passed its goal stands there: to come nearer it would have to drive a circle.
bool missed(const Eigen::Vector2d& goal, const Eigen::Vector2d& ahead, const RollOutSettings& settings) {
  return !settings.steering->turns_on_the_spot() && goal.dot(ahead) <= 0.0 &&
         goal.norm() < settings.max_speed * settings.step;
}

}  // namespace

Eigen::Vector2d goal_velocity(const Eigen::Vector2d& position_world, const CostToGo& guide,
                              const RollOutSettings& settings, double pace, double speed_now,
                              const Eigen::Vector2d* ahead) {
  std::optional<Eigen::Vector2d> on_path;
  if (settings.passage != nullptr) on_path = settings.passage->direction(position_world, speed_now);
  const Eigen::Vector2d direction = on_path ? *on_path : guide.direction(position_world);
  const double cost = guide.cost_to_go(position_world);
  // Narrow ground costs more than its length: near the goal the straight distance tells better.
  const double straight = (guide.goal_used() - position_world).norm();
  const double distance = cost < (1.0 + kNarrowCost) * straight + settings.step * settings.max_speed
                              ? std::min(cost, straight)
                              : cost;
  // The velocity v at the end of a step, from step * v + v^2 / (2 acceleration) = distance: the step and
  // stopping from v end at the goal. It does not pass the goal within the step either.
  double acceleration = settings.max_acceleration;
  if (ahead != nullptr) {
    // The arc to a point that lies off the heading by an angle has a curvature of 2 sin(angle) / distance;
    // with v^2 = 2 b distance, b the braking, it takes 4 b sin(angle) across.
    const double across = 4.0 * cross(*ahead, direction);
    acceleration /= std::sqrt(1.0 + across * across);
  }
  const double stoppable =
      acceleration *
      (std::sqrt(settings.step * settings.step + 2.0 * distance / acceleration) - settings.step);
  const double speed = std::min({pace * settings.max_speed, stoppable, distance / (2.0 * settings.step)});
  return direction * (settings.passage != nullptr ? std::min(speed, settings.passage->limit(cost)) : speed);
}

SteeredState RollOut::state(const Steering& steering, int step) const {
  const auto at = static_cast<std::size_t>(step);
  return steering.state_of({position_world[at], velocity_world[at], Eigen::Vector2d::Zero()}, heading[at]);
}

void roll_out(const MotionPrimitive& primitive, const FlatState& head, const HeadingState& heading,
              const CostToGo& guide, const RollOutSettings& settings, RollOut& result) {
  SteeredState steered;
  if (settings.steering != nullptr) {
    steered = settings.steering->state_of(head, heading);
    result.heading[0] = heading;
  }
  result.steps = settings.steps;
  result.position_world[0] = head.position_world;
  result.velocity_world[0] = head.velocity_world;
  const double change = settings.max_acceleration * settings.step;
  // Far from the goal its direction hardly changes within the horizon: it is looked up every fifth step, near
  // the goal at every step.
  const double near = 2.0 * settings.max_speed * settings.step * settings.steps;
  Eigen::Vector2d target = primitive.velocity_world;
  bool first = primitive.until > 0.0;
  bool follow = false;
  const bool narrow = settings.passage != nullptr && settings.passage->limits();
  for (int k = 0; k < settings.steps; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const Eigen::Vector2d position = result.position_world[at];
    const Eigen::Vector2d velocity = result.velocity_world[at];
    const Eigen::Vector2d ahead = settings.steering != nullptr ? steered.ahead() : Eigen::Vector2d::UnitX();
    const bool goes_on = k * settings.step >= primitive.until - 1e-9;
    if (goes_on) {
      const bool entering = first || k == 0;
      first = false;
      switch (primitive.then) {
        case MotionPrimitive::Then::goal:
          if (entering) follow = primitive.pace < 1.0 || narrow || guide.cost_to_go(position) < near;
          if (entering || follow || k % 5 == 0)
            target = goal_velocity(position, guide, settings, primitive.pace, velocity.norm(),
                                   settings.steering != nullptr ? &ahead : nullptr);
          break;
        case MotionPrimitive::Then::hold:
          break;
        case MotionPrimitive::Then::brake:
          target = Eigen::Vector2d::Zero();
          break;
      }
    }
    if (settings.steering != nullptr) {
      const bool to_goal = goes_on && primitive.then == MotionPrimitive::Then::goal;
      const double gap = (guide.goal_used() - position).norm();
      if (to_goal && settings.goal_heading && gap < kArrived * settings.max_speed * settings.step)
        settings.steering->turn(*settings.goal_heading, settings.step, steered);
      else if (to_goal && missed(guide.goal_used() - position, ahead, settings))
        settings.steering->step(Eigen::Vector2d::Zero(), Gear::forward, settings.step, steered);
      else
        settings.steering->step(target, to_goal ? Gear::forward : primitive.gear, settings.step, steered);
      result.position_world[at + 1] = steered.position_world;
      result.velocity_world[at + 1] = steered.velocity_world();
      result.heading[at + 1] = {steered.heading, steered.yaw_rate};
      continue;
    }
    const Eigen::Vector2d next = approach(velocity, target, change);
    result.velocity_world[at + 1] = next;
    result.position_world[at + 1] = position + 0.5 * settings.step * (velocity + next);
  }
}

namespace {

constexpr int kBrakingPieces = 8;

/// Some steps to a piece, as many as there is room for.
Trajectory steered_trajectory(const RollOut& roll_out, double start_time, const RollOutSettings& settings) {
  Trajectory trajectory{start_time};
  const int most = Trajectory::kMaxPieces - kBrakingPieces;
  const int together = std::max(2, (roll_out.steps + most - 1) / most);
  SteeredState state = roll_out.state(*settings.steering, 0);
  for (int k = 0; k < roll_out.steps;) {
    const int next = std::min(k + together, roll_out.steps);
    const SteeredState then = roll_out.state(*settings.steering, next);
    Steering::append(state, then, settings.step * (next - k), trajectory);
    state = then;
    k = next;
  }
  settings.steering->append_braking(state, kBrakingPieces, trajectory);
  return trajectory;
}

}  // namespace

Trajectory to_trajectory(const RollOut& roll_out, double start_time, const RollOutSettings& settings) {
  if (settings.steering != nullptr) return steered_trajectory(roll_out, start_time, settings);
  Trajectory trajectory{start_time};
  int k = 0;
  while (k < roll_out.steps) {
    const auto from = static_cast<std::size_t>(k);
    const Eigen::Vector2d change = roll_out.velocity_world[from + 1] - roll_out.velocity_world[from];
    int last = k + 1;  // extend over steps of the same acceleration
    while (last < roll_out.steps) {
      const auto next = static_cast<std::size_t>(last);
      const Eigen::Vector2d following = roll_out.velocity_world[next + 1] - roll_out.velocity_world[next];
      if ((following - change).norm() > 1e-12) break;
      ++last;
    }
    const auto to = static_cast<std::size_t>(last);
    trajectory.append(constant_acceleration(roll_out.position_world[from], roll_out.velocity_world[from],
                                            roll_out.velocity_world[to], settings.step * (last - k)));
    k = last;
  }
  const auto end = static_cast<std::size_t>(roll_out.steps);
  append_braking({roll_out.position_world[end], roll_out.velocity_world[end], Eigen::Vector2d::Zero()},
                 settings, trajectory);
  return trajectory;
}

void append_braking(const FlatState& end, const RollOutSettings& settings, Trajectory& trajectory) {
  const double speed = end.velocity_world.norm();
  if (speed <= 1e-6) return;
  trajectory.append(constant_acceleration(end.position_world, end.velocity_world, Eigen::Vector2d::Zero(),
                                          speed / settings.max_acceleration));
}

}  // namespace spf
