#include "spf/localisation/observer.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>
#include <limits>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/testing/allocation_guard.hpp"

namespace spf {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const Eigen::Vector3d kRest = Eigen::Vector3d::Zero();

Pose2 pose(double x, double y, double heading) {
  return Pose2{{x, y}, heading};
}

ObserverParameters parameters_of(ObserverKind kind, double pose_sigma) {
  ObserverParameters parameters;
  parameters.kind = kind;
  parameters.pose_sigma = pose_sigma;
  return parameters;
}

/// Plant of the noise table: z' = u + d + w_v, d' = w_d per axis, measured at `rate` with 1 m; returns the
/// standard deviation of the estimate's error on x and y, pooled, after the transient.
double steady_deviation(ObserverKind kind, double rate, double velocity_noise, double drift_noise, int runs) {
  ObserverParameters parameters = parameters_of(kind, 1.0);
  parameters.velocity_noise = velocity_noise;
  parameters.drift_noise = drift_noise;
  const double dt = 1.0 / rate;
  double sum = 0.0;
  long count = 0;
  for (int run = 0; run < runs; ++run) {
    RandomStream random{mix(41, static_cast<std::uint64_t>(run))};
    PoseObserver observer{parameters};
    Eigen::Vector2d truth = Eigen::Vector2d::Zero();
    Eigen::Vector2d drift = Eigen::Vector2d::Zero();
    const Eigen::Vector3d command{0.4, -0.2, 0.0};
    const int steps = static_cast<int>(140.0 * rate);
    for (int i = 0; i < steps; ++i) {
      truth += dt * (command.head<2>() + drift) + velocity_noise * std::sqrt(dt) * random.normal2();
      drift += drift_noise * std::sqrt(dt) * random.normal2();
      observer.predict(dt, command);
      const Eigen::Vector2d measured = truth + random.normal2();
      observer.correct(pose(measured.x(), measured.y(), 0.0));
      if (i < static_cast<int>(40.0 * rate)) continue;
      sum += (observer.estimate().pose_world.position_world - truth).squaredNorm();
      count += 2;
    }
  }
  return std::sqrt(sum / static_cast<double>(count));
}

TEST(EsoGain, PutsBothPolesOfTheErrorWhereTheContinuousObserverHasThem) {
  for (const double bandwidth : {0.1, 0.5, 5.0})
    for (const double interval : {0.001, 0.01, 0.1, 1.0, 3.0}) {
      const AxisGain gain = eso_gain(bandwidth, interval);
      Eigen::Matrix2d transition;
      transition << 1.0, interval, 0.0, 1.0;
      Eigen::Matrix2d keep;
      keep << 1.0 - gain.value, 0.0, -gain.disturbance, 1.0;
      const Eigen::Matrix2d error = keep * transition;
      const double pole = std::exp(-bandwidth * interval);
      // A double eigenvalue is badly conditioned; trace and determinant are not.
      EXPECT_NEAR(error.trace(), 2.0 * pole, 1e-13);
      EXPECT_NEAR(error.determinant(), pole * pole, 1e-13);
    }
}

TEST(EsoGain, TendsToThePaperGains) {
  const double interval = 1e-5;
  const AxisGain gain = eso_gain(0.5, interval);
  EXPECT_NEAR(gain.value / interval, 1.0, 1e-5);         // l1
  EXPECT_NEAR(gain.disturbance / interval, 0.25, 1e-5);  // l2
}

// Against eq. 17 itself, integrated with small Euler steps on a smooth input without noise.
TEST(PoseObserver, EsoFollowsEquation17) {
  const double fine = 1e-5;
  const double sample = 1e-3;
  const auto truth = [](double t) { return std::sin(t) + 0.3 * t; };
  const auto command = [](double t) { return std::cos(t); };  // 0.3 m/s of it is a disturbance
  double value = 0.0;
  double disturbance = 0.0;
  PoseObserver observer{parameters_of(ObserverKind::eso, 0.0)};
  observer.correct(pose(0.0, 0.0, 0.0));
  double worst = 0.0;
  for (int i = 1; i <= 10000; ++i) {
    for (int j = 0; j < 100; ++j) {
      const double t = (i - 1) * sample + j * fine;
      const double innovation = truth(t) - value;
      value += fine * (disturbance + command(t) + 1.0 * innovation);
      disturbance += fine * 0.25 * innovation;
    }
    observer.predict(sample, {command((i - 0.5) * sample), 0.0, 0.0});
    observer.correct(pose(truth(i * sample), 0.0, 0.0));
    worst = std::max({worst, std::abs(observer.estimate().pose_world.position_world.x() - value),
                      std::abs(observer.estimate().disturbance_world.x() - disturbance)});
  }
  EXPECT_LT(worst,
            1e-3);  // both discretisations are first order: about a sample times the rates of change (0.3)
  EXPECT_NEAR(observer.estimate().disturbance_world.x(), 0.3,
              0.3 * 6.0 * std::exp(-5.0));  // (1 + w t) exp(-w t)
}

// The paper's gains against 1 m of white noise: 0.25, 0.11 and 0.08 m. White-noise theory: sigma sqrt(5 w T /
// 4). Correlation time 2 s, 100 s x 20 runs x 2 axes: 2000 independent samples, 1.6 % of deviation; the
// finite interval adds 4 % at 10 Hz.
TEST(PoseObserver, EsoLeavesTheKnownNoise) {
  for (const double rate : {10.0, 50.0, 100.0}) {
    const double theory = std::sqrt(1.25 * 0.5 / rate);
    EXPECT_NEAR(steady_deviation(ObserverKind::eso, rate, 0.0, 0.0, 20), theory, 0.08 * theory) << rate;
  }
}

// Independent oracle: the discrete Riccati equation iterated with dense matrices.
Eigen::Matrix2d riccati(double interval, double sigma, double velocity_noise, double drift_noise) {
  Eigen::Matrix2d transition;
  transition << 1.0, interval, 0.0, 1.0;
  const double qv = velocity_noise * velocity_noise;
  const double qd = drift_noise * drift_noise;
  Eigen::Matrix2d noise;
  noise << qv * interval + qd * interval * interval * interval / 3.0, qd * interval * interval / 2.0,
      qd * interval * interval / 2.0, qd * interval;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  for (int i = 0; i < 200000; ++i) {
    const Eigen::Matrix2d predicted = transition * covariance * transition.transpose() + noise;
    const Eigen::Vector2d gain = predicted.col(0) / (predicted(0, 0) + sigma * sigma);
    covariance = predicted - gain * predicted.row(0);
  }
  return covariance;
}

TEST(PoseObserver, KalmanVarianceSettlesOnTheRiccatiSolution) {
  for (const double rate : {10.0, 50.0, 100.0}) {
    ObserverParameters parameters = parameters_of(ObserverKind::kalman, 1.0);
    PoseObserver observer{parameters};
    for (int i = 0; i < 300 * static_cast<int>(rate); ++i) {
      observer.predict(1.0 / rate, kRest);
      observer.correct(pose(0.0, 0.0, 0.0));
    }
    const double expected = riccati(1.0 / rate, 1.0, parameters.velocity_noise, parameters.drift_noise)(0, 0);
    EXPECT_NEAR(observer.estimate().position_variance, expected, 1e-6 * expected) << rate;
  }
  // And the continuous closed form, p = sqrt(r (q_v^2 + 2 q_d sqrt(r))) with r = sigma^2 T, to first order in
  // T.
  const double r = 0.01;
  const double closed = std::sqrt(r * (0.05 * 0.05 + 2.0 * 0.02 * std::sqrt(r)));
  EXPECT_NEAR(riccati(0.01, 1.0, 0.05, 0.02)(0, 0), closed, 0.02 * closed);
}

TEST(PoseObserver, KalmanErrorsAreAsLargeAsItSays) {
  for (const double rate : {10.0, 100.0}) {
    const double theory = std::sqrt(riccati(1.0 / rate, 1.0, 0.05, 0.02)(0, 0));
    // About 1 s of correlation; 20 runs x 100 s x 2 axes: 1.5 %, allowed 3 deviations and more.
    EXPECT_NEAR(steady_deviation(ObserverKind::kalman, rate, 0.05, 0.02, 20), theory, 0.07 * theory) << rate;
  }
}

TEST(PoseObserver, KalmanBeatsEsoOnItsOwnNoise) {
  EXPECT_LT(steady_deviation(ObserverKind::kalman, 10.0, 0.05, 0.02, 10),
            0.85 * steady_deviation(ObserverKind::eso, 10.0, 0.05, 0.02, 10));
}

TEST(PoseObserver, ExactMeasurementsAreReportedAsTheyAre) {
  PoseObserver observer{ObserverParameters{}};
  RandomStream random{9};
  for (int i = 0; i < 500; ++i) {
    const double t = 0.01 * i;
    const Pose2 measured = pose(std::sin(t), 0.5 * t, wrap_angle(2.0 * t));
    observer.predict(0.01, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    EXPECT_EQ(observer.correct(measured), MeasurementOutcome::used);
    EXPECT_EQ(observer.estimate().pose_world.position_world, measured.position_world);
    EXPECT_EQ(observer.estimate().pose_world.heading, measured.heading);
  }
}

TEST(PoseObserver, FindsAConstantDisturbanceAndBridgesAGapWithIt) {
  for (const ObserverKind kind : {ObserverKind::eso, ObserverKind::kalman}) {
    PoseObserver observer{parameters_of(kind, 0.0)};
    const Eigen::Vector3d command{0.5, 0.0, 0.2};
    const auto truth = [](double t) { return pose(0.6 * t, -0.1 * t, wrap_angle(0.15 * t)); };
    observer.correct(truth(0.0));
    for (int i = 1; i <= 4000; ++i) {
      observer.predict(0.01, command);
      observer.correct(truth(0.01 * i));
    }
    // 40 s; the slower filter (about 0.4 rad/s) has forgotten the start to 1e-6.
    EXPECT_LT((observer.estimate().disturbance_world - Eigen::Vector3d(0.1, -0.1, -0.05)).norm(), 1e-5);
    for (int i = 0; i < 200; ++i) observer.predict(0.01, command);
    const StateEstimate bridged = observer.estimate();
    EXPECT_LT((bridged.pose_world.position_world - truth(42.0).position_world).norm(), 1e-4);
    EXPECT_NEAR(bridged.age, 2.0, 1e-9);
    EXPECT_GT(bridged.position_variance, 0.0);
  }
}

TEST(PoseObserver, HeadingWraps) {
  for (const ObserverKind kind : {ObserverKind::eso, ObserverKind::kalman}) {
    ObserverParameters parameters = parameters_of(kind, 0.01);
    parameters.heading_sigma = 0.01;
    PoseObserver observer{parameters};
    observer.correct(pose(0, 0, 0.0));
    for (int i = 1; i <= 3000; ++i) {
      observer.predict(0.01, {0.0, 0.0, 1.0});
      EXPECT_NE(observer.correct(pose(0, 0, wrap_angle(0.01 * i))), MeasurementOutcome::rejected);
      const double heading = observer.estimate().pose_world.heading;
      EXPECT_LE(std::abs(heading), kPi);
      EXPECT_LT(std::abs(angle_difference(heading, 0.01 * i)), 1e-9);
    }
  }
}

TEST(PoseObserver, IgnoresAnOutlier) {
  for (const ObserverKind kind : {ObserverKind::eso, ObserverKind::kalman}) {
    PoseObserver observer{parameters_of(kind, 0.02)};
    for (int i = 0; i < 100; ++i) {
      observer.predict(0.01, kRest);
      observer.correct(pose(1.0, 2.0, 0.5));
    }
    observer.predict(0.01, kRest);
    EXPECT_EQ(observer.correct(pose(4.0, 2.0, 0.5)), MeasurementOutcome::rejected);
    observer.predict(0.01, kRest);
    EXPECT_EQ(observer.correct(pose(1.0, 2.0, 2.5)), MeasurementOutcome::rejected);
    EXPECT_LT((observer.estimate().pose_world.position_world - Eigen::Vector2d(1.0, 2.0)).norm(), 1e-12);
    observer.predict(0.01, kRest);
    EXPECT_EQ(observer.correct(pose(1.0, 2.0, 0.5)), MeasurementOutcome::used);
  }
}

TEST(PoseObserver, BelievesAJumpThatStays) {
  for (const double sigma : {0.0, 0.05}) {
    PoseObserver observer{parameters_of(ObserverKind::kalman, sigma)};
    const Eigen::Vector3d command{0.5, 0.0, 0.0};
    observer.correct(pose(0, 0, 0));
    int rejected = 0;
    for (int i = 1; i <= 20; ++i) {
      observer.predict(0.01, command);
      if (observer.correct(pose(3.0 + 0.005 * i, 1.0, 0.0)) == MeasurementOutcome::rejected) ++rejected;
    }
    EXPECT_EQ(rejected, 4);  // the fifth is believed
    EXPECT_LT((observer.estimate().pose_world.position_world - Eigen::Vector2d(3.1, 1.0)).norm(), 1e-3);
  }
}

/// A robot on a straight path whose sensor jumps at t = 1 s and comes back within `decay` seconds (for ever:
/// 0). Returns the largest error of the estimate on x [m] from then until 3 s after.
double error_at_seam(const ObserverParameters& parameters, double jump, double decay) {
  PoseObserver observer{parameters};
  const double dt = 0.01;
  const double speed = 0.3;
  double largest = 0.0;
  for (int i = 0; i <= 400; ++i) {
    const double time = i * dt;
    const double since = time - 1.0;
    const double left = since < 0.0 ? 0.0 : (decay > 0.0 ? std::max(0.0, 1.0 - since / decay) : 1.0);
    if (i > 0) observer.predict(dt, {speed, 0.0, 0.0});
    observer.correct(pose(speed * time + jump * left, 0.0, 0.0));
    largest = std::max(largest, std::abs(observer.estimate().pose_world.position_world.x() - speed * time));
  }
  return largest;
}

// The seam of two cameras: a robot does not jump by centimetres within a hundredth of a second.
TEST(PoseObserver, KeepsToDeadReckoningAcrossASeam) {
  ObserverParameters parameters = parameters_of(ObserverKind::kalman, 0.0);
  parameters.velocity_noise = 0.015;  // a robot of 5 cm
  parameters.gate_floor = 0.02 / 6.0;
  for (const double jump : {0.02, -0.04, 0.06}) {
    // Pulled for half a second by a mean of half the jump with a time constant of 1 s: a quarter at most.
    EXPECT_LT(error_at_seam(parameters, jump, 0.5), 0.25 * std::abs(jump)) << jump;
    ObserverParameters trusting = parameters;
    trusting.settling_time = 0.0;
    EXPECT_GT(error_at_seam(trusting, jump, 0.5), 0.8 * std::abs(jump)) << jump;
  }
}

TEST(PoseObserver, FollowsASmallJumpThatStaysWithinItsSettlingTime) {
  PoseObserver observer{parameters_of(ObserverKind::kalman, 0.0)};
  observer.correct(pose(0.0, 0.0, 0.0));
  const auto run = [&](double seconds) {
    for (int i = 0; i < std::lround(100.0 * seconds); ++i) {
      observer.predict(0.01, kRest);
      observer.correct(pose(0.5, 0.0, 0.0));
    }
    return observer.estimate().pose_world.position_world.x();
  };
  const double soon = run(1.0);
  EXPECT_GT(soon, 0.25);
  EXPECT_LT(soon, 0.45);
  EXPECT_EQ(run(5.0), 0.5);  // exact again once it agrees
}

TEST(PoseObserver, BelievesAtOnceThatItWasCarriedAway) {
  PoseObserver observer{parameters_of(ObserverKind::kalman, 0.0)};
  observer.correct(pose(0.0, 0.0, 0.0));
  for (int i = 0; i < 5; ++i) {
    observer.predict(0.01, kRest);
    observer.correct(pose(3.0, 0.0, 0.0));
  }
  EXPECT_EQ(observer.estimate().pose_world.position_world.x(), 3.0);
}

TEST(PoseObserver, IsNeverLockedOutByNoiseBeyondWhatItWasTold) {
  PoseObserver observer{parameters_of(ObserverKind::kalman, 0.001)};
  RandomStream random{77};
  int believed = 0;
  for (int i = 0; i < 1000; ++i) {
    observer.predict(0.01, kRest);
    const Eigen::Vector2d measured = Eigen::Vector2d{5.0, 5.0} + 3.0 * random.normal2();
    const MeasurementOutcome outcome = observer.correct(pose(measured.x(), measured.y(), 0.0));
    if (i > 0 && outcome != MeasurementOutcome::rejected) ++believed;
  }
  EXPECT_GE(believed, 1000 / 20 - 1);
}

TEST(PoseObserver, RefusesNotANumber) {
  PoseObserver observer{ObserverParameters{}};
  EXPECT_EQ(observer.correct(pose(kNan, 0.0, 0.0)), MeasurementOutcome::invalid);
  EXPECT_FALSE(observer.estimate().valid);
  observer.correct(pose(1.0, 1.0, 0.0));
  EXPECT_EQ(observer.correct(pose(1.0, 1.0, kNan)), MeasurementOutcome::invalid);
  observer.predict(0.1, {kNan, 0.0, 0.0});
  observer.predict(kNan, kRest);
  EXPECT_EQ(observer.estimate().pose_world.position_world, Eigen::Vector2d(1.0, 1.0));
}

TEST(PoseObserver, WithoutObserverHoldsTheRawMeasurement) {
  PoseObserver observer{parameters_of(ObserverKind::none, 1.0)};
  observer.correct(pose(1.0, 0.0, 0.0));
  observer.predict(0.1, {1.0, 0.0, 0.0});
  EXPECT_EQ(observer.estimate().pose_world.position_world.x(), 1.0);
  EXPECT_EQ(observer.correct(pose(40.0, 0.0, 0.0)), MeasurementOutcome::used);
  EXPECT_EQ(observer.estimate().pose_world.position_world.x(), 40.0);
  EXPECT_EQ(observer.estimate().disturbance_world, Eigen::Vector3d::Zero());
}

TEST(PoseObserver, ManyMeasurementsAtOneInstantAreHarmless) {
  for (const double sigma : {0.0, 0.1}) {
    ObserverParameters parameters = parameters_of(ObserverKind::kalman, sigma);
    parameters.velocity_noise = 0.0;
    parameters.drift_noise = 0.0;
    PoseObserver observer{parameters};
    for (int i = 0; i < 50; ++i) observer.correct(pose(1.0 + 0.01 * (i % 2), 0.0, 0.0));
    EXPECT_NEAR(observer.estimate().pose_world.position_world.x(), 1.005, 0.006);
    EXPECT_TRUE(std::isfinite(observer.estimate().disturbance_world.x()));
  }
}

TEST(PoseObserver, ResetForgets) {
  PoseObserver observer{ObserverParameters{}};
  observer.correct(pose(1.0, 1.0, 0.0));
  observer.reset();
  EXPECT_FALSE(observer.estimate().valid);
  observer.correct(pose(9.0, 9.0, 1.0));
  EXPECT_EQ(observer.estimate().pose_world.position_world.x(), 9.0);
}

TEST(PoseObserver, DoesNotAllocate) {
  PoseObserver observer{parameters_of(ObserverKind::kalman, 0.1)};
  observer.correct(pose(0, 0, 0));
  const AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    observer.predict(0.01, {0.1, 0.2, 0.3});
    observer.correct(pose(0.001 * i, i % 9 == 0 ? 5.0 : 0.0, 0.0));
  }
  EXPECT_EQ(guard.allocations(), 0);
}

TEST(PoseObserver, RefusesParametersOutOfRange) {
  ObserverParameters parameters;
  parameters.pose_sigma = -1.0;
  EXPECT_THROW(PoseObserver{parameters}, std::invalid_argument);
}

/// Measured at 100 Hz with a noise of 2 cm and 0.01 rad, told that it were exact, and moving as commanded.
TEST(PoseObserver, ReckonsWithNoiseThatNobodyDeclared) {
  RandomStream random{17};
  PoseObserver observer{parameters_of(ObserverKind::kalman, 0.0)};
  const Eigen::Vector3d command{0.4, -0.2, 0.1};
  const double dt = 0.01;
  Eigen::Vector3d truth{1.0, 2.0, 0.3};
  double squared = 0.0;
  double squared_turn = 0.0;
  double shaking = 0.0;
  const int steps = 1000;
  const int settled = 300;
  for (int i = 0; i < steps; ++i) {
    truth += dt * command;
    observer.predict(dt, command);
    const Eigen::Vector2d measured = truth.head<2>() + 0.02 * random.normal2();
    observer.correct(pose(measured.x(), measured.y(), truth.z() + 0.01 * random.normal()));
    if (i < settled) continue;
    const StateEstimate estimate = observer.estimate();
    squared += 0.5 * (estimate.pose_world.position_world - truth.head<2>()).squaredNorm();
    squared_turn += std::pow(angle_difference(estimate.pose_world.heading, truth.z()), 2);
    shaking = std::max(shaking, estimate.disturbance_world.head<2>().norm());
    EXPECT_GT(estimate.position_variance, 0.003 * 0.003);
  }
  EXPECT_LT(std::sqrt(squared / (steps - settled)), 0.5 * 0.02);
  EXPECT_LT(std::sqrt(squared_turn / (steps - settled)), 0.5 * 0.01);
  EXPECT_LT(shaking, 0.1);
}

// Wheel slip, drift and a floor that moves are no noise of the measurements.
TEST(PoseObserver, ExactMeasurementsStayExactWhateverTheRobotDoes) {
  RandomStream random{18};
  PoseObserver observer{parameters_of(ObserverKind::kalman, 0.0)};
  const double dt = 0.01;
  Eigen::Vector3d truth = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3000; ++i) {
    const double grip = i % 500 < 250 ? 1.0 : 0.3;
    const Eigen::Vector3d command{std::cos(0.003 * i), 0.5, 0.4};
    truth += dt * grip * command + 0.05 * std::sqrt(dt) * Eigen::Vector3d{random.normal(), 0.0, 0.0};
    observer.predict(dt, command);
    observer.correct(pose(truth.x(), truth.y(), truth.z()));
    ASSERT_EQ(observer.estimate().pose_world.position_world, (Eigen::Vector2d{truth.x(), truth.y()})) << i;
  }
}

}  // namespace
}  // namespace spf
