#include "host/robot_map.hpp"

#include <gtest/gtest.h>

#include "host/bench_test.hpp"
#include "spf/robot/robot_scale.hpp"

namespace spf::host {
namespace {

TEST(RobotMap, FollowsTheSizeOfTheRobot) {
  RobotParameters small;
  small.radius = 0.05;
  for (const RobotParameters& robot : {RobotParameters{}, small}) {
    const HostParameters host = scaled(HostParameters{}, RobotScale{robot});
    const OccupancyMap map = sensed_map({1.0, 2.0}, host);
    EXPECT_NEAR(map.frame().resolution, robot.radius / 3.0, 1e-12);
    EXPECT_NEAR(map.max_distance(), robot.radius * 20.0 / 3.0, 1e-12);
    EXPECT_NEAR(map.frame().origin_world.x(), 1.0 - 0.5 * host.grid_size, map.frame().resolution);
  }
}

TEST(RobotMap, IsAsCoarseAsItMustBeAndReachesOverFourNodes) {
  const OccupancyMap fine = empty_map({0.0, 0.0}, {8.0, 8.0}, {0.1, 2.0}, 0.02);
  EXPECT_EQ(fine.frame().resolution, 0.1);
  EXPECT_EQ(fine.max_distance(), 2.0);
  const OccupancyMap coarse = empty_map({0.0, 0.0}, {80.0, 80.0}, {0.1, 2.0}, 0.8);
  EXPECT_EQ(coarse.frame().resolution, 0.8);
  EXPECT_EQ(coarse.max_distance(), 3.2);
}

TEST(RobotMap, ThatIsShownIsTheOneThatIsPlannedWith) {
  for (const Arrangement arrangement : {Arrangement::one_process, Arrangement::split}) {
    Bench bench{arrangement};
    EXPECT_NE(bench.planner.map(), nullptr);  // the given one
    bench.pillars = {{{2.0, 0.0}, 0.5}};
    bench.run(2.0);
    ASSERT_NE(bench.planner.agent(), nullptr);
    EXPECT_EQ(bench.planner.map(), &bench.planner.agent()->map());
    EXPECT_LT(bench.planner.map()->distance({1.5, 0.0}), 0.1);
    EXPECT_GT(bench.planner.map()->distance({-2.0, 0.0}), 1.5);
  }
}

}  // namespace
}  // namespace spf::host
