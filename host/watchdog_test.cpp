#include "host/watchdog.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace spf::host {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

struct Case {
  StopCause cause;
  std::function<void(WatchFacts&)> happens;
};

/// The gravest first.
const std::vector<Case> kCases{
    {StopCause::emergency_stop, [](WatchFacts& facts) { facts.emergency_stop = true; }},
    {StopCause::paused, [](WatchFacts& facts) { facts.paused = true; }},
    {StopCause::clock_jump, [](WatchFacts& facts) { facts.clock_jumped = true; }},
    {StopCause::no_pose, [](WatchFacts& facts) { facts.pose_age = kEndless; }},
    {StopCause::stale_pose, [](WatchFacts& facts) { facts.pose_age = 0.31; }},
    {StopCause::stale_localisation, [](WatchFacts& facts) { facts.localisation_age = 0.31; }},
    {StopCause::no_scan, [](WatchFacts& facts) { facts.scan_age = 0.31; }},
    {StopCause::no_obstacles, [](WatchFacts& facts) { facts.obstacles_age = kEndless; }},
    {StopCause::no_plan, [](WatchFacts& facts) { facts.plan_age = kEndless; }},
    {StopCause::stale_plan, [](WatchFacts& facts) { facts.plan_age = 0.51; }},
    {StopCause::stuck, [](WatchFacts& facts) { facts.stuck = true; }},
    {StopCause::far_from_plan, [](WatchFacts& facts) { facts.plan_error = 0.61; }},
    {StopCause::control_failed, [](WatchFacts& facts) { facts.controller_failed = true; }},
};

const Watchdog kWatchdog{HostParameters{}, 0.3};

TEST(Watchdog, FindsNothingWhereAllIsWell) {
  EXPECT_EQ(kWatchdog.watch({}), StopCause::none);
  WatchFacts within;
  within.pose_age = within.localisation_age = within.scan_age = within.obstacles_age = 0.3;
  within.plan_age = 0.5;
  within.plan_error = 0.6;
  EXPECT_EQ(kWatchdog.watch(within), StopCause::none);
}

TEST(Watchdog, NamesEveryCauseAlone) {
  for (const Case& one : kCases) {
    WatchFacts facts;
    one.happens(facts);
    EXPECT_EQ(kWatchdog.watch(facts), one.cause) << to_string(one.cause);
  }
}

TEST(Watchdog, NamesTheGraverOfTwo) {
  for (std::size_t i = 0; i < kCases.size(); ++i)
    for (std::size_t j = i + 1; j < kCases.size(); ++j) {
      WatchFacts facts;
      kCases[j].happens(facts);
      kCases[i].happens(facts);  // the last word, where both are about the same age
      EXPECT_EQ(kWatchdog.watch(facts), kCases[i].cause)
          << to_string(kCases[i].cause) << " and " << to_string(kCases[j].cause);
    }
}

TEST(Watchdog, TakesAPlanAtNoKnownDistanceToBeFar) {
  WatchFacts facts;
  facts.plan_error = std::nan("");
  EXPECT_EQ(kWatchdog.watch(facts), StopCause::far_from_plan);
}

}  // namespace
}  // namespace spf::host
