// Old names of parameters, through the door by which scenario files come in.
#include "config/renamed_keys.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "config/robot_file.hpp"
#include "study/scenario_file.hpp"

namespace spf {
namespace {

std::string problems(const std::string& text, const std::vector<Setting>& settings = {}) {
  try {
    static_cast<void>(run_configuration_from_text(text, "old.yaml", settings));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RenamedKeys, AreReadByTheirOldNames) {
  const RunConfiguration config = run_configuration_from_text(
      "family: t2\nagent: {space_time: {risk_price: 123, risk_fading: 0.5}}\n", "old.yaml");
  EXPECT_EQ(config.agent.space_time.collision_cost, 123.0);
  EXPECT_EQ(config.agent.space_time.discount_time, 0.5);
  EXPECT_EQ(to_yaml_text(config).find("risk_price"), std::string::npos);
  const RobotFile file = robot_file_from_text("agent: {space_time: {risk_price: 123}}\n", "robot.yaml");
  EXPECT_EQ(file.agent.space_time.collision_cost, 123.0);
}

TEST(RenamedKeys, OfASettingReplaceWhatTheFileSays) {
  for (const char* key : {"risk_price", "collision_cost"}) {
    const RunConfiguration config = run_configuration_from_text(
        "family: t2\nagent: {space_time: {" + std::string{key} + ": 123}}\n", "old.yaml",
        {{"agent.space_time.collision_cost=7"}, {"agent.space_time.risk_price=8"}});
    EXPECT_EQ(config.agent.space_time.collision_cost, 8.0);
  }
}

TEST(RenamedKeys, AreRefusedBesideTheNewOne) {
  EXPECT_EQ(
      problems("family: t2\nagent:\n  space_time:\n    risk_price: 1\n    collision_cost: 2\n"),
      "old.yaml:4:5: agent.space_time.risk_price is the old name of collision_cost, which is given as well");
}

TEST(RenamedKeys, KeepTheChecksOfTheNewName) {
  EXPECT_NE(
      problems("family: t2\n", {{"agent.space_time.risk_price=-1"}}).find("agent.space_time.collision_cost"),
      std::string::npos);
  EXPECT_NE(problems("family: t2\nagent: 3\n"), "");
  EXPECT_NE(problems("family: t2\nagent: {space_time: [risk_price]}\n"), "");
}

TEST(RenamedKeys, LeadToKeysThatThereAre) {
  const std::string all = to_yaml_text(default_run_configuration(SceneFamily{sim::Family::t2}, "space_time"));
  for (const RenamedKey& renamed : kRenamedKeys) {
    const std::string old_name{renamed.path.substr(renamed.path.rfind('.') + 1)};
    EXPECT_NE(all.find(" " + std::string{renamed.new_name} + ":"), std::string::npos) << renamed.new_name;
    EXPECT_EQ(all.find(" " + old_name + ":"), std::string::npos) << old_name;
  }
}

}  // namespace
}  // namespace spf
