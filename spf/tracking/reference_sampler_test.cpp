#include "spf/tracking/reference_sampler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/testing/allocation_guard.hpp"

namespace spf {
namespace {

const Drive kKinematics{RobotParameters{}};

QuinticPiece random_piece(RandomStream& random, double duration) {
  QuinticPiece piece;
  piece.duration = duration;
  for (int i = 0; i < 6; ++i) piece.coefficients.row(i) << 0.3 * random.normal(), 0.3 * random.normal();
  return piece;
}

/// Straight along x at 0.8 m/s from time 1 for 5 s.
Trajectory straight() {
  Trajectory trajectory{1.0};
  QuinticPiece piece;
  piece.coefficients(1, 0) = 0.8;
  piece.duration = 5.0;
  trajectory.append(piece);
  return trajectory;
}

ReferenceRequest request_at(double time) {
  ReferenceRequest request;
  request.time = time;
  return request;
}

TEST(ReferenceSampler, ReadsTheTrajectoryAtTheCurrentTime) {
  const Trajectory trajectory = straight();
  for (const double time : {1.0, 1.013, 2.37, 4.0}) {
    const Reference reference = sample_reference(trajectory, request_at(time), kKinematics, {});
    ASSERT_EQ(reference.steps, 5);
    for (std::size_t k = 0; k <= 5; ++k) {
      EXPECT_NEAR(reference.pose[k].x(), 0.8 * (time - 1.0 + 0.1 * static_cast<double>(k)), 1e-12);
      EXPECT_NEAR(reference.twist[k].x(), 0.8, 1e-12);
    }
  }
}

TEST(ReferenceSampler, StandsAfterTheEnd) {
  const Reference reference = sample_reference(straight(), request_at(5.85), kKinematics, {});
  EXPECT_NEAR(reference.pose[1].x(), 0.8 * 4.95, 1e-12);
  EXPECT_NEAR(reference.pose[3].x(), 4.0, 1e-12);
  EXPECT_EQ(reference.twist[5].x(), 0.0);
  EXPECT_LT(reference.wheel_speeds[4].norm(), 1e-12);
}

TEST(ReferenceSampler, WheelSpeedsLeadTheModelFromPointToPoint) {
  RandomStream random{4};
  for (int n = 0; n < 100; ++n) {
    Trajectory trajectory{0.0};
    trajectory.append(random_piece(random, 1.0));
    trajectory.set_heading(HeadingProfile{0.0, HeadingState{}, 1.0, 1.0, 2.0});
    const Reference reference =
        sample_reference(trajectory, request_at(random.uniform(0.0, 0.3)), kKinematics, {});
    for (std::size_t k = 0; k < 5; ++k) {
      const Eigen::Vector3d twist = kKinematics.twist_world(reference.wheel_speeds[k], reference.pose[k].z());
      const Eigen::Vector3d wanted = (reference.pose[k + 1] - reference.pose[k]) / 0.1;
      const bool within =
          kKinematics.input_from_world(wanted, reference.pose[k].z()).cwiseAbs().maxCoeff() < 1.5;
      EXPECT_TRUE(!within || (twist - wanted).norm() < 1e-10);
      EXPECT_LE(reference.wheel_speeds[k].cwiseAbs().maxCoeff(), 1.5);
    }
  }
}

TEST(ReferenceSampler, HeadingTurnsOnFromTheRobots) {
  Trajectory trajectory = straight();
  trajectory.set_heading(HeadingProfile{1.0, HeadingState{3.0, 0.0}, -3.0, 1.0, 5.0});  // over the seam at pi
  ReferenceRequest request = request_at(1.0);
  request.robot_world.heading = -3.1;
  const Reference reference = sample_reference(trajectory, request, kKinematics, {});
  EXPECT_NEAR(reference.pose[0].z(), 3.0 - 2.0 * kPi, 1e-12);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_LT(std::abs(reference.pose[k + 1].z() - reference.pose[k].z()), 0.11);  // at most 1 rad/s
}

TEST(ReferenceSampler, LeadMovesPosesAheadByTheirVelocity) {
  ReferenceRequest request = request_at(2.0);
  request.preview = 0.05;
  const Reference reference = sample_reference(straight(), request, kKinematics, {});
  EXPECT_NEAR(reference.pose[0].x(), 0.8 * 1.05, 1e-12);
}

TEST(ReferenceSampler, FirstStepHasTheMeanVelocityOfTheTimeItIsHeld) {
  RandomStream random{5};
  Trajectory trajectory{0.0};
  trajectory.append(random_piece(random, 2.0));
  ReferenceRequest request = request_at(0.3);
  request.hold_time = 0.05;
  const Reference reference = sample_reference(trajectory, request, kKinematics, {});
  const Eigen::Vector2d held = (trajectory.position(0.35) - trajectory.position(0.3)) / 0.05;
  EXPECT_LT(((reference.pose[1] - reference.pose[0]).head<2>() / 0.1 - held).norm(), 1e-12);
  // Later steps keep the plan's own velocity.
  const Eigen::Vector2d later = (trajectory.position(0.6) - trajectory.position(0.5)) / 0.1;
  EXPECT_LT(((reference.pose[3] - reference.pose[2]).head<2>() / 0.1 - later).norm(), 1e-12);
}

TEST(ReferenceSampler, WithoutSelfSamplingHoldsThePlansPoints) {
  ReferenceParameters parameters;
  parameters.self_sampling = false;
  const Reference reference = sample_reference(straight(), request_at(2.35), kKinematics, parameters);
  // Points of the plan lie at 1.0, 1.5, 2.0, 2.5 s: times 2.35 and 2.45 see the third, 2.55 to 2.85 the
  // fourth.
  const double expected[6] = {0.8, 0.8, 1.2, 1.2, 1.2, 1.2};
  for (std::size_t k = 0; k <= 5; ++k) EXPECT_NEAR(reference.pose[k].x(), expected[k], 1e-12);
  EXPECT_EQ(reference.twist[0].norm(), 0.0);
  EXPECT_EQ(reference.wheel_speeds[0].norm(), 0.0);
}

TEST(ReferenceSampler, DoesNotAllocate) {
  const Trajectory trajectory = straight();
  const AllocationGuard guard;
  const Reference reference =
      sample_reference(trajectory, request_at(2.0), kKinematics, ReferenceParameters{});
  EXPECT_EQ(guard.allocations(), 0);
  EXPECT_EQ(reference.steps, 5);
}

}  // namespace
}  // namespace spf
