// Readings of the paper (docs/paper_notes.md) that the files of the experiments fix.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "spf/testing/source_dir.hpp"

namespace spf {
namespace {

YAML::Node experiment(const std::string& name) {
  return YAML::LoadFile(source_dir() + "/scenarios/experiments/" + name + ".yaml");
}

TEST(PaperReadings, Table2RunsEveryLevelInBothReadingsOfTheNoise) {
  const YAML::Node table = experiment("table2");
  EXPECT_EQ(table["families"].as<std::vector<std::string>>(), std::vector<std::string>{"t2"});
  EXPECT_EQ(table["levels"].as<std::vector<double>>(), (std::vector<double>{0.0, 0.25, 1.0, 2.0}));
  EXPECT_EQ(table["noise"].as<std::vector<std::string>>(), (std::vector<std::string>{"white", "walk"}));
}

TEST(PaperReadings, Table3RunsAtBothLevelsOfObstacleNoise) {
  const YAML::Node table = experiment("table3");
  EXPECT_EQ(table["families"].as<std::vector<std::string>>(), std::vector<std::string>{"t2"});
  EXPECT_EQ(table["levels"].as<std::vector<double>>(), (std::vector<double>{0.25, 1.0}));
}

}  // namespace
}  // namespace spf
