// Seeded random instances of the MPC's problem, shared by tests and benchmarks: a curved reference with
// tangent heading, a state beside it, and in some a wall (a soft state bound) just ahead or already passed.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "spf/math/random_stream.hpp"
#include "spf/tracking/mpc.hpp"

namespace spf {

struct MpcInstance {
  RobotParameters robot;
  MpcParameters parameters;
  MpcProblem problem;
};

struct MpcInstanceOptions {
  DriveType drive = DriveType::omni;
  int wheels = 3;
  int horizon = 5;
  double position_error = 0.3;   ///< [m] radius of the disc around the reference
  double heading_error = 0.2;    ///< [rad] to either side
  double wall_share = 0.2;       ///< share of the instances with a wall
  double wall_ahead_low = 0.02;  ///< [m] the wall's distance ahead of the robot; negative = passed already
  double wall_ahead_high = 0.2;
  double wheel_arm = 0.2;
  double rate_weight = 0.0;
  double disturbance = 0.0;  ///< [m/s] largest, per axis
};

/// Reference of a curve of speed v and curvature k0 + a sin(b t + c), from a time on.
struct CurvedReference {
  double speed, k0, a, b, c;

  explicit CurvedReference(RandomStream& random)
      : speed{random.uniform(0.7, 0.9)},
        k0{random.uniform(-1.0, 1.0)},
        a{random.uniform(-1.0, 1.0)},
        b{random.uniform(0.5, 2.0)},
        c{random.uniform(-3.0, 3.0)} {}

  /// Heading is the integral of speed times curvature in closed form; the position by midpoint steps of 1 ms.
  [[nodiscard]] double heading(double t) const {
    return speed * (k0 * t - a / b * (std::cos(b * t + c) - std::cos(c)));
  }
  [[nodiscard]] Reference sample(double time, double dt, int steps, const Drive& drive) const {
    Reference reference;
    reference.steps = steps;
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    constexpr int kSub = 100;
    for (int k = 0; k <= steps; ++k) {
      const double t = time + k * dt;
      reference.pose[static_cast<std::size_t>(k)] = {position.x(), position.y(), heading(t)};
      for (int i = 0; i < kSub; ++i) {
        const double angle = heading(t + (i + 0.5) * dt / kSub);
        position += speed * dt / kSub * Eigen::Vector2d{std::cos(angle), std::sin(angle)};
      }
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(steps); ++k) {
      const Eigen::Vector3d twist = (reference.pose[k + 1] - reference.pose[k]) / dt;
      reference.twist[k] = twist;
      reference.wheel_speeds[k] = drive.saturated(drive.input_from_world(twist, reference.pose[k].z()));
    }
    reference.twist[static_cast<std::size_t>(steps)] = reference.twist[static_cast<std::size_t>(steps - 1)];
    return reference;
  }
};

inline MpcInstance make_mpc_instance(std::uint64_t seed, const MpcInstanceOptions& options) {
  RandomStream random{mix(seed, 1)};
  MpcInstance instance;
  instance.robot.drive = options.drive;
  instance.robot.wheels = options.wheels;
  instance.robot.wheel_arm = options.wheel_arm;
  instance.parameters.horizon = options.horizon;
  instance.parameters.heading_weight = 10.0;
  instance.parameters.effort_weight = 0.05;
  instance.parameters.rate_weight = options.rate_weight;
  const Drive drive{instance.robot};
  const CurvedReference curve{random};
  MpcProblem& problem = instance.problem;
  problem.reference = curve.sample(random.uniform(0.0, 10.0), instance.parameters.dt, options.horizon, drive);

  const double angle = random.uniform(-3.14, 3.14);
  const double distance = options.position_error * std::sqrt(random.uniform());
  problem.initial_pose = problem.reference.pose[0];
  problem.initial_pose += Eigen::Vector3d{distance * std::cos(angle), distance * std::sin(angle),
                                          random.uniform(-options.heading_error, options.heading_error)};
  problem.previous_wheel_speeds = drive.standstill();
  for (int i = 0; i < std::max(3, drive.inputs()); ++i) {
    if (i < 3) problem.disturbance[i] = random.uniform(-options.disturbance, options.disturbance);
    if (i < drive.inputs())
      problem.previous_wheel_speeds[i] = random.uniform(drive.lower()[i], drive.upper()[i]) / 1.5;
  }
  if (random.uniform() < options.wall_share) {
    const double ahead = random.uniform(options.wall_ahead_low, options.wall_ahead_high);
    const Eigen::Vector3d travel =
        problem.reference.pose[static_cast<std::size_t>(options.horizon)] - problem.reference.pose[0];
    MpcParameters& parameters = instance.parameters;
    if (std::abs(travel.x()) > std::abs(travel.y())) {
      if (travel.x() > 0.0)
        parameters.x_upper = problem.initial_pose.x() + ahead;
      else
        parameters.x_lower = problem.initial_pose.x() - ahead;
    } else {
      if (travel.y() > 0.0)
        parameters.y_upper = problem.initial_pose.y() + ahead;
      else
        parameters.y_lower = problem.initial_pose.y() - ahead;
    }
  }
  return instance;
}

}  // namespace spf
