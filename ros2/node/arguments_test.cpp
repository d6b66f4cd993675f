#include "ros2/node/arguments.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace ros2 {
namespace {

std::string refusal_of(const std::vector<std::string>& arguments) {
  try {
    (void)Arguments::parse(arguments);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Arguments, AreTakenApart) {
  const Arguments given = Arguments::parse({"prog", "robot", "--ros-args", "-r", "__ns:=/robot3", "--remap",
                                            "planner:odom:=/fused", "-p", "robot_id:=3", "--log-level",
                                            "WARN", "-e", "/x", "--disable-rosout-logs", "--", "--quick"});
  EXPECT_EQ(given.others, (std::vector<std::string>{"prog", "robot", "--quick"}));
  ASSERT_EQ(given.remaps.size(), 2U);
  EXPECT_EQ(given.remaps[1].node, "planner");
  EXPECT_EQ(given.remaps[1].from, "odom");
  EXPECT_EQ(given.remaps[1].to, "/fused");
  ASSERT_EQ(given.parameters.size(), 1U);
  EXPECT_EQ(given.parameters[0].node, "/**");
  EXPECT_EQ(given.parameters[0].value, ParameterValue{std::int64_t{3}});
  EXPECT_EQ(given.log_level, LogLevel::warn);
  EXPECT_FALSE(given.rosout);
}

TEST(Arguments, LaterParametersWin) {
  const Arguments given = Arguments::parse(
      {"--ros-args", "-p", "speed:=1.0", "-p", "tracker:speed:=2.0", "-p", "planner:speed:=3.0"});
  const auto values = given.parameters_for("/robot0/planner");
  ASSERT_EQ(values.size(), 1U);
  EXPECT_EQ(values[0].second, ParameterValue{3.0});
  EXPECT_EQ(given.parameters_for("/robot0/other")[0].second, ParameterValue{1.0});
}

TEST(Arguments, ReadFiles) {
  const std::filesystem::path path = std::filesystem::path{testing::TempDir()} / "ros2_arguments_test.yaml";
  std::ofstream{path} << "/**:\n  ros__parameters: {map: none}\n";
  const Arguments given = Arguments::parse({"--ros-args", "--params-file", path.string()});
  ASSERT_EQ(given.parameters.size(), 1U);
  EXPECT_EQ(given.parameters[0].value, ParameterValue{std::string{"none"}});
  std::filesystem::remove(path);
  EXPECT_EQ(refusal_of({"--ros-args", "--params-file", path.string()}), path.string() + ": cannot be read");
}

TEST(Arguments, BadOnesAreRefusedByName) {
  EXPECT_EQ(refusal_of({"--ros-args", "-r"}), "-r has no value");
  EXPECT_EQ(refusal_of({"--ros-args", "-r", "a=b"}), "-r a=b: must be NAME:=VALUE or NODE:NAME:=VALUE");
  EXPECT_EQ(refusal_of({"--ros-args", "-r", "a:="}), "-r a:=: has no new name");
  EXPECT_EQ(refusal_of({"--ros-args", "-x"}), "unknown argument of --ros-args: -x");
  EXPECT_EQ(refusal_of({"--ros-args", "--log-level", "loud"}),
            "--log-level loud: must be one of debug, info, warn, error, fatal");
  EXPECT_EQ(refusal_of({"--ros-args", "-p", "a:=[1, x]"}),
            "-p a:=[1, x]: '[1, x]':1: a list of both integer and string");
}

}  // namespace
}  // namespace ros2
