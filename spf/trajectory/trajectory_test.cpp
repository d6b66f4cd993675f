#include "spf/trajectory/trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "spf/math/random_stream.hpp"
#include "spf/testing/allocation_guard.hpp"

namespace spf {
namespace {

QuinticPiece random_piece(RandomStream& random) {
  QuinticPiece piece;
  for (int k = 0; k < 6; ++k) piece.coefficients.row(k) = random.normal2().transpose() * std::pow(0.7, k);
  piece.duration = random.uniform(0.2, 3.0);
  return piece;
}

Trajectory random_trajectory(RandomStream& random, int pieces, double start_time) {
  Trajectory trajectory{start_time};
  for (int i = 0; i < pieces; ++i) trajectory.append(random_piece(random));
  return trajectory;
}

TEST(QuinticPiece, EvaluatesAKnownPolynomialAndItsDerivatives) {
  QuinticPiece piece;  // x = t^5, y = 1 + 2t + 3t^2 + 4t^3, whole numbers: exact
  piece.coefficients(5, 0) = 1.0;
  piece.coefficients.col(1) << 1.0, 2.0, 3.0, 4.0, 0.0, 0.0;
  piece.duration = 2.0;
  EXPECT_EQ(piece.position(2.0), Eigen::Vector2d(32.0, 49.0));
  EXPECT_EQ(piece.velocity(2.0), Eigen::Vector2d(80.0, 62.0));
  EXPECT_EQ(piece.acceleration(2.0), Eigen::Vector2d(160.0, 54.0));
  EXPECT_EQ(piece.jerk(2.0), Eigen::Vector2d(240.0, 24.0));
}

TEST(QuinticPiece, EachDerivativeIsTheSlopeOfTheOneBefore) {
  RandomStream random{11};
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const QuinticPiece piece = random_piece(random);
    const double t = random.uniform(0.0, piece.duration);
    const Eigen::Vector2d velocity = (piece.position(t + kStep) - piece.position(t - kStep)) / (2.0 * kStep);
    const Eigen::Vector2d acceleration =
        (piece.velocity(t + kStep) - piece.velocity(t - kStep)) / (2.0 * kStep);
    const Eigen::Vector2d jerk =
        (piece.acceleration(t + kStep) - piece.acceleration(t - kStep)) / (2.0 * kStep);
    // Rounding 1e-16 / 1e-5 times values below 1e3, truncation 1e-10 / 6 times derivatives below 1e4: about
    // 2e-7.
    EXPECT_LT((piece.velocity(t) - velocity).norm(), 2e-6);
    EXPECT_LT((piece.acceleration(t) - acceleration).norm(), 2e-6);
    EXPECT_LT((piece.jerk(t) - jerk).norm(), 2e-6);
  }
}

TEST(Trajectory, WalksThroughItsPiecesInAbsoluteTime) {
  RandomStream random{3};
  const Trajectory trajectory = random_trajectory(random, 4, 12.5);
  EXPECT_EQ(trajectory.piece_count(), 4);
  double begin = 12.5;
  for (int i = 0; i < 4; ++i) {
    const QuinticPiece& piece = trajectory.piece(i);
    for (const double share : {0.1, 0.5, 0.9}) {
      const double local_time = share * piece.duration;
      const FlatState state = trajectory.state(begin + local_time);
      // Times up to 25 s carry rounding of 4e-15 s, times slopes up to 1e3.
      EXPECT_LT((state.position_world - piece.position(local_time)).norm(), 1e-11);
      EXPECT_LT((state.velocity_world - piece.velocity(local_time)).norm(), 1e-11);
      EXPECT_LT((state.acceleration_world - piece.acceleration(local_time)).norm(), 1e-11);
      EXPECT_EQ(state.position_world, trajectory.position(begin + local_time));
    }
    begin += piece.duration;
  }
  EXPECT_DOUBLE_EQ(trajectory.end_time(), begin);
  EXPECT_DOUBLE_EQ(trajectory.duration(), begin - 12.5);
}

TEST(Trajectory, StandsBeforeItsStartAndAfterItsEnd) {
  RandomStream random{5};
  const Trajectory trajectory = random_trajectory(random, 3, 2.0);
  const FlatState before = trajectory.state(1.0);
  EXPECT_EQ(before.position_world, trajectory.piece(0).position(0.0));
  EXPECT_EQ(before.velocity_world, Eigen::Vector2d::Zero());
  EXPECT_EQ(before.acceleration_world, Eigen::Vector2d::Zero());
  const FlatState after = trajectory.state(trajectory.end_time() + 7.0);
  EXPECT_EQ(after.position_world, trajectory.tail_position());
  EXPECT_EQ(after.velocity_world, Eigen::Vector2d::Zero());
  EXPECT_EQ(after.acceleration_world, Eigen::Vector2d::Zero());
  EXPECT_EQ(trajectory.position(-1e9), trajectory.piece(0).position(0.0));
  EXPECT_EQ(trajectory.position(1e9), trajectory.tail_position());
}

TEST(Trajectory, MovesAtItsStartAndAtItsEnd) {
  RandomStream random{6};
  for (int i = 0; i < 50; ++i) {
    SCOPED_TRACE(i);
    const Trajectory trajectory = random_trajectory(random, 5, random.uniform(0.0, 1000.0));
    EXPECT_EQ(trajectory.state(trajectory.start_time()).velocity_world, trajectory.piece(0).velocity(0.0));
    const QuinticPiece& last = trajectory.piece(4);
    // The end time is rounded to 1e-13 s, times an acceleration up to 1e3.
    EXPECT_LT((trajectory.state(trajectory.end_time()).velocity_world - last.velocity(last.duration)).norm(),
              1e-9);
  }
}

TEST(Trajectory, StandingStaysInPlace) {
  const Eigen::Vector2d position{1.5, -2.0};
  const Trajectory trajectory = Trajectory::standing(position, 4.0, 3.0, HeadingProfile{0.7});
  for (const double time : {0.0, 4.0, 5.5, 7.0, 100.0}) {
    EXPECT_EQ(trajectory.state(time).position_world, position);
    EXPECT_EQ(trajectory.state(time).velocity_world, Eigen::Vector2d::Zero());
  }
  EXPECT_EQ(trajectory.start_time(), 4.0);
  EXPECT_EQ(trajectory.duration(), 3.0);
  EXPECT_EQ(trajectory.heading_state(5.0).heading, 0.7);
  EXPECT_EQ(trajectory.max_speed(), 0.0);
  EXPECT_EQ(trajectory.max_acceleration(), 0.0);
  EXPECT_EQ(trajectory.length(), 0.0);
}

TEST(Trajectory, PeaksOfSpeedAndAccelerationAreTight) {
  RandomStream random{21};
  constexpr int kSamples = 4000;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const Trajectory trajectory = random_trajectory(random, 3, 0.0);
    double fastest = 0.0;
    double hardest = 0.0;
    for (int p = 0; p < 3; ++p)
      for (int s = 0; s <= kSamples; ++s) {
        const double t = trajectory.piece(p).duration * s / kSamples;
        fastest = std::max(fastest, trajectory.piece(p).velocity(t).norm());
        hardest = std::max(hardest, trajectory.piece(p).acceleration(t).norm());
      }
    // No sample lies above the peak but by rounding; between samples 0.75 ms apart a peak can hide at most
    // curvature * (0.4 ms)^2 / 2, about 1e-6 of it.
    EXPECT_GE(trajectory.max_speed(), fastest * (1.0 - 1e-14));
    EXPECT_LE(trajectory.max_speed(), fastest * (1.0 + 1e-5));
    EXPECT_GE(trajectory.max_acceleration(), hardest * (1.0 - 1e-14));
    EXPECT_LE(trajectory.max_acceleration(), hardest * (1.0 + 1e-5));
  }
}

TEST(Trajectory, FindsThePeakSpeedOfARestToRestMotionInClosedForm) {
  QuinticPiece piece;  // minimum-jerk motion over 3 m in 2 s: peak speed 15/8 of the mean, peak acceleration
                       // 10/sqrt(3)
  piece.duration = 2.0;
  piece.coefficients(3, 0) = 3.0 * 10.0 / 8.0;
  piece.coefficients(4, 0) = -3.0 * 15.0 / 16.0;
  piece.coefficients(5, 0) = 3.0 * 6.0 / 32.0;
  Trajectory trajectory{0.0};
  trajectory.append(piece);
  EXPECT_NEAR(trajectory.max_speed(), 15.0 / 8.0 * 1.5, 1e-14);
  EXPECT_NEAR(trajectory.max_acceleration(), 10.0 / std::sqrt(3.0) * 3.0 / 4.0, 1e-14);
  EXPECT_NEAR(trajectory.length(), 3.0, 1e-13);
}

TEST(Trajectory, LengthMatchesAFinePolygon) {
  RandomStream random{33};
  constexpr int kSamples = 20000;
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const Trajectory trajectory = random_trajectory(random, 2, 0.0);
    double polygon = 0.0;
    for (int p = 0; p < 2; ++p) {
      const QuinticPiece& piece = trajectory.piece(p);
      for (int s = 0; s < kSamples; ++s)
        polygon += (piece.position(piece.duration * (s + 1) / kSamples) -
                    piece.position(piece.duration * s / kSamples))
                       .norm();
    }
    // A polygon of 20000 chords is short by about turn^2 / (24 n^2), below 1e-8; the rest is the quadrature's
    // error at stretches that nearly come to rest.
    EXPECT_NEAR(trajectory.length(), polygon, 1e-6 * polygon);
  }
}

TEST(Trajectory, LengthCountsTheWayThereAndBack) {
  QuinticPiece piece;  // x = t - t^2: out to 1/4 and back
  piece.coefficients(1, 0) = 1.0;
  piece.coefficients(2, 0) = -1.0;
  piece.duration = 1.0;
  Trajectory trajectory{0.0};
  trajectory.append(piece);
  EXPECT_NEAR(trajectory.length(), 0.5, 1e-14);  // the speed is linear on both halves: exact but for rounding
}

TEST(Trajectory, LengthOfAPathThatNearlyStopsInItsMidst) {
  // x = (t - 1/2)^2 turns round, y = gap * t: the speed sqrt(4 (t - 1/2)^2 + gap^2) in closed form.
  for (const double gap : {0.1, 1e-3, 1e-5, 1e-8, 1e-12}) {
    QuinticPiece piece;
    piece.coefficients.row(1) << -1.0, gap;
    piece.coefficients(2, 0) = 1.0;
    piece.duration = 1.0;
    Trajectory trajectory{0.0};
    trajectory.append(piece);
    const double exact = 0.5 * (std::hypot(1.0, gap) + gap * gap * std::asinh(1.0 / gap));
    EXPECT_NEAR(trajectory.length(), exact, 1e-9) << "gap " << gap;
  }
}

TEST(Trajectory, LengthOfAPlanThatStandsButForRounding) {
  RandomStream random{91};
  Trajectory trajectory{0.0};
  for (int i = 0; i < Trajectory::kMaxPieces; ++i) {
    QuinticPiece piece;
    piece.duration = 1.0;
    piece.coefficients.row(0) << 3.0, -4.0;
    for (int k = 1; k <= 5; ++k)
      piece.coefficients.row(k) << random.uniform(-1e-16, 1e-16), random.uniform(-1e-16, 1e-16);
    trajectory.append(piece);
  }
  // Each of the five powers adds at most k sqrt(2) 1e-16 m.
  EXPECT_GT(trajectory.length(), 0.0);
  EXPECT_LE(trajectory.length(), Trajectory::kMaxPieces * 15.0 * 1.5e-16);
}

TEST(Trajectory, CopiesAndQueriesWithoutAllocating) {
  RandomStream random{9};
  const AllocationGuard guard;
  Trajectory trajectory = random_trajectory(random, Trajectory::kMaxPieces, 1.0);
  const Trajectory copy = trajectory;
  const double sum =
      copy.max_speed() + copy.max_acceleration() + copy.length() + copy.state(2.0).position_world.x();
  EXPECT_EQ(guard.allocations(), 0);
  EXPECT_TRUE(std::isfinite(sum));
}

}  // namespace
}  // namespace spf
