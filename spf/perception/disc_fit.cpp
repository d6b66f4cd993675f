#include "spf/perception/disc_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "spf/math/plane.hpp"

namespace spf {
namespace {

constexpr int kMostSteps = 12;
constexpr double kLeastRadius = 0.005;  // [m]

/// Half the sum of squares near a guess, as a quadratic.
struct NormalEquations {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double cost = 0.0;  // the sum of squares

  void add(const Eigen::Vector3d& slope, double residual, double sigma) {
    const double weight = 1.0 / (sigma * sigma);
    matrix.noalias() += weight * slope * slope.transpose();
    gradient += weight * residual * slope;
    cost += weight * residual * residual;
  }
};

/// The mean return and the viewing direction.
struct Sight {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Vector2d away = Eigen::Vector2d::UnitX();  // unit vector from the sensor
};

Sight sight_of(const DiscFitProblem& problem) {
  Sight sight;
  for (int k = 0; k < problem.count; ++k) sight.mean += problem.returns[k].position_world;
  sight.mean /= problem.count;
  const Eigen::Vector2d offset = sight.mean - problem.sensor_world;
  const double distance = offset.norm();
  if (distance > 1e-9) sight.away = offset / distance;
  return sight;
}

NormalEquations linearise(const DiscFitProblem& problem, const Sight& sight, const Eigen::Vector3d& guess) {
  NormalEquations equations;
  const Eigen::Vector2d centre = guess.head<2>();
  for (int k = 0; k < problem.count; ++k) {
    const Eigen::Vector2d outward = problem.returns[k].position_world - centre;
    const double distance = std::max(outward.norm(), 1e-9);
    equations.add({-outward.x() / distance, -outward.y() / distance, -1.0}, distance - guess.z(),
                  problem.range_sigma);
  }
  for (const TangentRay& tangent : problem.tangents) {
    if (tangent.side == 0.0) continue;
    const Eigen::Vector2d normal = tangent.side * left_of(tangent.ray.direction_world);
    const double gap = normal.dot(centre - tangent.ray.origin_world);
    equations.add({normal.x(), normal.y(), -1.0}, gap - guess.z(), tangent.sigma);
  }
  equations.add({0.0, 0.0, 1.0}, guess.z() - problem.prior_radius, problem.prior_radius_sigma);
  const Eigen::Vector2d beside = left_of(sight.away);
  equations.add({beside.x(), beside.y(), 0.0}, beside.dot(centre - sight.mean), problem.prior_radius);
  return equations;
}

double rms_of(const DiscFitProblem& problem, const Eigen::Vector3d& solution) {
  double squares = 0.0;
  for (int k = 0; k < problem.count; ++k) {
    const double error = (problem.returns[k].position_world - solution.head<2>()).norm() - solution.z();
    squares += error * error;
  }
  return std::sqrt(squares / problem.count);
}

}  // namespace

DiscFit fit_disc(const DiscFitProblem& problem) {
  const Sight sight = sight_of(problem);
  Eigen::Vector3d guess;
  guess << sight.mean + 0.8 * problem.prior_radius * sight.away, problem.prior_radius;
  NormalEquations equations = linearise(problem, sight, guess);
  double damping = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::Matrix3d damped = equations.matrix;
    damped.diagonal() += damping * equations.matrix.diagonal() + Eigen::Vector3d::Constant(1e-6);
    const Eigen::Vector3d change = -damped.inverse() * equations.gradient;
    Eigen::Vector3d next = guess + change;
    next.z() = std::max(next.z(), kLeastRadius);
    const double depth = sight.away.dot(next.head<2>() - sight.mean);
    if (depth < 0.0) next.head<2>() -= depth * sight.away;  // a sensor sees the near side
    const NormalEquations there = linearise(problem, sight, next);
    if (!(there.cost <= equations.cost)) {
      damping = std::max(4.0 * damping, 0.1);
      continue;
    }
    damping *= 0.25;
    guess = next;
    equations = there;
    if (change.squaredNorm() < 1e-10) break;
  }
  DiscFit fit;
  fit.centre_world = guess.head<2>();
  fit.radius = guess.z();
  equations.matrix.diagonal().array() += 1e-6;
  fit.covariance = equations.matrix.inverse();
  fit.rms = rms_of(problem, guess);
  return fit;
}

}  // namespace spf
