// The files that users begin with are what they say they are.
#include <gtest/gtest.h>

#include "config/robot_file.hpp"
#include "study/scenario_file.hpp"

namespace spf_empc_ros {
namespace {

const std::string kConfig = std::string{SPF_EMPC_ROS_DIR} + "/config/";

TEST(RobotYaml, IsTheRobotOfTheScenarios) {
  const spf::RobotFile expected = spf::default_robot_file({"space_time"}, {});
  EXPECT_EQ(spf::to_yaml_text(spf::read_robot_file(kConfig + "robot.yaml")), spf::to_yaml_text(expected));
  const spf::RunConfiguration config = spf::read_run_configuration(kConfig + "fleet.yaml");
  EXPECT_TRUE(spf::read_robot_file(kConfig + "robot.yaml").warnings.empty());
  EXPECT_TRUE(config.warnings.empty());
  spf::RobotFile of_scenario = expected;
  of_scenario.robot = config.robot;
  EXPECT_EQ(spf::to_yaml_text(of_scenario), spf::to_yaml_text(expected));
}

TEST(FleetYaml, HasTheRobotsThatFleetLaunchStarts) {
  const spf::RunConfiguration config = spf::read_run_configuration(kConfig + "fleet.yaml");
  EXPECT_EQ(spf::make_trial(config, 0).robots.size(), 5U);
}

}  // namespace
}  // namespace spf_empc_ros
