#include "report/replay_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "report/test/sample_replay.hpp"

namespace spf {
namespace {

using nlohmann::json;

/// The reader's half, written from the description of the format alone.
std::vector<double> decoded(const json& differences, std::size_t length, double step) {
  std::vector<double> values;
  double running = 0.0;
  for (std::size_t i = 0; i < length; ++i) {
    const json difference = i < differences.size() ? differences[i] : json(0);
    if (!difference.is_null()) running += difference.get<double>();
    values.push_back(difference.is_null() ? std::nan("") : running * step);
  }
  return values;
}

ReplayData one_robot(std::size_t frames) {
  ReplayData data;
  ReplayRobot robot;
  robot.id = 7;
  robot.frames.resize(frames);
  data.robots = {robot};
  return data;
}

TEST(ReplayJson, GivesEveryPoseBackToHalfAMillimetre) {
  const ReplayData data = sample_replay();
  const json whole = json::parse(replay_json(data));
  ASSERT_EQ(whole["robots"].size(), data.robots.size());
  const std::size_t frames = whole["frames"];
  for (std::size_t r = 0; r < data.robots.size(); ++r) {
    const json& raw = whole["robots"][r];
    const std::vector<double> x = decoded(raw["x"], frames, 1e-3);
    const std::vector<double> estimate_y = decoded(raw["estimate_y"], frames, 1e-3);
    const std::vector<double> wheel = decoded(raw["wheels"][2], frames, 1e-3);
    const std::vector<double> control = decoded(raw["control"], frames, 1e-7);
    const std::vector<double> state = decoded(raw["state"], frames, 1.0);
    for (std::size_t k = 0; k < frames; ++k) {
      const ReplayRobotFrame& frame = data.robots[r].frames[k];
      EXPECT_NEAR(x[k], frame.pose.x, 0.5001e-3);  // half a step; differences must not add up
      EXPECT_NEAR(estimate_y[k], frame.estimate.y, 0.5001e-3);
      EXPECT_NEAR(wheel[k], frame.wheel_speeds[2], 0.5001e-3);
      EXPECT_NEAR(control[k], frame.control_time, 0.5001e-7);
      EXPECT_EQ(static_cast<int>(state[k]), frame.state);
    }
  }
}

TEST(ReplayJson, GoalsChange) {
  ReplayData data = one_robot(1);
  EXPECT_FALSE(json::parse(replay_json(data))["robots"][0].contains("goals"));
  data.robots[0].goal = {1.0, 2.0};
  data.robots[0].goals = {{2.5, {3.0, -4.0}}, {6.0, {kUnknown, kUnknown}}};
  const json goals = json::parse(replay_json(data))["robots"][0]["goals"];
  ASSERT_EQ(goals.size(), 2U);
  EXPECT_EQ(goals[0]["at"][1], -4000);
  EXPECT_TRUE(goals[1]["at"][0].is_null());
  EXPECT_EQ(goal_at(data.robots[0], 2.4).y, 2.0);
  EXPECT_EQ(goal_at(data.robots[0], 2.5).y, -4.0);
  EXPECT_TRUE(std::isnan(goal_at(data.robots[0], 7.0).x));
}

TEST(ReplayJson, PlansKeepEndsOutcomeAndCandidates) {
  ReplayData data = one_robot(1);
  ReplayPlan plan;
  plan.time = 1.5;
  plan.points = {{1.5, 0.0, 1.0}, {2.0, 0.5, 1.0}, {2.5, 1.0, 1.0}};  // straight and even: the middle may go
  plan.outcome = "planned";
  plan.planning_time = 0.00123;
  plan.evaluations = 42;
  plan.candidates = {{"left", {{0.0, 1.0}, {1.0, 2.0}}, false, 12.34567, 0.25},
                     {"wait", {}, true, 3.0, kUnknown}};
  data.robots[0].plans = {plan};
  const json whole = json::parse(replay_json(data));
  const json& texts = whole["texts"];
  const json& row = whole["robots"][0]["plans"][0];
  EXPECT_EQ(row[0], 1500);
  EXPECT_EQ(texts[row[1].get<std::size_t>()], "planned");
  EXPECT_EQ(row[2], 12300);
  EXPECT_EQ(row[3], 42);
  ASSERT_EQ(row[4], 2);
  EXPECT_EQ(row[5], (json{1500, 1000}));
  EXPECT_EQ(row[6], (json{0, 1000}));
  EXPECT_EQ(row[7], (json::array({1000})));  // the second difference is 0 and left out
  ASSERT_EQ(row[8].size(), 2U);
  EXPECT_EQ(texts[row[8][0][0].get<std::size_t>()], "left");
  EXPECT_EQ(row[8][0][1], 0);
  EXPECT_EQ(row[8][0][2], 12.346);
  EXPECT_EQ(row[8][1][1], 1);
  EXPECT_EQ(row[8][1][4], 0);
}

TEST(ReplayJson, KeepsTracksWithTheirFramesThroughGaps) {
  ReplayData data = one_robot(6);
  for (const std::size_t k : {1U, 2U, 4U, 5U})
    data.robots[0].frames[k].tracks = {{3, static_cast<double>(k), -1.0, 0.25}};
  data.robots[0].frames[5].tracks.push_back({9, 2.0, 2.0, 0.5});
  const json tracks = json::parse(replay_json(data))["robots"][0]["tracks"];
  ASSERT_EQ(tracks.size(), 3U);
  EXPECT_EQ(tracks[0]["first"], 1);
  EXPECT_EQ(tracks[0]["n"], 2);
  EXPECT_EQ(tracks[1]["id"], 3);
  EXPECT_EQ(tracks[1]["first"], 4);
  EXPECT_THAT(decoded(tracks[1]["x"], 2, 1e-3),
              testing::ElementsAre(testing::DoubleEq(4.0), testing::DoubleEq(5.0)));
  EXPECT_EQ(tracks[2]["id"], 9);
  EXPECT_EQ(tracks[2]["first"], 5);
}

TEST(ReplayJson, StoresTheOneSigmaEllipseOfACovariance) {
  // Built from its axes: 0.4 m along 30 degrees, 0.1 m across.
  const double c = std::cos(std::acos(-1.0) / 6.0);
  const double s = 0.5;
  ReplayData data = one_robot(1);
  data.robots[0].frames[0].estimate_covariance = {0.16 * c * c + 0.01 * s * s, (0.16 - 0.01) * c * s,
                                                  0.16 * s * s + 0.01 * c * c};
  const json robot = json::parse(replay_json(data))["robots"][0];
  EXPECT_EQ(robot["sigma_long"][0], 4000);  // in 0.1 mm
  EXPECT_EQ(robot["sigma_short"][0], 1000);
  EXPECT_EQ(robot["sigma_angle"][0], 524);  // in mrad: pi / 6 = 523.6
}

TEST(ReplayJson, UnknownNumbersAreNullAndDoNotMoveTheRest) {
  ReplayData data = one_robot(4);
  const double infinite = std::numeric_limits<double>::infinity();
  const double gaps[] = {1.5, kUnknown, infinite, 1.6};
  for (std::size_t k = 0; k < 4; ++k) data.robots[0].frames[k].to_peer.distance = gaps[k];
  data.robots[0].plans = {{}};
  data.robots[0].plans[0].candidates = {{}};
  const json robot = json::parse(replay_json(data))["robots"][0];
  EXPECT_EQ(robot["clearance"]["peer"]["distance"], (json{1500, nullptr, nullptr, 100}));
  EXPECT_TRUE(robot["plans"][0][2].is_null());        // computing
  EXPECT_TRUE(robot["plans"][0][8][0][2].is_null());  // cost of a candidate
}

TEST(ReplayJson, HoldsTheSeedExactly) {
  ReplayData data = one_robot(1);
  data.seed = 18446744073709551615ULL;
  EXPECT_EQ(json::parse(replay_json(data))["seed"], "18446744073709551615");
}

TEST(ReplayJson, TextsComeBackAndCannotLeaveTheScriptElement) {
  ReplayData data = one_robot(1);
  const std::string hostile = "</script><script>alert(1)</script> <!-- & \" ' \\ \n \xE2\x80\xA8 \xC3\xA4";
  data.title = hostile;
  data.states[0].text = hostile;
  data.events = {{0.0, 7, ReplayEventKind::stop, hostile, hostile, std::nullopt}};
  data.summary = {{hostile, hostile}};
  const std::string text = replay_json(data);
  EXPECT_EQ(text.find_first_of("<>&"), std::string::npos);
  EXPECT_TRUE(
      std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80U; }));
  const json whole = json::parse(text);
  EXPECT_EQ(whole["title"], hostile);
  EXPECT_EQ(whole["states"][0]["text"], hostile);
  EXPECT_EQ(whole["texts"][whole["events"][0]["text"].get<std::size_t>()], hostile);
  EXPECT_EQ(whole["summary"][0][1], hostile);
}

TEST(ReplayJson, BrokenUtf8IsReplacedNotRefused) {
  ReplayData data = one_robot(1);
  data.title = "before \xFF\xC3 after";
  const std::string title = json::parse(replay_json(data))["title"];
  EXPECT_THAT(title, testing::StartsWith("before "));
  EXPECT_THAT(title, testing::EndsWith(" after"));
}

TEST(ReplayJson, RefusesWhatDoesNotFitTogetherWithAllReasons) {
  ReplayData data = one_robot(3);
  data.frame_interval = kUnknown;
  data.bounds = {{1.0, 0.0}, {1.0, 2.0}};
  data.robots.push_back(data.robots[0]);
  data.robots[1].frames.resize(2);
  data.robots[0].frames[1].state = 5;
  data.obstacles = {{}};
  try {
    (void)replay_json(data);
    FAIL() << "expected std::invalid_argument";
  } catch (const std::invalid_argument& error) {
    for (const char* reason :
         {"frame_interval", "bounds", "robot id 7 is used twice", "robot 7 has 2 frames, expected 3",
          "robot 7 has state 5", "obstacle 0 has 0 frames"}) {
      EXPECT_THAT(error.what(), testing::HasSubstr(reason));
    }
  }
}

TEST(ReplayJson, AnEmptyRunIsLegal) {
  const json whole = json::parse(replay_json(ReplayData{}));
  EXPECT_EQ(whole["frames"], 0);
  EXPECT_TRUE(whole["robots"].empty());
}

TEST(ReplayJson, TwelveRobotsForAMinuteStaySmall) {
  SampleReplayRequest request;
  request.robots = 12;
  request.duration = 60.0;
  request.replan_interval = 0.1;  // as often as the checks of a real run may ask for
  EXPECT_LT(replay_json(sample_replay(request)).size(), 3'000'000U);  // 2.4 MB when written; 4 MB is the aim
}

}  // namespace
}  // namespace spf
