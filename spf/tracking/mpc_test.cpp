#include "spf/tracking/mpc.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spf/math/angles.hpp"
#include "spf/testing/allocation_guard.hpp"
#include "spf/tracking/test/mpc_instances.hpp"

namespace spf {
namespace {

using Eigen::Vector3d;

/// Cost of eq. 19 in our reading, written down once more from the definition.
double cost_of(const MpcInstance& instance, const DriveInputs& inputs) {
  const MpcParameters& p = instance.parameters;
  const Drive drive{instance.robot};
  Vector3d pose = instance.problem.initial_pose;
  Vector3d before = instance.problem.previous_wheel_speeds;
  double cost = 0.0;
  for (int k = 0; k < p.horizon; ++k) {
    const auto i = static_cast<std::size_t>(k);
    pose += p.dt * (drive.twist_world(inputs[i], pose.z()) + instance.problem.disturbance);
    const Vector3d error = pose - instance.problem.reference.pose[i + 1];
    cost += p.position_weight * error.head<2>().squaredNorm() + p.heading_weight * error.z() * error.z();
    cost += p.effort_weight * (inputs[i] - instance.problem.reference.wheel_speeds[i]).squaredNorm();
    cost += p.rate_weight * (inputs[i] - before).squaredNorm();
    const double bounds[2][2] = {{p.x_lower, p.x_upper}, {p.y_lower, p.y_upper}};
    for (int axis = 0; axis < 2; ++axis) {
      const double out = std::max({0.0, bounds[axis][0] - pose[axis], pose[axis] - bounds[axis][1]});
      cost += p.slack_weight * out * out;
    }
    before = inputs[i];
  }
  return cost;
}

double difference_quotient(const MpcInstance& instance, const DriveInputs& inputs, std::size_t k, int i,
                           double step) {
  DriveInputs plus = inputs;
  DriveInputs minus = inputs;
  plus[k][i] += step;
  minus[k][i] -= step;
  return (cost_of(instance, plus) - cost_of(instance, minus)) / (2.0 * step);
}

MpcInstanceOptions mixed_options(int index) {
  MpcInstanceOptions options;
  options.horizon = index % 3 == 0 ? 10 : 5;
  options.wall_share = 0.5;
  options.wall_ahead_low = -0.2;
  options.disturbance = 0.2;
  options.rate_weight = index % 2 == 0 ? 0.05 : 0.0;
  return options;
}

TEST(Mpc, SolutionMeetsTheOptimalityConditions) {
  int at_limit = 0;
  int leaning = 0;
  for (int n = 0; n < 300; ++n) {
    SCOPED_TRACE(n);
    MpcInstance instance = make_mpc_instance(mix(31, static_cast<std::uint64_t>(n)), mixed_options(n));
    instance.parameters.iterations = 40;
    instance.parameters.tolerance = 1e-9;
    const double limit = instance.robot.max_wheel_speed;
    ModelPredictiveController mpc{instance.parameters, Drive{instance.robot}};
    const MpcResult& result = mpc.solve(instance.problem);
    ASSERT_EQ(result.status, MpcStatus::converged);
    EXPECT_NEAR(result.cost, cost_of(instance, result.wheel_speeds), 1e-10 * (1.0 + result.cost));
    if (result.largest_violation > 0.0) ++leaning;
    for (int k = 0; k < instance.parameters.horizon; ++k)
      for (int i = 0; i < 3; ++i) {
        const auto index = static_cast<std::size_t>(k);
        const double input = result.wheel_speeds[index][i];
        ASSERT_LE(std::abs(input), limit);
        // Central differences of a cost up to 1e3 with a step of 1e-6: rounding 1e3 * 2e-16 / 1e-6 = 2e-7; a
        // kink of the soft bound (curvature 2e5 * (dt * 2/3)^2 = 1e3) inside the step: 1e3 * 1e-6 = 1e-3.
        const double slope = difference_quotient(instance, result.wheel_speeds, index, i, 1e-6);
        if (input >= limit - 1e-12) {
          EXPECT_LT(slope, 3e-3);
          ++at_limit;
        } else if (input <= -limit + 1e-12) {
          EXPECT_GT(slope, -3e-3);
          ++at_limit;
        } else {
          EXPECT_NEAR(slope, 0.0, 3e-3);
        }
      }
  }
  EXPECT_GT(at_limit, 100);
  EXPECT_GT(leaning, 50);
}

// The adjoint gradient behind the residual, at points that are no optimum.
TEST(Mpc, ReportsTheResidualOfTheNonlinearProblem) {
  for (int n = 0; n < 100; ++n) {
    SCOPED_TRACE(n);
    MpcInstanceOptions options = mixed_options(n);
    options.wall_share = 0.0;
    options.heading_error = 0.6;
    MpcInstance instance = make_mpc_instance(mix(32, static_cast<std::uint64_t>(n)), options);
    instance.parameters.iterations = 1;  // one linearisation about the reference: not yet optimal
    ModelPredictiveController mpc{instance.parameters, Drive{instance.robot}};
    const MpcResult result = mpc.solve(instance.problem);
    const double limit = instance.robot.max_wheel_speed;
    double expected = 0.0;
    for (int k = 0; k < instance.parameters.horizon; ++k)
      for (int i = 0; i < 3; ++i) {
        const auto index = static_cast<std::size_t>(k);
        const double input = result.wheel_speeds[index][i];
        const double slope = difference_quotient(instance, result.wheel_speeds, index, i, 1e-5);
        expected = std::max(expected, std::abs(std::clamp(input - slope, -limit, limit) - input));
      }
    // Truncation 1e-10 times third derivatives, rounding 1e2 * 2e-16 / 1e-5.
    EXPECT_NEAR(result.optimality_residual, expected, 1e-7);
    EXPECT_EQ(result.iterations, 1);
  }
}

TEST(Mpc, FollowsAReferenceItStandsOnExactly) {
  MpcInstanceOptions options;
  options.position_error = 0.0;
  options.heading_error = 0.0;
  options.wall_share = 0.0;
  for (std::uint64_t n = 0; n < 50; ++n) {
    const MpcInstance instance = make_mpc_instance(mix(33, n), options);
    ModelPredictiveController mpc{instance.parameters, Drive{instance.robot}};
    const MpcResult& result = mpc.solve(instance.problem);
    EXPECT_LT(result.cost, 1e-20);
    EXPECT_LT((result.wheel_speeds[0] - instance.problem.reference.wheel_speeds[0]).norm(), 1e-10);
    EXPECT_EQ(result.status, MpcStatus::converged);
  }
}

// The paper's literal effort term would pull towards standstill; ours must not, and a known disturbance is
// cancelled.
TEST(Mpc, CancelsTheDisturbanceItIsTold) {
  MpcInstanceOptions options;
  options.position_error = 0.0;
  options.heading_error = 0.0;
  options.wall_share = 0.0;
  MpcInstance instance = make_mpc_instance(34, options);
  instance.parameters.effort_weight = 1e-6;
  instance.problem.disturbance = {0.1, -0.05, 0.2};
  instance.parameters.iterations = 20;
  const Drive drive{instance.robot};
  ModelPredictiveController mpc{instance.parameters, drive};
  const MpcResult& result = mpc.solve(instance.problem);
  // With next to no effort weight every z_k is on its reference: left over is the weights' ratio, 1e-6 / (10
  // dt^2).
  for (std::size_t k = 1; k <= 5; ++k)
    EXPECT_LT((result.pose[k] - instance.problem.reference.pose[k]).norm(), 1e-5);
}

TEST(Mpc, TurnsWithTheScene) {
  for (std::uint64_t n = 0; n < 50; ++n) {
    MpcInstanceOptions options;
    options.wall_share = 0.0;
    options.disturbance = 0.2;
    MpcInstance instance = make_mpc_instance(mix(35, n), options);
    instance.parameters.iterations = 30;
    instance.parameters.tolerance = 1e-11;
    MpcInstance turned = instance;
    const double angle = 1.234;
    const Eigen::Matrix3d rotation = world_from_body(angle);
    turned.problem.initial_pose = rotation * instance.problem.initial_pose + Vector3d{3.0, -4.0, angle};
    turned.problem.disturbance = rotation * instance.problem.disturbance;
    for (std::size_t k = 0; k <= 5; ++k)
      turned.problem.reference.pose[k] =
          rotation * instance.problem.reference.pose[k] + Vector3d{3.0, -4.0, angle};
    const Drive drive{instance.robot};
    ModelPredictiveController first{instance.parameters, drive};
    ModelPredictiveController second{turned.parameters, drive};
    const Vector3d expected = first.solve(instance.problem).wheel_speeds[0];
    EXPECT_LT((second.solve(turned.problem).wheel_speeds[0] - expected).norm(), 1e-8);
  }
}

TEST(Mpc, WarmStartDoesNotChangeTheAnswer) {
  MpcInstanceOptions options;
  options.horizon = 10;
  options.wall_share = 1.0;
  MpcInstance instance = make_mpc_instance(36, options);
  instance.parameters.iterations = 40;
  instance.parameters.tolerance = 1e-10;
  const Drive drive{instance.robot};
  ModelPredictiveController warm{instance.parameters, drive};
  RandomStream random{5};
  int fewer = 0;
  for (int step = 0; step < 100; ++step) {
    ModelPredictiveController cold{instance.parameters, drive};
    const MpcResult& expected = cold.solve(instance.problem);
    const MpcResult& result = warm.solve(instance.problem);
    EXPECT_LT((result.wheel_speeds[0] - expected.wheel_speeds[0]).norm(), 1e-7) << step;
    if (result.active_set_steps < expected.active_set_steps) ++fewer;
    for (int i = 0; i < 3; ++i) instance.problem.initial_pose[i] += 0.02 * random.normal();
  }
  EXPECT_GT(fewer, 0);
}

TEST(Mpc, RateWeightSmoothsTheInputs) {
  MpcInstanceOptions options;
  options.wall_share = 0.0;
  double plain = 0.0;
  double smooth = 0.0;
  for (std::uint64_t n = 0; n < 50; ++n) {
    for (const double weight : {0.0, 1.0}) {
      options.rate_weight = weight;
      const MpcInstance instance = make_mpc_instance(mix(37, n), options);
      ModelPredictiveController mpc{instance.parameters, Drive{instance.robot}};
      const Vector3d step =
          mpc.solve(instance.problem).wheel_speeds[0] - instance.problem.previous_wheel_speeds;
      (weight > 0.0 ? smooth : plain) += step.norm();
    }
  }
  EXPECT_LT(smooth, 0.7 * plain);
}

TEST(Mpc, StandsOnInputThatIsNotANumber) {
  MpcInstance instance = make_mpc_instance(38, MpcInstanceOptions{});
  ModelPredictiveController mpc{instance.parameters, Drive{instance.robot}};
  const MpcProblem good = instance.problem;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  MpcProblem bad = good;
  bad.initial_pose.x() = nan;
  EXPECT_EQ(mpc.solve(bad).status, MpcStatus::invalid_problem);
  EXPECT_EQ(mpc.solve(bad).wheel_speeds[0], Vector3d::Zero());
  bad = good;
  bad.reference.pose[3].z() = nan;
  EXPECT_EQ(mpc.solve(bad).status, MpcStatus::invalid_problem);
  bad = good;
  bad.reference.steps = 4;
  EXPECT_EQ(mpc.solve(bad).status, MpcStatus::invalid_problem);
  EXPECT_NE(mpc.solve(good).status, MpcStatus::invalid_problem);  // and recovers
}

TEST(Mpc, GivesAFeasibleCommandWhenItRunsOutOfSteps) {
  for (std::uint64_t n = 0; n < 200; ++n) {
    MpcInstanceOptions options;
    options.horizon = 20;
    options.wall_share = 1.0;
    options.wall_ahead_low = -0.5;
    options.position_error = 1.0;
    MpcInstance instance = make_mpc_instance(mix(39, n), options);
    instance.parameters.active_set_steps = 1;
    ModelPredictiveController mpc{instance.parameters, Drive{instance.robot}};
    const MpcResult& result = mpc.solve(instance.problem);
    EXPECT_NE(result.status, MpcStatus::invalid_problem);
    // No worse than driving the reference's wheel speeds.
    EXPECT_LE(result.cost, cost_of(instance, instance.problem.reference.wheel_speeds) * (1.0 + 1e-9));
    for (int k = 0; k < 20; ++k)
      EXPECT_LE(result.wheel_speeds[static_cast<std::size_t>(k)].cwiseAbs().maxCoeff(),
                instance.robot.max_wheel_speed);
  }
}

TEST(Mpc, DoesNotAllocate) {
  MpcInstanceOptions options;
  options.horizon = 20;
  options.wall_share = 1.0;
  const MpcInstance instance = make_mpc_instance(40, options);
  ModelPredictiveController mpc{instance.parameters, Drive{instance.robot}};
  const AllocationGuard guard;
  for (int i = 0; i < 10; ++i) mpc.solve(instance.problem);
  EXPECT_EQ(guard.allocations(), 0);
}

TEST(Mpc, RefusesParametersOutOfRange) {
  const Drive drive{RobotParameters{}};
  MpcParameters parameters;
  parameters.horizon = 21;
  EXPECT_THROW((ModelPredictiveController{parameters, drive}), std::invalid_argument);
  parameters = MpcParameters{};
  parameters.x_lower = 2.0;
  parameters.x_upper = 1.0;
  EXPECT_THROW((ModelPredictiveController{parameters, drive}), std::invalid_argument);
}

}  // namespace
}  // namespace spf
