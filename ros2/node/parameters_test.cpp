#include "ros2/node/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "ros2/node/parameter_services.hpp"

namespace ros2 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Parameters robot_parameters() {
  Parameters parameters{{{"speed", ParameterValue{std::int64_t{2}}}, {"sped", ParameterValue{1.0}}}};
  (void)parameters.declare_as("speed", 1.0, {"[m/s] at most", false, ParameterRange{0.0, 3.0}, ""});
  (void)parameters.declare_as("robot_id", std::int64_t{0}, {"number", true, std::nullopt, ""});
  (void)parameters.declare_as("host.guard.enabled", true, {});
  (void)parameters.declare_as("host.reach", 2.0, {});
  return parameters;
}

TEST(Parameters, BeginWithWhatWasGiven) {
  Parameters parameters = robot_parameters();
  EXPECT_EQ(parameters.get("speed"), ParameterValue{2.0});  // a whole number is a number too
  EXPECT_EQ(parameters.get("host.reach"), ParameterValue{2.0});
  EXPECT_EQ(parameters.get("missing"), ParameterValue{});
  EXPECT_THAT(parameters.unknown_given(), ElementsAre("sped"));
}

TEST(Parameters, WhatWasGivenMustFit) {
  Parameters parameters{{{"speed", ParameterValue{7.0}}, {"name", ParameterValue{true}}}};
  try {
    (void)parameters.declare_as("speed", 1.0, {"", false, ParameterRange{0.0, 3.0}, ""});
    FAIL() << "7 was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "speed = 7.0 must lie in [0.0, 3.0]");
  }
  EXPECT_THROW((void)parameters.declare_as("name", std::string{}, {}), std::invalid_argument);
}

TEST(Parameters, AreSetTogetherOrNotAtAll) {
  Parameters parameters = robot_parameters();
  EXPECT_EQ(parameters.set({{"host.reach", ParameterValue{5.0}}, {"speed", ParameterValue{4.0}}}),
            "speed = 4.0 must lie in [0.0, 3.0]");
  EXPECT_EQ(parameters.get("host.reach"), ParameterValue{2.0});
  EXPECT_EQ(parameters.set({{"robot_id", ParameterValue{std::int64_t{1}}}}),
            "robot_id cannot be changed while the node runs");
  EXPECT_EQ(parameters.set({{"sped", ParameterValue{1.0}}}), "there is no parameter 'sped'");
  EXPECT_EQ(parameters.set({{"speed", ParameterValue{std::string{"fast"}}}}),
            "speed = fast is of type string, must be double");
  EXPECT_EQ(parameters.set({{"speed", ParameterValue{std::int64_t{1}}}}), "");
  EXPECT_EQ(parameters.get("speed"), ParameterValue{1.0});
}

TEST(Parameters, SomebodyMayRefuseAndIsToldOfTheRest) {
  Parameters parameters = robot_parameters();
  std::vector<Parameters::Named> told;
  parameters.on_event([&](const auto& /*declared*/, const auto& changed) { told = changed; });
  parameters.accept_by([](const auto& changes) {
    return changes[0].second == ParameterValue{0.0} ? std::string{"it would not move"} : std::string{};
  });
  EXPECT_EQ(parameters.set({{"speed", ParameterValue{0.0}}}), "it would not move");
  EXPECT_THAT(told, IsEmpty());
  EXPECT_EQ(parameters.set({{"speed", ParameterValue{0.5}}}), "");
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].second, ParameterValue{0.5});
}

TEST(Parameters, AreListedByPrefixAndDepth) {
  const Parameters parameters = robot_parameters();
  EXPECT_THAT(parameters.list({}, 0).names,
              ElementsAre("host.guard.enabled", "host.reach", "robot_id", "speed"));
  EXPECT_THAT(parameters.list({}, 0).prefixes, ElementsAre("host.guard", "host"));
  EXPECT_THAT(parameters.list({}, 1).names, ElementsAre("robot_id", "speed"));
  EXPECT_THAT(parameters.list({"host"}, 1).names, ElementsAre("host.reach"));
  EXPECT_THAT(parameters.list({"host", "speed"}, 0).names,
              ElementsAre("host.guard.enabled", "host.reach", "speed"));
  EXPECT_THAT(parameters.list({"hos"}, 0).names, IsEmpty());
}

TEST(Parameters, ServicesAnswer) {
  Parameters parameters = robot_parameters();
  rcl_interfaces::GetParameters_Request get;
  get.names = {"speed", "missing"};
  const auto values = answer(parameters, get).values;
  ASSERT_EQ(values.size(), 2U);
  EXPECT_EQ(values[0].double_value, 2.0);
  EXPECT_EQ(values[1].type, rcl_interfaces::ParameterType::PARAMETER_NOT_SET);

  rcl_interfaces::DescribeParameters_Request describe;
  describe.names = {"speed", "robot_id"};
  const auto descriptors = answer(parameters, describe).descriptors;
  ASSERT_EQ(descriptors.size(), 2U);
  ASSERT_EQ(descriptors[0].floating_point_range.size(), 1U);
  EXPECT_EQ(descriptors[0].floating_point_range[0].to_value, 3.0);
  EXPECT_TRUE(descriptors[1].read_only);

  rcl_interfaces::SetParameters_Request set;
  set.parameters.resize(3);
  set.parameters[0].name = "speed";
  set.parameters[0].value = to_message(ParameterValue{1.5});
  set.parameters[1].name = "speed";
  set.parameters[1].value.type = 77;
  set.parameters[2].name = "speed";
  const auto results = answer(parameters, set).results;
  ASSERT_EQ(results.size(), 3U);
  EXPECT_TRUE(results[0].successful);
  EXPECT_EQ(results[1].reason, "speed is of type 77, which is none");
  EXPECT_FALSE(results[2].successful);
  EXPECT_EQ(parameters.get("speed"), ParameterValue{1.5});
}

TEST(Parameters, EveryTypeGoesThereAndBackAsAMessage) {
  for (const ParameterValue& value :
       {ParameterValue{}, ParameterValue{true}, ParameterValue{std::int64_t{-3}}, ParameterValue{0.5},
        ParameterValue{std::string{"x"}}, ParameterValue{std::vector<std::uint8_t>{1, 255}},
        ParameterValue{std::vector<bool>{true, false}}, ParameterValue{std::vector<std::int64_t>{1}},
        ParameterValue{std::vector<double>{0.5}}, ParameterValue{std::vector<std::string>{"a", ""}}})
    EXPECT_EQ(from_message(to_message(value)), value) << to_text(value);
}

}  // namespace
}  // namespace ros2
