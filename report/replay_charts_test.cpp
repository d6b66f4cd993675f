#include "report/replay_charts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "report/replay_json.hpp"
#include "report/test/sample_replay.hpp"

namespace spf {
namespace {

using testing::HasSubstr;
using testing::Not;

std::size_t times_in(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

ReplayData lone_robot(std::size_t frames) {
  ReplayData data;
  data.robots.emplace_back();
  data.robots[0].id = 7;
  data.robots[0].frames.resize(frames);
  return data;
}

TEST(ReplayCharts, GiveEveryRobotThreeChartsThatNameIt) {
  const ReplayData data = sample_replay();
  const std::string html = replay_charts(data);
  EXPECT_EQ(times_in(html, "<template>"), data.robots.size());
  EXPECT_EQ(times_in(html, "<svg "), 3 * data.robots.size());
  EXPECT_EQ(times_in(html, "class=\"area\""), 3 * data.robots.size());
  for (const ReplayRobot& robot : data.robots)
    for (const char* words : {"Wheel speeds of robot ", "Gaps of robot ", "Computing times of robot "})
      EXPECT_EQ(times_in(html, words + std::to_string(robot.id) + " ") +
                    times_in(html, words + std::to_string(robot.id) + ":"),
                1U);
}

TEST(ReplayCharts, ShowTheWheelLimitWhereItIsKnown) {
  ReplayData data = lone_robot(3);
  EXPECT_THAT(replay_charts(data), Not(HasSubstr("limit \xC2\xB1")));
  data.robots[0].wheel_speed_limit = std::numeric_limits<double>::infinity();
  EXPECT_THAT(replay_charts(data), Not(HasSubstr("limit \xC2\xB1")));
  data.robots[0].wheel_speed_limit = 1.25;
  EXPECT_THAT(replay_charts(data), HasSubstr("limit \xC2\xB1"
                                             "1.25 m/s"));
}

TEST(ReplayCharts, CrossOutPlansThatFailed) {
  ReplayData data = lone_robot(11);
  ReplayPlan plan;
  plan.time = 0.5;
  plan.planning_time = 0.002;
  data.robots[0].plans = {plan};
  const std::string failed = replay_charts(data);
  EXPECT_EQ(times_in(failed, "stroke=\"var(--bad)\""), 1U);
  EXPECT_EQ(times_in(failed, "stroke-linecap=\"round\""), 0U);
  data.robots[0].plans[0].points = {{0.5, 0.0, 0.0}};
  const std::string planned = replay_charts(data);
  EXPECT_EQ(times_in(planned, "stroke=\"var(--bad)\""), 0U);
  EXPECT_EQ(times_in(planned, "stroke-linecap=\"round\""), 1U);
}

TEST(ReplayCharts, DrawNoGapThatIsUnknownOrFar) {
  ReplayData data = lone_robot(5);
  EXPECT_EQ(times_in(replay_charts(data), "<path"), 3U);  // wheels stand still, nothing else is known
  const double gaps[] = {7.0, 1.0, 2.0, kUnknown, 3.0};
  for (std::size_t k = 0; k < 5; ++k) data.robots[0].frames[k].to_peer.distance = gaps[k];
  const std::string html = replay_charts(data);
  EXPECT_EQ(times_in(html, "<path"), 4U);
  EXPECT_THAT(html, Not(HasSubstr(">6</text>")));  // the axis ends where what is drawn ends
  EXPECT_THAT(html, Not(HasSubstr("nan")));
}

TEST(ReplayCharts, SurviveRunsWithoutTimeOrRobots) {
  EXPECT_EQ(replay_charts(ReplayData{}), "");
  for (const std::size_t frames : {0U, 1U}) {
    const std::string html = replay_charts(lone_robot(frames));
    EXPECT_EQ(times_in(html, "</svg>"), 3U);
    EXPECT_THAT(html, Not(HasSubstr("nan")));
    EXPECT_THAT(html, Not(HasSubstr("inf")));
  }
}

// A page holds the numbers too, and is sent by mail: pictures must stay the smaller part.
TEST(ReplayCharts, StayFarSmallerThanTheRunTheyShow) {
  SampleReplayRequest request;
  request.robots = 4;
  for (const double duration : {24.0, 600.0}) {
    request.duration = duration;
    const ReplayData data = sample_replay(request);
    EXPECT_LT(static_cast<double>(replay_charts(data).size()),
              0.3 * static_cast<double>(replay_json(data).size()))
        << duration << " s";
  }
}

}  // namespace
}  // namespace spf
