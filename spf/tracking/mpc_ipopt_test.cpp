// The MPC against Ipopt on the same nonlinear problem with soft state bounds. Ipopt solves it to 1e-10 by
// another formulation (multiple shooting with slack variables) and another algorithm (interior point, exact
// Hessian).
#include <gtest/gtest.h>

#ifndef SPF_HAVE_IPOPT

#include <cstdlib>

TEST(MpcAgainstIpoptSlow, IsComparedWhereIpoptIsInstalled) {
  ASSERT_EQ(std::getenv("SPF_REQUIRE_TOOLS"), nullptr) << "configured without Ipopt (coinor-libipopt-dev)";
  GTEST_SKIP() << "configured without Ipopt (coinor-libipopt-dev)";
}

#else

#include <algorithm>
#include <cmath>
#include <iostream>

#include "spf/tracking/test/mpc_instances.hpp"
#include "spf/tracking/test/mpc_ipopt_oracle.hpp"

namespace spf {
namespace {

/// Largest differences found.
struct Comparison {
  int compared = 0;
  int oracle_failures = 0;
  int unfinished = 0;                // of ours: not converged
  double relative_gap = 0.0;         // (our cost - Ipopt's) / Ipopt's
  double first_input = 0.0;          // [m/s]
  double optimality_residual = 0.0;  // of ours
  int inputs_at_limit = 0;           // instances with at least one
  int bounds_violated = 0;           // instances that lean on a soft bound
  int other_minima = 0;              // instances in which the two ended in different minima
  int fell_back = 0;                 // instances for which the projected Newton method had to help
  int most_iterations = 0;
  int most_active_set_steps = 0;
};

MpcParameters to_convergence(MpcParameters parameters) {
  parameters.iterations = 400;
  parameters.tolerance = 1e-10;
  return parameters;
}

void compare(const MpcInstance& instance, const MpcResult& ours, MpcIpoptProblem& oracle,
             Ipopt::IpoptApplication& application, const Ipopt::SmartPtr<Ipopt::TNLP>& handle,
             Comparison& found) {
  oracle.set_problem(instance.problem);
  if (application.OptimizeTNLP(handle) != Ipopt::Solve_Succeeded) {
    ++found.oracle_failures;
    return;
  }
  ++found.compared;
  const double gap = (ours.cost - oracle.cost()) / (oracle.cost() + 1e-3);
  const double apart = (ours.wheel_speeds[0] - oracle.wheel_speeds()[0]).cwiseAbs().maxCoeff();
  if (std::abs(gap) > 1e-4 && apart > 1e-2) {
    ++found.other_minima;
  } else {
    found.relative_gap = std::max(found.relative_gap, gap);
    found.first_input = std::max(found.first_input, apart);
  }
  found.optimality_residual = std::max(found.optimality_residual, ours.optimality_residual);
  found.most_iterations = std::max(found.most_iterations, ours.iterations);
  found.most_active_set_steps = std::max(found.most_active_set_steps, ours.active_set_steps);
  double fastest = 0.0;
  for (int k = 0; k < instance.parameters.horizon; ++k)
    fastest = std::max(fastest, ours.wheel_speeds[static_cast<std::size_t>(k)].cwiseAbs().maxCoeff());
  if (fastest > instance.robot.max_wheel_speed - 1e-9) ++found.inputs_at_limit;
  if (ours.largest_violation > 0.0) ++found.bounds_violated;
  if (ours.fell_back) ++found.fell_back;
}

Comparison compare_cold(std::uint64_t seed, int count, const MpcInstanceOptions& options) {
  Comparison found;
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = make_ipopt(1e-10);
  for (int i = 0; i < count; ++i) {
    const MpcInstance instance = make_mpc_instance(mix(seed, static_cast<std::uint64_t>(i)), options);
    const Drive drive{instance.robot};
    ModelPredictiveController mpc{to_convergence(instance.parameters), drive};
    const MpcResult& ours = mpc.solve(instance.problem);
    if (ours.status != MpcStatus::converged) ++found.unfinished;
    auto* oracle = new MpcIpoptProblem{instance.parameters, drive};
    const Ipopt::SmartPtr<Ipopt::TNLP> handle = oracle;
    compare(instance, ours, *oracle, *application, handle, found);
  }
  ::testing::Test::RecordProperty("largest_relative_gap", std::to_string(found.relative_gap));
  std::cout << "compared " << found.compared << ", oracle failures " << found.oracle_failures << ", gap "
            << found.relative_gap << ", first input " << found.first_input << ", residual "
            << found.optimality_residual << ", saturated " << found.inputs_at_limit << ", walls "
            << found.bounds_violated << ", iterations " << found.most_iterations << ", active-set steps "
            << found.most_active_set_steps << ", fell back " << found.fell_back << ", other minima "
            << found.other_minima << "\n";
  return found;
}

// Ipopt stops at a scaled KKT error of 1e-10, its barrier still a little off the bounds: its cost is too high
// by about 1e-9 of itself, ours (solved to rounding) never is. The cost is flat at the optimum with a
// curvature of at least 2 effort_weight = 0.1 per input, so inputs may differ by sqrt(2e-9 / 0.1) = 1e-4
// where the cost is of order 1; measured 5e-8. The problem is not convex: a start 0.8 rad off or behind a
// wall has several minima, and it may happen that the two solvers end in different ones; ours is then still a
// minimum by its residual.
void expect_agreement(const Comparison& found, int count) {
  EXPECT_LE(found.oracle_failures, count / 100);
  EXPECT_LE(found.unfinished, count / 2000);
  EXPECT_GE(found.compared, count - count / 100);
  EXPECT_LE(found.other_minima, count / 50);
  EXPECT_LT(found.relative_gap, 1e-8);
  EXPECT_LT(found.first_input, 1e-5);
  EXPECT_LT(found.optimality_residual, 1e-6);
}

TEST(MpcAgainstIpoptSlow, DerivativesOfTheOracle) {
  MpcInstanceOptions options;
  options.wall_share = 1.0;
  options.rate_weight = 0.1;
  options.disturbance = 0.1;
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = make_ipopt(1e-10, true);
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    options.drive = seed % 2 == 0 ? DriveType::omni : DriveType::car;
    const MpcInstance instance = make_mpc_instance(seed, options);
    auto* oracle = new MpcIpoptProblem{instance.parameters, Drive{instance.robot}};
    const Ipopt::SmartPtr<Ipopt::TNLP> handle = oracle;
    oracle->set_problem(instance.problem);
    ::testing::internal::CaptureStdout();
    application->OptimizeTNLP(handle);
    const std::string report = ::testing::internal::GetCapturedStdout();
    // The checker prints a line with an asterisk for every derivative that disagrees.
    EXPECT_EQ(report.find('*'), std::string::npos) << report;
  }
}

TEST(MpcAgainstIpoptSlow, PaperHorizon) {
  const Comparison found = compare_cold(101, 1250, MpcInstanceOptions{});
  expect_agreement(found, 1250);
  EXPECT_EQ(found.other_minima, 0);
  EXPECT_GT(found.inputs_at_limit, 150);
  EXPECT_GT(found.bounds_violated, 100);
}

// The other drives. Their MPC is that of three wheels with other inputs.
TEST(MpcAgainstIpoptSlow, FourOmniWheels) {
  MpcInstanceOptions options;
  options.wheels = 4;
  expect_agreement(compare_cold(111, 250, options), 250);
}

TEST(MpcAgainstIpoptSlow, Mecanum) {
  MpcInstanceOptions options;
  options.drive = DriveType::mecanum;
  expect_agreement(compare_cold(112, 250, options), 250);
}

TEST(MpcAgainstIpoptSlow, Differential) {
  MpcInstanceOptions options;
  options.drive = DriveType::differential;
  expect_agreement(compare_cold(113, 2000, options), 2000);
}

// Of a car 0.3 m beside its reference, or before a wall, to steer left and to steer right are two minima: of
// such instances the two solvers part in one of ten. Nearer, and without walls, there is one.
TEST(MpcAgainstIpoptSlow, Car) {
  MpcInstanceOptions options;
  options.drive = DriveType::car;
  options.position_error = options.heading_error = 0.1;
  options.wall_share = 0.0;
  expect_agreement(compare_cold(114, 2000, options), 2000);
}

TEST(MpcAgainstIpoptSlow, SmallArmOfThePaper) {
  MpcInstanceOptions options;
  options.wheel_arm = 0.04;
  expect_agreement(compare_cold(102, 250, options), 250);
}

TEST(MpcAgainstIpoptSlow, InfeasibleStarts) {
  MpcInstanceOptions options;
  options.wall_share = 1.0;
  options.wall_ahead_low = -0.5;
  options.wall_ahead_high = 0.0;
  const Comparison found = compare_cold(103, 200, options);
  expect_agreement(found, 200);
  EXPECT_GT(found.bounds_violated, 150);
}

TEST(MpcAgainstIpoptSlow, HeadingErrorsDisturbanceAndRateWeight) {
  MpcInstanceOptions options;
  options.heading_error = 0.8;
  options.disturbance = 0.3;
  options.rate_weight = 0.05;
  expect_agreement(compare_cold(104, 150, options), 150);
}

TEST(MpcAgainstIpoptSlow, LongerHorizons) {
  MpcInstanceOptions options;
  options.horizon = 10;
  expect_agreement(compare_cold(105, 100, options), 100);
  options.horizon = 20;
  expect_agreement(compare_cold(106, 50, options), 50);
}

// Warm: one controller along a chain of steps with jumps of the estimate; the active set of the step before
// must not change the answer.
TEST(MpcAgainstIpoptSlow, WarmStarts) {
  Comparison found;
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = make_ipopt(1e-10);
  MpcInstanceOptions options;
  options.wall_share = 0.0;
  for (std::uint64_t chain = 0; chain < 20; ++chain) {
    MpcInstance instance = make_mpc_instance(mix(107, chain), options);
    instance.parameters.x_upper = instance.problem.initial_pose.x() + 0.4;
    const Drive drive{instance.robot};
    ModelPredictiveController mpc{to_convergence(instance.parameters), drive};
    auto* oracle = new MpcIpoptProblem{instance.parameters, drive};
    const Ipopt::SmartPtr<Ipopt::TNLP> handle = oracle;
    RandomStream random{mix(108, chain)};
    for (int step = 0; step < 8; ++step) {
      const MpcResult& ours = mpc.solve(instance.problem);
      EXPECT_EQ(ours.status, MpcStatus::converged);
      compare(instance, ours, *oracle, *application, handle, found);
      instance.problem.initial_pose =
          ours.pose[1] +
          Eigen::Vector3d{0.1 * random.normal(), 0.1 * random.normal(), 0.05 * random.normal()};
    }
  }
  expect_agreement(found, 160);
  EXPECT_GT(found.inputs_at_limit, 10);
}

// The default of two iterations, as it is used: near-optimal.
TEST(MpcAgainstIpoptSlow, TwoIterationsAreNearOptimal) {
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = make_ipopt(1e-10);
  Comparison found;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const MpcInstance instance = make_mpc_instance(mix(109, i), MpcInstanceOptions{});
    const Drive drive{instance.robot};
    ModelPredictiveController mpc{instance.parameters, drive};
    auto* oracle = new MpcIpoptProblem{instance.parameters, drive};
    const Ipopt::SmartPtr<Ipopt::TNLP> handle = oracle;
    compare(instance, mpc.solve(instance.problem), *oracle, *application, handle, found);
  }
  std::cout << "two iterations: gap " << found.relative_gap << ", first input " << found.first_input << "\n";
  EXPECT_GE(found.compared, 99);  // of 100: Ipopt itself fails on one at most
  // Gauss-Newton gains about a digit an iteration: measured 5e-5 and 7e-3 m/s at worst.
  EXPECT_LT(found.relative_gap, 5e-4);
  EXPECT_LT(found.first_input, 5e-2);
}

// Likewise of drives that cannot move sideways, for which Gauss-Newton leaves out more.
TEST(MpcAgainstIpoptSlow, TwoIterationsAreNearOptimalOnDrivesThatSteer) {
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = make_ipopt(1e-10);
  for (const DriveType drive_type : {DriveType::differential, DriveType::car}) {
    Comparison found;
    MpcInstanceOptions options;
    options.drive = drive_type;
    options.position_error = options.heading_error = 0.1;
    options.wall_share = 0.0;
    for (std::uint64_t i = 0; i < 100; ++i) {
      const MpcInstance instance = make_mpc_instance(mix(111, i), options);
      const Drive drive{instance.robot};
      ModelPredictiveController mpc{instance.parameters, drive};
      auto* oracle = new MpcIpoptProblem{instance.parameters, drive};
      const Ipopt::SmartPtr<Ipopt::TNLP> handle = oracle;
      compare(instance, mpc.solve(instance.problem), *oracle, *application, handle, found);
    }
    std::cout << enum_name(drive_type) << ", two iterations: gap " << found.relative_gap << ", first input "
              << found.first_input << "\n";
    EXPECT_GE(found.compared, 99);
    EXPECT_LT(found.relative_gap, 0.05);
    EXPECT_LT(found.first_input, 0.1);
  }
}

// Far off, where the wheels saturate throughout and Gauss-Newton alone would oscillate.
TEST(MpcAgainstIpoptSlow, TwoIterationsAreUsableFarFromTheReference) {
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = make_ipopt(1e-10);
  MpcInstanceOptions options;
  options.position_error = 1.5;
  options.heading_error = 0.5;
  double worst = 0.0;
  int compared = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const MpcInstance instance = make_mpc_instance(mix(110, i), options);
    const Drive drive{instance.robot};
    ModelPredictiveController mpc{instance.parameters, drive};
    auto* oracle = new MpcIpoptProblem{instance.parameters, drive};
    const Ipopt::SmartPtr<Ipopt::TNLP> handle = oracle;
    oracle->set_problem(instance.problem);
    if (application->OptimizeTNLP(handle) != Ipopt::Solve_Succeeded) continue;
    ++compared;
    worst = std::max(worst, mpc.solve(instance.problem).cost / oracle->cost() - 1.0);
  }
  std::cout << "two iterations, far off: compared " << compared << ", gap " << worst << "\n";
  EXPECT_GE(compared, 59);  // of 60
  EXPECT_LT(worst, 0.1);    // measured 0.044
}

}  // namespace
}  // namespace spf

#endif
