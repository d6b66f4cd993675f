#include "spf/planning/moving_disc.hpp"

#include <gtest/gtest.h>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

Trajectory draw_trajectory(RandomStream& random) {
  Trajectory trajectory{random.uniform(0.0, 2.0)};
  for (int i = 0; i < 4; ++i) {
    QuinticPiece piece;
    piece.duration = random.uniform(0.3, 2.0);
    for (int k = 0; k < 6; ++k) piece.coefficients.row(k) = 0.5 * random.normal2().transpose();
    trajectory.append(piece);
  }
  return trajectory;
}

TEST(SpeedBound, HoldsTheLargestSpeedAndIsNotIdle) {
  RandomStream random{23};
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const Trajectory trajectory = draw_trajectory(random);
    EXPECT_GE(speed_bound(trajectory), trajectory.max_speed() * (1.0 - 1e-12));
    EXPECT_LE(speed_bound(trajectory),
              3.0 * trajectory.max_speed());  // a hull of degree 4, measured below 1.6
  }
}

TEST(DiscCursor, FollowsATrajectoryForwardsBackwardsAndBeyond) {
  RandomStream random{29};
  const Trajectory trajectory = draw_trajectory(random);
  MovingDisc disc;
  disc.trajectory = &trajectory;
  DiscCursor cursor{disc};
  for (int i = 0; i < 500; ++i) {
    const double time = random.uniform(trajectory.start_time() - 1.0, trajectory.end_time() + 1.0);
    cursor.move_to(time);
    const FlatState expected = trajectory.state(time);
    EXPECT_LT((cursor.position() - expected.position_world).norm(), 1e-9) << time;
    EXPECT_LT((cursor.velocity() - expected.velocity_world).norm(), 1e-9) << time;
  }
}

TEST(DiscCursor, GoesStraightWithoutATrajectory) {
  MovingDisc disc;
  disc.time = 2.0;
  disc.position_world = {1.0, 2.0};
  disc.velocity_world = {0.5, -1.0};
  DiscCursor cursor{disc};
  cursor.move_to(4.0);
  EXPECT_EQ(cursor.position(), Eigen::Vector2d(2.0, 0.0));
  EXPECT_EQ(cursor.velocity(), disc.velocity_world);
}

}  // namespace
}  // namespace spf
