#include "spf/planning/steering.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"

namespace spf {
namespace {

constexpr double kSpare = 0.9;           // [1] of the limits of turning: the rest is for the controller
constexpr double kCornering = 0.85;      // [1] of max_acceleration: the rest can still change the speed
constexpr double kTurnedTo = 1e-3;       // [m/s] slower wishes say nothing about where to turn
constexpr double kCarPace = 0.6;         // [1] of the wanted speed: a car turns no slower than that
constexpr double kReversePrice = 1.3;    // [1] of the way forward
constexpr double kCusp = 0.3;            // [s] to change the gear
constexpr double kLongestPiece = 0.2;    // [s]
constexpr double kLeastDuration = 1e-6;  // [s] of a piece

double approach(double value, double target, double change) {
  return value + std::clamp(target - value, -change, change);
}

/// The yaw rate [rad/s] at which a robot that is off by an angle [rad] can still stop turning at its aim.
double rate_towards(double error, double max_yaw_acceleration, double dt) {
  const double braking = max_yaw_acceleration * dt;
  const double fastest =
      std::sqrt(2.0 * kSpare * max_yaw_acceleration * std::fabs(error) + 0.25 * braking * braking) -
      0.5 * braking;
  return std::copysign(std::min(fastest, std::fabs(error) / dt), error);
}

}  // namespace

Steering::Steering(const RobotParameters& robot)
    : max_speed_{validated(robot).max_speed},
      max_acceleration_{robot.max_acceleration},
      max_yaw_rate_{robot.max_yaw_rate},
      max_yaw_acceleration_{robot.max_yaw_acceleration},
      radius_{robot.drive == DriveType::car ? robot.min_turning_radius : 0.0},
      curvature_rate_{kSpare * robot.max_steering_rate / robot.wheel_base},
      may_reverse_{robot.drive != DriveType::car || robot.may_reverse} {
  if (radius_ > 0.0) return;
  // Both wheels of a differential drive share its turning and its driving.
  max_yaw_rate_ = std::min(max_yaw_rate_, robot.max_wheel_speed / robot.wheel_arm);
}

SteeredState Steering::state_of(const FlatState& head, const HeadingState& heading) const {
  SteeredState state{head.position_world, heading.heading, 0.0, heading.yaw_rate, 0.0};
  state.speed = head.velocity_world.dot(state.ahead());
  if (radius_ > 0.0) {
    const double most = std::fabs(state.speed) / radius_;
    state.yaw_rate = std::clamp(state.yaw_rate, -most, most);
    if (std::fabs(state.speed) > kTurnedTo) state.curvature = state.yaw_rate / state.speed;
  }
  return state;
}

/// Speed and yaw rate as near to the wanted ones as a step leads; the motion in between.
void Steering::change(double speed, double yaw_rate, double dt, SteeredState& state) const {
  // What the curve needs of the acceleration is not left for the speed.
  const double across = std::min(std::fabs(state.speed * state.yaw_rate), kCornering * max_acceleration_);
  const double along = std::sqrt(max_acceleration_ * max_acceleration_ - across * across);
  const double next_speed = approach(state.speed, speed, along * dt);
  const double most = std::min(kSpare * max_yaw_rate_,
                               kCornering * max_acceleration_ / std::max(std::fabs(next_speed), 1e-6));
  double next_rate = std::clamp(yaw_rate, -most, most);
  if (radius_ > 0.0) {
    double curvature = std::fabs(next_speed) > kTurnedTo ? next_rate / next_speed : 0.0;
    curvature = std::clamp(curvature, -kSpare / radius_, kSpare / radius_);
    state.curvature = approach(state.curvature, curvature, curvature_rate_ * dt);
    next_rate = state.curvature * next_speed;
  } else {
    next_rate = approach(state.yaw_rate, next_rate, max_yaw_acceleration_ * dt);
  }
  const double turned = 0.5 * (state.yaw_rate + next_rate) * dt;
  // The chord of the arc lies half way between its ends' headings.
  const double chord = state.heading + 0.5 * turned;
  const double half = 0.5 * turned;
  const double shorter = std::fabs(half) > 1e-4 ? std::sin(half) / half : 1.0;
  state.position_world +=
      0.5 * (state.speed + next_speed) * dt * shorter * Eigen::Vector2d{std::cos(chord), std::sin(chord)};
  state.heading = wrap_angle(state.heading + turned);
  state.speed = next_speed;
  state.yaw_rate = next_rate;
}

void Steering::step(const Eigen::Vector2d& velocity_world, Gear gear, double dt, SteeredState& state) const {
  const double wanted = velocity_world.norm();
  if (wanted < kTurnedTo) {
    change(0.0, 0.0, dt, state);
    return;
  }
  const double sign = gear == Gear::reverse && may_reverse_ ? -1.0 : 1.0;
  const double aim = std::atan2(sign * velocity_world.y(), sign * velocity_world.x());
  const double error = angle_difference(aim, state.heading);
  const double pace = radius_ > 0.0 ? std::max(kCarPace, std::cos(error)) : std::max(0.0, std::cos(error));
  change(sign * std::min(wanted, max_speed_) * pace, rate_towards(error, max_yaw_acceleration_, dt), dt,
         state);
}

void Steering::turn(double heading, double dt, SteeredState& state) const {
  if (!turns_on_the_spot()) {
    change(0.0, 0.0, dt, state);
    return;
  }
  const double error = angle_difference(heading, state.heading);
  change(0.0, rate_towards(error, max_yaw_acceleration_, dt), dt, state);
}

/// Of the shortest path that begins along the x axis, turns on a circle and goes on straight to a position.
double Steering::loop_length(const Eigen::Vector2d& target_body) const {
  const double x = target_body.x();
  double best = std::numeric_limits<double>::infinity();
  for (const double side : {1.0, -1.0}) {
    const double y = side * target_body.y() - radius_;  // from the circle's centre
    const double distance = std::hypot(x, y);
    if (distance < radius_) continue;
    const double straight = std::sqrt(distance * distance - radius_ * radius_);
    // The angle on the circle, from where it begins (below the centre) to where the tangent leaves it.
    double angle = std::atan2(y, x) + 0.5 * kPi - std::acos(std::min(1.0, radius_ / distance));
    if (angle < 0.0) angle += 2.0 * kPi;
    if (angle > 2.0 * kPi - 1e-6) angle = 0.0;
    best = std::min(best, radius_ * angle + straight);
  }
  return best;
}

double Steering::turning_time(const SteeredState& state, const Eigen::Vector2d& target_world) const {
  const Eigen::Vector2d offset = target_world - state.position_world;
  const double distance = offset.norm();
  if (distance < 1e-6) return 0.0;
  const Eigen::Vector2d ahead = state.ahead();
  const Eigen::Vector2d target{ahead.dot(offset), ahead.x() * offset.y() - ahead.y() * offset.x()};
  if (turns_on_the_spot()) {
    const double error = std::fabs(std::atan2(target.y(), target.x()));
    return error / (kSpare * max_yaw_rate_);
  }
  double extra = loop_length(target) - distance;
  if (may_reverse_) {
    const double back =
        kReversePrice * loop_length({-target.x(), target.y()}) + kCusp * max_speed_ - distance;
    extra = std::min(extra, back);
  }
  return extra / max_speed_;
}

void Steering::append(const SteeredState& from, const SteeredState& to, double duration,
                      Trajectory& trajectory) {
  if (!(duration > kLeastDuration)) return;
  QuinticPiece piece;
  piece.duration = duration;
  const Eigen::Vector2d v0 = from.velocity_world() * duration;
  const Eigen::Vector2d v1 = to.velocity_world() * duration;
  const Eigen::Vector2d step = to.position_world - from.position_world;
  const Eigen::Vector2d second = 3.0 * step - 2.0 * v0 - v1;
  const Eigen::Vector2d third = v0 + v1 - 2.0 * step;
  piece.coefficients.row(0) = from.position_world.transpose();
  piece.coefficients.row(1) = v0.transpose() / duration;
  piece.coefficients.row(2) = second.transpose() / (duration * duration);
  piece.coefficients.row(3) = third.transpose() / (duration * duration * duration);
  trajectory.append(piece, {from.heading, from.yaw_rate}, {to.heading, to.yaw_rate});
}

double Steering::braking_time(const SteeredState& state) const {
  const double turning = radius_ > 0.0 ? 0.0 : std::fabs(state.yaw_rate) / max_yaw_acceleration_;
  return std::max(std::fabs(state.speed) / max_acceleration_, turning);
}

void Steering::append_braking(SteeredState state, int pieces, Trajectory& trajectory) const {
  // Curves leave less for the brakes, so it may take a little longer.
  for (int left = pieces; left > 0; --left) {
    const double time = braking_time(state);
    if (time < 1e-3) return;
    const bool last = left == 1 || time <= kLongestPiece;
    const double duration = last ? time : std::max(kLongestPiece, time / left);
    SteeredState next = state;
    if (last) {
      const double turned = 0.5 * state.yaw_rate * duration;
      next.heading = wrap_angle(state.heading + turned);
      const double chord = state.heading + 0.5 * turned;
      next.position_world += 0.5 * state.speed * duration * Eigen::Vector2d{std::cos(chord), std::sin(chord)};
      next.speed = next.yaw_rate = 0.0;
    } else {
      change(0.0, 0.0, duration, next);
    }
    append(state, next, duration, trajectory);
    state = next;
    if (last) return;
  }
}

Trajectory steered_along(const Trajectory& wanted, const FlatState& head, const HeadingState& heading,
                         const RobotParameters& robot) {
  constexpr int kBrakingPieces = 8;
  constexpr double kStep = 0.05;       // [s]
  constexpr double kGain = 1.5;        // [1/s] of the gap to the trajectory
  constexpr double kTolerance = 0.02;  // [m] at rest that near to its end it does not turn any more
  const Steering steering{robot};
  SteeredState state = steering.state_of(head, heading);
  Trajectory trajectory{wanted.start_time()};
  const int pieces = Trajectory::kMaxPieces - kBrakingPieces;
  // Turning takes longer than the wanted motion does.
  const double duration = std::clamp(wanted.duration() + 2.0, 1.0, 0.3 * pieces);
  const int together = std::max(1, static_cast<int>(std::ceil(duration / (pieces * kStep))));
  double time = wanted.start_time();
  for (int piece = 0; piece < pieces && time < wanted.start_time() + duration; ++piece) {
    const SteeredState from = state;
    for (int k = 0; k < together; ++k, time += kStep) {
      const FlatState target = wanted.state(time + kStep);
      const Eigen::Vector2d gap = target.position_world - state.position_world;
      const bool there = target.velocity_world.norm() < kTurnedTo && gap.norm() < kTolerance;
      const Eigen::Vector2d velocity =
          there ? Eigen::Vector2d{0.0, 0.0} : Eigen::Vector2d{target.velocity_world + kGain * gap};
      const bool back = steering.may_reverse() && velocity.dot(state.ahead()) < -0.7 * velocity.norm() &&
                        gap.norm() < 2.0 * robot.radius &&
                        target.velocity_world.norm() < 0.1 * robot.max_speed;
      steering.step(velocity, back ? Gear::reverse : Gear::forward, kStep, state);
    }
    Steering::append(from, state, together * kStep, trajectory);
  }
  steering.append_braking(state, kBrakingPieces, trajectory);
  return trajectory;
}

}  // namespace spf
