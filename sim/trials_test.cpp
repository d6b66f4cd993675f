#include "sim/trials.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "sim/families.hpp"

namespace spf::sim {
namespace {

TrialsRequest crossing_request(int count) {
  TrialsRequest request;
  request.scenario = [](int trial) {
    Scenario scenario = make_scenario(family_setup(Family::t2), kDefaultSeed, trial);
    scenario.simulation.noise.level = 1.0;
    scenario.simulation.trial.time_limit = 2.0;  // the bits differ long before, were they to differ
    return scenario;
  };
  request.first = 10000;
  request.count = count;
  return request;
}

TEST(TrialsThreads, GiveTheSameBitsForAnyNumberOfThreads) {
  TrialsRequest request = crossing_request(8);
  request.jobs = 1;
  const std::vector<TrialResult> one = run_trials(request);
  ASSERT_EQ(one.size(), 8U);
  for (const int jobs : {2, 4}) {
    request.jobs = jobs;
    const std::vector<TrialResult> many = run_trials(request);
    ASSERT_EQ(many.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(many[i].trial, 10000 + static_cast<int>(i));
      EXPECT_EQ(many[i].digest, one[i].digest) << "trial " << one[i].trial << ", " << jobs << " threads";
      EXPECT_EQ(many[i].messages, one[i].messages);
      EXPECT_EQ(many[i].outcome, one[i].outcome);
    }
  }
  EXPECT_NE(one[0].digest, one[1].digest);
}

TEST(TrialsThreads, TellOfEachTrialOnceAndStopWhenAsked) {
  TrialsRequest request = crossing_request(8);
  request.jobs = 4;
  std::vector<int> done;
  request.progress = [&done](const TrialResult&, int number) {
    done.push_back(number);
    return true;
  };
  EXPECT_EQ(run_trials(request).size(), 8U);
  EXPECT_EQ(done, (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8}));

  request.progress = [](const TrialResult&, int number) { return number < 2; };
  const std::size_t ran = run_trials(request).size();
  EXPECT_GE(ran, 2U);
  EXPECT_LE(ran, 5U);  // the second to end, and what the other three threads were at
}

TEST(TrialsThreads, HandOnTheEarliestFailureAfterAllHaveEnded) {
  TrialsRequest request = crossing_request(6);
  request.jobs = 3;
  const auto scenario = request.scenario;
  request.scenario = [scenario](int trial) {
    if (trial == 10001) throw std::runtime_error{"trial 10001"};
    return scenario(trial);
  };
  EXPECT_THROW((void)run_trials(request), std::runtime_error);
  request.count = 0;
  EXPECT_TRUE(run_trials(request).empty());
}

}  // namespace
}  // namespace spf::sim
