#include "spf/planning/space_time/motion_primitive.hpp"

#include <gtest/gtest.h>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

constexpr double kRollOutRounding = 1e-9;  // sums of 30 steps of about 0.1 m

class MotionPrimitiveTest : public ::testing::Test {
 protected:
  MotionPrimitiveTest() { guide.update(map, {8.0, 0.0}, {0.0, 0.0}); }

  OccupancyMap map{GridFrame::covering({-10.0, -10.0}, {10.0, 10.0}, 0.1), 2.0};
  CostToGo guide{CostToGoParameters{}, 0.2};
  RollOutSettings settings;
  RollOut result;
};

MotionPrimitive random_manoeuvre(RandomStream& random) {
  const double angle = random.uniform(-kPi, kPi);
  const double speed = random.uniform(0.0, 1.0);
  const int then = static_cast<int>(random.uniform(0.0, 3.0));
  return {speed * Eigen::Vector2d{std::cos(angle), std::sin(angle)}, random.uniform(0.0, 3.0),
          static_cast<MotionPrimitive::Then>(then)};
}

TEST_F(MotionPrimitiveTest, KeepsSpeedAndAccelerationLimits) {
  RandomStream random{3};
  for (int i = 0; i < 300; ++i) {
    FlatState head;
    head.velocity_world = 0.7 * Eigen::Vector2d{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    roll_out(random_manoeuvre(random), head, HeadingState{}, guide, settings, result);
    const Trajectory trajectory = to_trajectory(result, 5.0, settings);
    EXPECT_LE(trajectory.max_speed(), settings.max_speed + kRollOutRounding);
    EXPECT_LE(trajectory.max_acceleration(), settings.max_acceleration + kRollOutRounding);
  }
}

TEST_F(MotionPrimitiveTest, TrajectoryPassesThroughTheSteps) {
  RandomStream random{4};
  for (int i = 0; i < 300; ++i) {
    FlatState head;
    head.position_world = random.normal2();
    head.velocity_world = 0.5 * random.normal2().normalized();
    roll_out(random_manoeuvre(random), head, HeadingState{}, guide, settings, result);
    const Trajectory trajectory = to_trajectory(result, 5.0, settings);
    for (int k = 0; k <= result.steps; ++k) {
      const auto at = static_cast<std::size_t>(k);
      // The last step itself may be the end of the trajectory, where it is at rest.
      EXPECT_LT((trajectory.position(5.0 + 0.1 * k) - result.position_world[at]).norm(), kRollOutRounding);
    }
  }
}

TEST_F(MotionPrimitiveTest, EndsStanding) {
  roll_out({{0.0, 1.0}, 9.0, MotionPrimitive::Then::hold}, FlatState{}, HeadingState{}, guide, settings,
           result);
  const Trajectory trajectory = to_trajectory(result, 0.0, settings);
  EXPECT_GT(trajectory.state(2.9).velocity_world.norm(), 0.99);
  EXPECT_NEAR(trajectory.end_time(), 4.0, kRollOutRounding);  // 3 s and 1 s to brake
  EXPECT_EQ(trajectory.state(4.1).velocity_world.norm(), 0.0);
}

TEST_F(MotionPrimitiveTest, StopsAtTheGoal) {
  for (double distance = 0.02; distance < 2.0; distance += 0.03) {
    FlatState head;
    head.position_world = {8.0 - distance, 0.0};
    RollOut now;
    for (int second = 0; second < 2; ++second) {  // 6 s, in two roll-outs
      roll_out({{}, 0.0, MotionPrimitive::Then::goal}, head, HeadingState{}, guide, settings, now);
      head.position_world = now.position_world[30];
      head.velocity_world = now.velocity_world[30];
      for (int k = 0; k <= 30; ++k)
        EXPECT_LT(now.position_world[static_cast<std::size_t>(k)].x(), 8.0 + 0.02);
    }
    EXPECT_NEAR(head.position_world.x(), 8.0, 0.02) << distance;
    EXPECT_LT(head.velocity_world.norm(), 0.05) << distance;
  }
}

}  // namespace
}  // namespace spf
