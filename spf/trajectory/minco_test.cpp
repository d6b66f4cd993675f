#include "spf/trajectory/minco.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/math/lbfgs.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/testing/allocation_guard.hpp"
#include "spf/testing/dense_oracle.hpp"
#include "spf/testing/gradient_check.hpp"
#include "spf/trajectory/decision_vector.hpp"

namespace spf {
namespace {

struct Problem {
  MincoEnds ends;
  Eigen::Matrix2Xd waypoints;
  Eigen::VectorXd durations;
};

FlatState draw_state(RandomStream& random, double x) {
  FlatState state;
  state.position_world = Eigen::Vector2d{x, 0.0} + 0.5 * random.normal2();
  state.velocity_world = random.normal2();
  state.acceleration_world = random.normal2();
  return state;
}

/// Walking-pace motions: waypoints about 1 m apart, pieces of 0.3 to 3 s.
Problem draw_problem(RandomStream& random, int pieces) {
  Problem problem;
  problem.ends.head = draw_state(random, 0.0);
  problem.ends.tail = draw_state(random, pieces);
  problem.waypoints.resize(2, pieces - 1);
  problem.durations.resize(pieces);
  for (int i = 0; i + 1 < pieces; ++i)
    problem.waypoints.col(i) = Eigen::Vector2d{i + 1.0, 0.0} + 0.5 * random.normal2();
  for (int i = 0; i < pieces; ++i) problem.durations[i] = random.uniform(0.3, 3.0);
  return problem;
}

Minco solved(const Problem& problem) {
  Minco minco;
  minco.solve(problem.ends, problem.waypoints, problem.durations);
  return minco;
}

/// k-th derivative of t^power at t.
double power_derivative(int power, int k, double t) {
  double factor = 1.0;
  for (int j = 0; j < k; ++j) factor *= power - j;
  return power < k ? 0.0 : factor * std::pow(t, power - k);
}

/// Oracle: the conditions written down one by one in another order (ends, waypoints, continuity of order 0 to
/// 4), solved densely with full pivoting.
Eigen::MatrixXd dense_coefficients(const Problem& problem) {
  const int n = static_cast<int>(problem.durations.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(6 * n, 2);
  int row = 0;
  const auto add_derivative = [&](int piece, int order, double t, double sign) {
    for (int power = 0; power < 6; ++power)
      matrix(row, 6 * piece + power) += sign * power_derivative(power, order, t);
  };
  const auto fix = [&](int piece, int order, double t, const Eigen::Vector2d& value) {
    add_derivative(piece, order, t, 1.0);
    right.row(row++) = value.transpose();
  };
  const double last = problem.durations[n - 1];
  fix(n - 1, 2, last, problem.ends.tail.acceleration_world);
  fix(n - 1, 1, last, problem.ends.tail.velocity_world);
  fix(n - 1, 0, last, problem.ends.tail.position_world);
  fix(0, 2, 0.0, problem.ends.head.acceleration_world);
  fix(0, 1, 0.0, problem.ends.head.velocity_world);
  fix(0, 0, 0.0, problem.ends.head.position_world);
  for (int i = 0; i + 1 < n; ++i) {
    fix(i + 1, 0, 0.0, problem.waypoints.col(i));
    for (int order = 0; order <= 4; ++order) {
      add_derivative(i, order, problem.durations[i], 1.0);
      add_derivative(i + 1, order, 0.0, -1.0);
      ++row;
    }
  }
  return solve_densely(matrix, right);
}

Eigen::Vector2d derivative(const QuinticPiece& piece, int order, double t) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int k = 0; k < 6; ++k) sum += power_derivative(k, order, t) * piece.coefficients.row(k).transpose();
  return sum;
}

TEST(Minco, AgreesWithADenseSolve) {
  RandomStream random{1};
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const int pieces = 1 + i % Minco::kMaxPieces;
    const Problem problem = draw_problem(random, pieces);
    const Eigen::MatrixXd expected = dense_coefficients(problem);
    // Condition numbers reach 4e5, times rounding 1e-16; measured 1.1e-13.
    EXPECT_LT((solved(problem).coefficients() - expected).norm(), 1e-11 * expected.norm());
  }
}

TEST(Minco, MeetsEndsAndWaypoints) {
  RandomStream random{2};
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const int pieces = 1 + i % Minco::kMaxPieces;
    const Problem problem = draw_problem(random, pieces);
    const Trajectory trajectory = solved(problem).trajectory(10.0);
    ASSERT_EQ(trajectory.piece_count(), pieces);
    EXPECT_EQ(trajectory.start_time(), 10.0);
    EXPECT_NEAR(trajectory.duration(), problem.durations.sum(), 1e-12);
    const QuinticPiece& first = trajectory.piece(0);
    const QuinticPiece& last = trajectory.piece(pieces - 1);
    EXPECT_EQ(first.position(0.0), problem.ends.head.position_world);
    EXPECT_EQ(first.velocity(0.0), problem.ends.head.velocity_world);
    EXPECT_LT((first.acceleration(0.0) - problem.ends.head.acceleration_world).norm(), 1e-14);
    // Backward errors of the solve; measured 3e-14.
    EXPECT_LT((last.position(last.duration) - problem.ends.tail.position_world).norm(), 1e-12);
    EXPECT_LT((last.velocity(last.duration) - problem.ends.tail.velocity_world).norm(), 1e-12);
    EXPECT_LT((last.acceleration(last.duration) - problem.ends.tail.acceleration_world).norm(), 1e-12);
    for (int k = 0; k + 1 < pieces; ++k)
      EXPECT_LT((trajectory.piece(k + 1).position(0.0) - problem.waypoints.col(k)).norm(), 1e-12);
  }
}

TEST(Minco, IsSmoothAcrossWaypoints) {
  RandomStream random{3};
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const Trajectory trajectory = solved(draw_problem(random, 2 + i % 15)).trajectory(0.0);
    for (int k = 0; k + 1 < trajectory.piece_count(); ++k)
      for (int order = 0; order <= 4; ++order) {
        const Eigen::Vector2d before = derivative(trajectory.piece(k), order, trajectory.piece(k).duration);
        const Eigen::Vector2d after = derivative(trajectory.piece(k + 1), order, 0.0);
        // Measured 1e-13.
        EXPECT_LT((before - after).norm(), 1e-11 * (1.0 + after.norm()))
            << "waypoint " << k << " order " << order;
      }
  }
}

TEST(Minco, KeepsPrecisionForShortAndLongPieces) {
  RandomStream random{4};
  for (const double scale : {0.02, 0.1, 10.0, 30.0}) {
    SCOPED_TRACE(scale);
    for (int i = 0; i < 20; ++i) {
      Problem problem = draw_problem(random, 8);
      problem.durations *= scale;
      const Trajectory trajectory = solved(problem).trajectory(0.0);
      for (int k = 0; k + 1 < 8; ++k) {
        const QuinticPiece& piece = trajectory.piece(k);
        // Measured 6e-12, at the longest.
        EXPECT_LT((piece.position(piece.duration) - problem.waypoints.col(k)).norm(), 1e-10);
      }
      EXPECT_LT((trajectory.tail_position() - problem.ends.tail.position_world).norm(), 1e-10);
    }
  }
}

TEST(Minco, SinglePieceIsTheClosedFormQuintic) {
  MincoEnds ends;  // rest to rest over 2 m in 1 s: 2 (10 t^3 - 15 t^4 + 6 t^5)
  ends.tail.position_world = {2.0, 0.0};
  Minco minco;
  minco.solve(ends, Eigen::Matrix2Xd(2, 0), Eigen::VectorXd::Ones(1));
  Eigen::Matrix<double, 6, 1> expected;
  expected << 0.0, 0.0, 0.0, 20.0, -30.0, 12.0;
  EXPECT_LT((minco.coefficients().col(0) - expected).norm(), 1e-13);
  EXPECT_EQ(minco.coefficients().col(1).norm(), 0.0);
  EXPECT_NEAR(minco.smoothness(), 720.0 * 4.0, 1e-10);  // 720 d^2 / T^5
}

TEST(Minco, SmoothnessIsTheIntegralOfSquaredJerk) {
  RandomStream random{5};
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    const Minco minco = solved(draw_problem(random, 1 + i % 6));
    const Trajectory trajectory = minco.trajectory(0.0);
    double integral = 0.0;  // Boole's rule, exact up to degree 5, on two halves; the integrand has degree 4
    for (int k = 0; k < trajectory.piece_count(); ++k) {
      const QuinticPiece& piece = trajectory.piece(k);
      const double h = piece.duration / 4.0;
      const double weights[] = {7.0, 32.0, 12.0, 32.0, 7.0};
      for (int s = 0; s < 5; ++s) integral += 2.0 * h / 45.0 * weights[s] * piece.jerk(s * h).squaredNorm();
    }
    EXPECT_NEAR(minco.smoothness(), integral, 1e-10 * integral);
  }
}

TEST(Minco, NoCurveThroughTheSamePointsHasLessJerk) {
  // Two kinds of competitor: one with other velocities and accelerations at the waypoints, and one with a
  // bump inside a piece that vanishes with its first two derivatives at both its ends.
  RandomStream random{6};
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const int pieces = 2 + i % 5;
    const Problem problem = draw_problem(random, pieces);
    const Minco minco = solved(problem);
    const Trajectory trajectory = minco.trajectory(0.0);

    // The competitor: each piece a quintic with its own velocity and acceleration at the waypoints.
    Eigen::Matrix2Xd velocities(2, pieces + 1);
    Eigen::Matrix2Xd accelerations(2, pieces + 1);
    Eigen::Matrix2Xd positions(2, pieces + 1);
    const double size = std::pow(10.0, random.uniform(-2.0, 0.5));
    for (int k = 0; k <= pieces; ++k) {
      const bool inner = 0 < k && k < pieces;
      const QuinticPiece& piece = trajectory.piece(std::min(k, pieces - 1));
      const double t = k < pieces ? 0.0 : piece.duration;
      positions.col(k) = piece.position(t);
      velocities.col(k) = piece.velocity(t);
      accelerations.col(k) = piece.acceleration(t);
      if (!inner) continue;
      velocities.col(k) += size * random.normal2();
      accelerations.col(k) += size * random.normal2();
    }
    double energy = 0.0;
    for (int k = 0; k < pieces; ++k) {
      MincoEnds ends;
      ends.head = {positions.col(k), velocities.col(k), accelerations.col(k)};
      ends.tail = {positions.col(k + 1), velocities.col(k + 1), accelerations.col(k + 1)};
      Minco single;
      single.solve(ends, Eigen::Matrix2Xd(2, 0), problem.durations.segment(k, 1));
      energy += single.smoothness();
    }
    EXPECT_GT(energy, minco.smoothness());

    // And within a piece: a bump e (t (T - t))^3 u, jerk integral by fine Simpson (degree 10 against 200
    // intervals).
    const QuinticPiece& piece = trajectory.piece(i % pieces);
    const double t_end = piece.duration;
    const Eigen::Vector2d bump = size * random.normal2();
    const auto squared_jerk = [&](double t) {
      const double w = t_end;  // third derivative of (t (w - t))^3
      const double third = 6.0 * w * w * w - 72.0 * w * w * t + 180.0 * w * t * t - 120.0 * t * t * t;
      return (piece.jerk(t) + third * bump).squaredNorm() - piece.jerk(t).squaredNorm();
    };
    double difference = 0.0;
    constexpr int kIntervals = 200;
    for (int s = 0; s < kIntervals; ++s) {
      const double h = t_end / kIntervals;
      difference +=
          h / 6.0 * (squared_jerk(s * h) + 4.0 * squared_jerk((s + 0.5) * h) + squared_jerk((s + 1) * h));
    }
    EXPECT_GT(difference, 0.0);
  }
}

/// A cost of many things: smoothness, time, and non-linear functions of all derivatives at points inside the
/// pieces.
struct MixedCost {
  double operator()(const Minco& minco, Minco::Coefficients& wrt_coefficients,
                    Minco::Durations& wrt_durations) const {
    wrt_coefficients.setZero(6 * minco.piece_count(), 2);
    wrt_durations.setConstant(minco.piece_count(), 3.0);
    double cost = 0.1 * minco.smoothness() + 3.0 * minco.durations().sum();
    minco.add_smoothness_gradient(0.1, wrt_coefficients, wrt_durations);
    const Trajectory trajectory = minco.trajectory(0.0);
    for (int i = 0; i < trajectory.piece_count(); ++i)
      for (const double share : {0.0, 0.3, 0.8}) {
        const QuinticPiece& piece = trajectory.piece(i);
        const double t = share * piece.duration;
        for (int order = 0; order < 3; ++order) {
          const Eigen::Vector2d value = derivative(piece, order, t);
          const Eigen::Vector2d slope{std::cos(value.x()), value.y()};
          cost += std::sin(value.x()) + 0.5 * value.y() * value.y();
          for (int power = 0; power < 6; ++power)
            wrt_coefficients.row(6 * i + power) += power_derivative(power, order, t) * slope.transpose();
          wrt_durations[i] += share * slope.dot(derivative(piece, order + 1, t));
        }
      }
    return cost;
  }
};

TEST(Minco, GradientByWaypointsAndTausMatchesCentralDifferences) {
  RandomStream random{7};
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const int pieces = 1 + i % 8;
    const Problem problem = draw_problem(random, pieces);
    const DecisionLayout layout{pieces};
    Eigen::VectorXd decision(layout.size());
    layout.pack(problem.waypoints, problem.durations, decision);
    Minco minco;
    Minco::Coefficients wrt_coefficients;
    Minco::Durations wrt_durations;
    const auto cost = [&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
      minco.solve(problem.ends, layout.waypoints(x), layout.durations(x));
      const double value = MixedCost{}(minco, wrt_coefficients, wrt_durations);
      layout.pack_gradient(minco.propagate(wrt_coefficients, wrt_durations), x, gradient);
      return value;
    };
    EXPECT_LT(check_gradient(cost, decision).relative_error, 2e-7);  // measured 1.2e-8, allowed 15x
  }
}

TEST(Minco, GradientByDurationsAndTailMatchesCentralDifferences) {
  RandomStream random{8};
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const int pieces = 1 + i % 8;
    const Problem problem = draw_problem(random, pieces);
    Eigen::VectorXd x(pieces + 4);  // durations, tail position, tail velocity
    x << problem.durations, problem.ends.tail.position_world, problem.ends.tail.velocity_world;
    Minco minco;
    Minco::Coefficients wrt_coefficients;
    Minco::Durations wrt_durations;
    const auto cost = [&](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
      MincoEnds ends = problem.ends;
      ends.tail.position_world = at.segment<2>(pieces);
      ends.tail.velocity_world = at.segment<2>(pieces + 2);
      minco.solve(ends, problem.waypoints, at.head(pieces));
      const double value = MixedCost{}(minco, wrt_coefficients, wrt_durations);
      const MincoGradient propagated = minco.propagate(wrt_coefficients, wrt_durations);
      gradient << propagated.durations, propagated.tail_position, propagated.tail_velocity;
      return value;
    };
    EXPECT_LT(check_gradient(cost, x).relative_error, 2e-7);  // measured 1.2e-8, allowed 15x
  }
}

TEST(Minco, DescentFindsTheBestTimeAndPositionOfWaypoints) {
  // Rest to rest over a distance D at w per second: 720 D^2 / T^5 + w T is least at T = (3600 D^2 / w)^(1/6).
  // Waypoints that are free in position and time cannot beat the single quintic, and can lie on it.
  constexpr double kDistance = 3.0;
  constexpr double kTimeWeight = 10.0;
  const double best_time = std::pow(3600.0 * kDistance * kDistance / kTimeWeight, 1.0 / 6.0);
  const double best_cost = 720.0 * kDistance * kDistance / std::pow(best_time, 5) + kTimeWeight * best_time;
  RandomStream random{12};
  for (int pieces = 1; pieces <= 5; ++pieces) {
    SCOPED_TRACE(pieces);
    Problem problem = draw_problem(random, pieces);
    problem.ends = MincoEnds{};
    problem.ends.tail.position_world = {kDistance, 0.0};
    const DecisionLayout layout{pieces};
    Eigen::VectorXd decision(layout.size());
    layout.pack(problem.waypoints, problem.durations, decision);
    Minco minco;
    Minco::Coefficients wrt_coefficients;
    Minco::Durations wrt_durations;
    const auto cost = [&](const Lbfgs::Point& x, Lbfgs::Gradient gradient) {
      minco.solve(problem.ends, layout.waypoints(x), layout.durations(x));
      wrt_coefficients.setZero(6 * pieces, 2);
      wrt_durations.setConstant(pieces, kTimeWeight);
      minco.add_smoothness_gradient(1.0, wrt_coefficients, wrt_durations);
      layout.pack_gradient(minco.propagate(wrt_coefficients, wrt_durations), x, gradient);
      return minco.smoothness() + kTimeWeight * minco.durations().sum();
    };
    LbfgsParameters parameters;
    parameters.past = 0;
    parameters.max_iterations = 2000;
    Lbfgs lbfgs{layout.size(), parameters};
    const AllocationGuard guard;
    const LbfgsResult result = lbfgs.minimize(decision, cost);
    EXPECT_EQ(guard.allocations(), 0);
    EXPECT_EQ(result.outcome, LbfgsOutcome::converged);
    EXPECT_NEAR(result.cost, best_cost, 1e-7 * best_cost);  // gradient 1e-5, squared over the curvature
    EXPECT_NEAR(layout.durations(decision).sum(), best_time, 1e-3);
  }
}

TEST(Minco, ExtremeDurationsGiveNoFiniteCost) {
  RandomStream random{13};
  for (const double extreme : {0.0, 1e-80, 1e80, std::numeric_limits<double>::infinity(), std::nan("")}) {
    SCOPED_TRACE(extreme);
    Problem problem = draw_problem(random, 3);
    problem.durations[1] = extreme;
    EXPECT_FALSE(std::isfinite(solved(problem).smoothness()));
  }
}

TEST(Minco, TurnsWithItsScene) {
  RandomStream random{9};
  const Eigen::Matrix2d turn = Eigen::Rotation2D<double>{0.8}.toRotationMatrix();
  const Problem problem = draw_problem(random, 5);
  Problem turned = problem;
  for (FlatState* state : {&turned.ends.head, &turned.ends.tail}) {
    state->position_world = turn * state->position_world;
    state->velocity_world = turn * state->velocity_world;
    state->acceleration_world = turn * state->acceleration_world;
  }
  turned.waypoints = turn * problem.waypoints;
  const Eigen::MatrixXd expected = solved(problem).coefficients() * turn.transpose();
  EXPECT_LT((solved(turned).coefficients() - expected).norm(), 1e-9 * expected.norm());
}

TEST(Minco, DoesNotAllocateOnceBuilt) {
  RandomStream random{10};
  const Problem problem = draw_problem(random, Minco::kMaxPieces);
  const DecisionLayout layout{Minco::kMaxPieces};
  Eigen::VectorXd decision(layout.size());
  Eigen::VectorXd gradient(layout.size());
  layout.pack(problem.waypoints, problem.durations, decision);
  Minco minco;
  Minco::Coefficients wrt_coefficients;
  Minco::Durations wrt_durations;

  const AllocationGuard guard;
  minco.solve(problem.ends, layout.waypoints(decision), layout.durations(decision));
  wrt_coefficients.setZero(6 * minco.piece_count(), 2);
  wrt_durations.setZero(minco.piece_count());
  const double smoothness = minco.smoothness();
  minco.add_smoothness_gradient(1.0, wrt_coefficients, wrt_durations);
  layout.pack_gradient(minco.propagate(wrt_coefficients, wrt_durations), decision, gradient);
  const Trajectory trajectory = minco.trajectory(0.0);
  EXPECT_EQ(guard.allocations(), 0);
  EXPECT_GT(smoothness, 0.0);
  EXPECT_EQ(trajectory.piece_count(), Minco::kMaxPieces);
}

}  // namespace
}  // namespace spf
