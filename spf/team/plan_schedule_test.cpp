#include "spf/team/plan_schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

constexpr double kPlanPeriod = 0.1;  // [s]
constexpr double kLeastApart = 0.02;
constexpr double kOneTick = 0.001;

TEST(PlanSchedule, KeepsItsPeriodWhereNothingIsBroughtForward) {
  PlanSchedule schedule{kPlanPeriod, 5.0, 0.0};
  for (int plan = 0; plan < 10; ++plan) {
    const double time = 5.0 + kPlanPeriod * plan;
    EXPECT_FALSE(schedule.due(time - kOneTick));
    EXPECT_TRUE(schedule.due(time));
    schedule.planned(time + 0.03);  // a late one shifts none
  }
}

/// Wherever its clock stood when it was made.
TEST(PlanSchedule, PlansAtItsOwnInstantsOfThePeriodAfterTheFirst) {
  constexpr double kPhase = 0.4;
  for (const double start : {0.0, 0.02, 0.05, 7.13, 1.7e9 + 0.061}) {
    SCOPED_TRACE(start);
    PlanSchedule schedule{kPlanPeriod, start, kPhase};
    ASSERT_TRUE(schedule.due(start));
    schedule.planned(start);
    for (int plan = 0; plan < 100; ++plan) {
      const double time = schedule.next();
      ASSERT_LE(time, start + (plan + 1) * kPlanPeriod + 1e-6);
      const double periods = time / kPlanPeriod - kPhase;
      ASSERT_NEAR(periods, std::round(periods), 1e-5);
      schedule.planned(time);
      ASSERT_GT(schedule.next(), time + 0.9 * kPlanPeriod);
    }
    schedule.planned(start + 1000.013);  // nor does it lose them after a pause
    const double periods = schedule.next() / kPlanPeriod - kPhase;
    EXPECT_NEAR(periods, std::round(periods), 1e-5);
  }
}

TEST(PlanSchedule, WhatHasComeIsPlannedWithAtOnce) {
  PlanSchedule schedule{kPlanPeriod, 0.0, 0.0};
  schedule.planned(0.0);
  schedule.bring_forward(0.037, kLeastApart);
  EXPECT_FALSE(schedule.due(0.036));
  EXPECT_TRUE(schedule.due(0.037));
  schedule.planned(0.037);
  EXPECT_FALSE(schedule.due(0.038));
}

TEST(PlanSchedule, WhatComesTooSoonWaitsForTheLeastInterval) {
  PlanSchedule schedule{kPlanPeriod, 0.0, 0.0};
  schedule.bring_forward(0.0, kLeastApart);
  schedule.planned(0.0);
  schedule.bring_forward(0.005, kLeastApart);
  schedule.bring_forward(0.015, kLeastApart);
  EXPECT_FALSE(schedule.due(kLeastApart - kOneTick));
  EXPECT_TRUE(schedule.due(kLeastApart));
  schedule.planned(kLeastApart);
  EXPECT_FALSE(schedule.due(kPlanPeriod));
}

TEST(PlanSchedule, APlanOfThePeriodDelaysNothingThatComesAfterIt) {
  PlanSchedule schedule{kPlanPeriod, 0.0, 0.0};
  schedule.planned(0.0);
  schedule.bring_forward(0.001, kLeastApart);
  EXPECT_TRUE(schedule.due(0.001));
}

TEST(PlanSchedule, WaitsALittleForWhatComesRegularlyAndThenKeepsItsPeriod) {
  PlanSchedule schedule{kPlanPeriod, 0.0, 0.0};
  schedule.bring_forward(0.0, kLeastApart);
  schedule.planned(0.0);
  const double latest = kPlanPeriod + PlanSchedule::kLongestDelay;
  EXPECT_EQ(schedule.next(), latest);
  EXPECT_FALSE(schedule.due(latest - kOneTick));
  EXPECT_TRUE(schedule.due(latest));
  schedule.planned(latest);
  EXPECT_FALSE(schedule.due(latest + kPlanPeriod - kOneTick));
  EXPECT_TRUE(schedule.due(latest + kPlanPeriod));
}

TEST(PlanSchedule, AnIntervalOfAPeriodLeavesThePeriodAlone) {
  PlanSchedule schedule{kPlanPeriod, 0.0, 0.0};
  PlanSchedule undisturbed{kPlanPeriod, 0.0, 0.0};
  for (int tick = 0; tick < 1000; ++tick) {
    const double now = 0.01 * tick;
    schedule.bring_forward(now, kPlanPeriod);
    ASSERT_EQ(schedule.next(), undisturbed.next());
    if (!schedule.due(now)) continue;
    schedule.planned(now);
    undisturbed.planned(now);
  }
}

/// Whatever comes whenever: what has come is planned with within the least interval, and no more often than
/// it comes, but for the plans of the period.
TEST(PlanSchedule, IsBoundedHoweverOftenSomethingComes) {
  for (const double mean_gap : {0.0005, 0.01, 0.025, 0.1, 0.4}) {
    SCOPED_TRACE(mean_gap);
    RandomStream random{7};
    PlanSchedule schedule{kPlanPeriod, 0.0, 0.0};
    double next_arrival = 0.0;
    double waits_since = -1.0;  // < 0: nothing waits
    double last_plan = 0.0;
    double last_with = -1.0;  // a plan that took something in
    int arrivals = 0;
    int plans = 0;
    constexpr double kEnd = 60.0;
    for (double now = 0.0; now < kEnd; now += kOneTick) {
      for (; next_arrival <= now; next_arrival += random.uniform(0.0, 2.0 * mean_gap)) {
        schedule.bring_forward(now, kLeastApart);
        ++arrivals;
        if (waits_since < 0.0) waits_since = now;
      }
      ASSERT_LE(now - last_plan, kPlanPeriod + PlanSchedule::kLongestDelay + 1e-6);
      if (!schedule.due(now)) {
        ASSERT_TRUE(waits_since < 0.0 || now - waits_since < kLeastApart);
        continue;
      }
      if (waits_since >= 0.0) {
        ASSERT_GE(now - last_with, kLeastApart - 1e-6);
        last_with = now;
      }
      schedule.planned(now);
      ++plans;
      last_plan = now;
      waits_since = -1.0;
    }
    EXPECT_LE(plans, arrivals + kEnd / kPlanPeriod + 1.0);
    EXPECT_LE(plans, kEnd / kLeastApart + kEnd / kPlanPeriod + 1.0);
  }
}

}  // namespace
}  // namespace spf
