#include "simulator/robot_file.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "spf/testing/source_dir.hpp"

namespace spf::simulator {
namespace {

TEST(RobotFile, IsOfTheRobotsOfItsScenario) {
  const RunConfiguration run = read_run_configuration(
      source_dir() + "/scenarios/t2.yaml", {{"robot.max_speed=0.7", "test"}, {"robots=2", "test"}});
  EXPECT_EQ(robot_file_of(run, 1).robot.max_speed, 0.7);
  EXPECT_THROW((void)robot_file_of(run, 2), std::invalid_argument);
  const RunConfiguration mixed = read_run_configuration(source_dir() + "/scenarios/f7_mixed.yaml", {});
  EXPECT_NE(robot_file_of(mixed, 0).robot.drive, robot_file_of(mixed, 1).robot.drive);
}

}  // namespace
}  // namespace spf::simulator
