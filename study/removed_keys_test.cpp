// Parameters that are gone, through the doors by which files come in.
#include "config/removed_keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "config/robot_file.hpp"
#include "config/yaml_reader.hpp"
#include "study/scenario_file.hpp"

namespace spf {
namespace {

using testing::HasSubstr;

std::string refusal_of(const std::string& text, const std::vector<Setting>& settings = {}) {
  try {
    static_cast<void>(run_configuration_from_text(text, "old.yaml", settings));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RemovedKeys, AreRefusedWithWhatCountsInstead) {
  EXPECT_EQ(
      refusal_of("family: t2\nrobot: {wheel_count: 3}\nagent:\n  team: {keep_candidates: true}\n"
                 "  planner: {optimizer: {memory: 8}}\n  space_time: {sigma_floor: 0.1, horizon: 3}\n"),
      "old.yaml:2:9: robot.wheel_count = 3 is no parameter any more: a drive has three wheels\n"
      "old.yaml:4:10: agent.team.keep_candidates = true is no parameter any more: what is recorded "
      "keeps them\n"
      "old.yaml:5:25: agent.planner.optimizer.memory = 8 is no parameter any more: it is a constant, 16\n"
      "old.yaml:6:16: agent.space_time.sigma_floor = 0.1 is no parameter any more: it is a constant, "
      "0.03 m for the standard robot");
}

TEST(RemovedKeys, AreRefusedOneAndAll) {
  for (const RemovedKey& removed : kRemovedKeys) {
    const std::string found = refusal_of("family: field\n", {{std::string{removed.path} + "=1"}});
    EXPECT_EQ(found, "--set: " + std::string{removed.path} +
                         " = 1 is no parameter any more: " + std::string{removed.instead});
  }
}

TEST(RemovedKeys, AreRefusedInTheFileOfARobot) {
  try {
    static_cast<void>(robot_file_from_text("agent:\n  occupancy: {hit_probability: 0.7}\n", "robot.yaml"));
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "robot.yaml:2:15: agent.occupancy.hit_probability = 0.7 is no parameter any more: it is a "
                 "constant, 0.65");
  }
}

// What is not on the list is told as before, also beside what is.
TEST(RemovedKeys, LeaveTheRestOfAGroupToBeJudged) {
  const std::string found = refusal_of(
      "family: t2\nagent: {occupancy: {hit_probability: 0.7, hits: 3}, planner: {optimizer: 7}}\n");
  EXPECT_THAT(found, HasSubstr("agent.occupancy.hit_probability = 0.7 is no parameter any more"));
  EXPECT_THAT(found, HasSubstr("agent.occupancy = {...} is not a known key"));
  EXPECT_THAT(found, HasSubstr("agent.planner.optimizer = 7 is not a known key"));
  EXPECT_THAT(refusal_of("family: t2\nagent: {occupancy: {}}\n"), HasSubstr("is not a known key"));
}

TEST(RemovedKeys, AreNoKeysOfToday) {
  std::set<std::string> today;
  for (const char* family : {"t2", "ped", "explicit"}) {
    RunConfiguration config;
    for (const auto& [value, name] : EnumNames<SceneFamily>::values)
      if (std::string_view{name} == family) config.family = value;
    for (const std::string& key : keys_of(config)) today.insert(key);
  }
  ASSERT_TRUE(today.count("agent.space_time.horizon") == 1 && today.count("layout.window") == 1);
  std::set<std::string> once;
  for (const RemovedKey& removed : kRemovedKeys) {
    EXPECT_EQ(today.count(std::string{removed.path}), 0u) << removed.path;
    EXPECT_TRUE(once.insert(std::string{removed.path}).second) << removed.path;
  }
}

}  // namespace
}  // namespace spf
