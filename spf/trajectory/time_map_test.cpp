#include "spf/trajectory/time_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "spf/trajectory/decision_vector.hpp"

namespace spf {
namespace {

TEST(TimeMap, IsPositiveAndRisesEverywhere) {
  double last = 0.0;
  for (double tau = -50.0; tau <= 50.0; tau += 0.125) {
    const double duration = duration_from_tau(tau);
    EXPECT_GT(duration, last);
    EXPECT_GT(duration_slope(tau), 0.0);
    last = duration;
  }
  EXPECT_EQ(duration_from_tau(0.0), 1.0);
}

TEST(TimeMap, InverseLeadsThereAndBack) {
  for (double tau = -50.0; tau <= 50.0; tau += 0.37)
    // For tau << 0 the inverse loses 1e-16 times tau / slope * T, about |tau|.
    EXPECT_NEAR(tau_from_duration(duration_from_tau(tau)), tau, 1e-13 * (1.0 + std::fabs(tau)));
  for (const double duration : {1e-4, 0.1, 0.999999, 1.0, 1.000001, 3.0, 1e4})
    EXPECT_NEAR(duration_from_tau(tau_from_duration(duration)), duration, 1e-13 * duration);
}

TEST(TimeMap, SlopeMatchesCentralDifferences) {
  constexpr double kStep = 1e-5;
  for (double tau = -10.0; tau <= 10.0; tau += 0.13) {
    const double numeric = (duration_from_tau(tau + kStep) - duration_from_tau(tau - kStep)) / (2.0 * kStep);
    EXPECT_NEAR(duration_slope(tau), numeric, 1e-9 * (1.0 + duration_slope(tau)));  // rounding 1e-16 T / step
  }
}

TEST(TimeMap, ValueSlopeAndBendAreContinuousAtZero) {
  constexpr double kStep = 1e-6;
  EXPECT_NEAR(duration_from_tau(kStep), duration_from_tau(-kStep), 3.0 * kStep);
  EXPECT_NEAR(duration_slope(kStep), duration_slope(-kStep), 3.0 * kStep);
  // Second derivatives from one side each: both 1, up to the third derivative (0 and 6) times the step.
  EXPECT_NEAR((duration_slope(kStep) - duration_slope(0.0)) / kStep, 1.0, 1e-5);
  EXPECT_NEAR((duration_slope(0.0) - duration_slope(-kStep)) / kStep, 1.0, 1e-5);
}

TEST(DecisionLayout, PacksWaypointsFirstThenTaus) {
  const DecisionLayout layout{3};
  ASSERT_EQ(layout.size(), 7);
  Eigen::Matrix2Xd waypoints(2, 2);
  waypoints << 1.0, 3.0, 2.0, 4.0;
  const Eigen::Vector3d durations{1.0, 2.5, 0.4};
  Eigen::VectorXd decision(7);
  layout.pack(waypoints, durations, decision);
  EXPECT_EQ(decision.head<4>(), Eigen::Vector4d(1.0, 2.0, 3.0, 4.0));
  EXPECT_EQ(decision[4], 0.0);
  EXPECT_DOUBLE_EQ(decision[5], 1.0);   // sqrt(2 * 2.5 - 1) - 1
  EXPECT_DOUBLE_EQ(decision[6], -1.0);  // 1 - sqrt(2 / 0.4 - 1)
  EXPECT_EQ(Eigen::Matrix2Xd{layout.waypoints(decision)}, waypoints);
  EXPECT_LT((layout.durations(decision) - durations).norm(), 1e-15);
}

TEST(DecisionLayout, OnePieceHasOnlyItsTau) {
  const DecisionLayout layout{1};
  EXPECT_EQ(layout.size(), 1);
  const Eigen::VectorXd decision = Eigen::VectorXd::Zero(1);
  EXPECT_EQ(layout.waypoints(decision).cols(), 0);
  EXPECT_EQ(layout.durations(decision)[0], 1.0);
}

}  // namespace
}  // namespace spf
