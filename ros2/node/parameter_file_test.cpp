#include "ros2/node/parameter_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace ros2 {
namespace {

std::string refusal_of(const std::string& text) {
  try {
    (void)parse_parameters(text, "robot.yaml");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ParameterFile, ValuesHaveTheTypesOfRos2) {
  EXPECT_EQ(parse_parameter_value("true"), ParameterValue{true});
  EXPECT_EQ(parse_parameter_value("yes"), ParameterValue{std::string{"yes"}});
  EXPECT_EQ(parse_parameter_value("-12"), ParameterValue{std::int64_t{-12}});
  EXPECT_EQ(parse_parameter_value("1e3"), ParameterValue{1000.0});
  EXPECT_EQ(parse_parameter_value("1."), ParameterValue{1.0});
  EXPECT_EQ(parse_parameter_value("-.inf"), ParameterValue{-HUGE_VAL});
  EXPECT_EQ(parse_parameter_value("'12'"), ParameterValue{std::string{"12"}});
  EXPECT_EQ(parse_parameter_value("1.2.3"), ParameterValue{std::string{"1.2.3"}});
  EXPECT_EQ(parse_parameter_value("e"), ParameterValue{std::string{"e"}});
  EXPECT_EQ(parse_parameter_value("99999999999999999999"), ParameterValue{99999999999999999999.0});
  EXPECT_EQ(parse_parameter_value("[1, 2.5]"), (ParameterValue{std::vector<double>{1.0, 2.5}}));
  EXPECT_EQ(parse_parameter_value("[true, false]"), (ParameterValue{std::vector<bool>{true, false}}));
  EXPECT_EQ(parse_parameter_value("[a, '1']"), (ParameterValue{std::vector<std::string>{"a", "1"}}));
  EXPECT_THROW((void)parse_parameter_value("{a: 1}"), std::invalid_argument);
  EXPECT_THROW((void)parse_parameter_value("[]"), std::invalid_argument);
}

TEST(ParameterFile, ValuesReadAsTheyAreWritten) {
  for (const ParameterValue& value :
       {ParameterValue{0.1}, ParameterValue{3.0}, ParameterValue{-1e300}, ParameterValue{HUGE_VAL},
        ParameterValue{std::numeric_limits<double>::denorm_min()},
        ParameterValue{std::numeric_limits<std::int64_t>::min()}, ParameterValue{false},
        ParameterValue{std::vector<double>{1.0, 0.3}}, ParameterValue{std::vector<std::int64_t>{1, 2}}})
    EXPECT_EQ(parse_parameter_value(to_text(value)), value) << to_text(value);
}

TEST(ParameterFile, NodesAreNamedWholeOrByLevels) {
  const std::vector<ParameterRule> rules = parse_parameters(R"(
/robot0/planner:
  ros__parameters:
    robot_id: 4
    host: {map_reach: 2.5, guard: {enabled: false}}
robot1:
  tracker:
    ros__parameters: {speeds: [1, 2]}
/**:
  ros__parameters:
)",
                                                            "robot.yaml");
  ASSERT_EQ(rules.size(), 4U);
  EXPECT_EQ(rules[0].node, "/robot0/planner");
  EXPECT_EQ(rules[1].name, "host.map_reach");
  EXPECT_EQ(rules[2].name, "host.guard.enabled");
  EXPECT_EQ(rules[3].node, "robot1/tracker");
  EXPECT_TRUE(matches(rules[3].node, "/robot1/tracker"));
}

TEST(ParameterFile, PatternsMeanNodes) {
  EXPECT_TRUE(matches("/**", "/planner"));
  EXPECT_TRUE(matches("/**", "/a/b/planner"));
  EXPECT_TRUE(matches("/*/planner", "/robot0/planner"));
  EXPECT_FALSE(matches("/*/planner", "/a/b/planner"));
  EXPECT_TRUE(matches("/**/planner", "/planner"));
  EXPECT_TRUE(matches("planner", "/robot0/planner"));
  EXPECT_FALSE(matches("/planner", "/robot0/planner"));
  EXPECT_FALSE(matches("/robot0/**/planner", "/robot1/planner"));
}

TEST(ParameterFile, WhatIsNoneIsRefusedByItsPlace) {
  EXPECT_EQ(refusal_of("a: 1\n"), "robot.yaml:1: 'a' must be a map with the key ros__parameters");
  EXPECT_EQ(refusal_of("ros__parameters: {a: 1}\n"), "robot.yaml:1: ros__parameters without a node's name");
  EXPECT_EQ(refusal_of("n:\n  ros__parameters:\n    a: [1, [2]]\n"),
            "robot.yaml:3: a list of parameters holds scalars alone");
  EXPECT_EQ(refusal_of("n:\n  ros__parameters:\n    a: [1, true]\n"),
            "robot.yaml:3: a list of both integer and bool");
  EXPECT_EQ(refusal_of("n:\n  ros__parameters:\n    a:\n"), "robot.yaml:3: 'a' has no value");
  EXPECT_EQ(refusal_of("n: [\n").rfind("robot.yaml:2: ", 0), 0U);
  EXPECT_EQ(refusal_of("n:\n  ros__parameters: 3\n"), "robot.yaml:2: ros__parameters of 'n' must be a map");
}

TEST(ParameterFile, AliasesDoNotMultiply) {
  std::string text = "a0: &a0 {ros__parameters: {x: 1}}\n";
  for (int i = 1; i < 25; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    text +=
        "a" + std::to_string(i) + ": &a" + std::to_string(i) + " {p: " + before + ", q: " + before + "}\n";
  }
  EXPECT_NE(refusal_of(text).find("more than 100000 values"), std::string::npos);
}

TEST(ParameterFile, LevelsAreBounded) {
  std::string text = "n: {ros__parameters: {";
  for (int i = 0; i < 40; ++i) text += "a: {";
  text += "b: 1" + std::string(42, '}');
  EXPECT_NE(refusal_of(text).find("more than 32 levels"), std::string::npos);
}

}  // namespace
}  // namespace ros2
