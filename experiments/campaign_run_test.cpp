#include "experiments/campaign_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/run_configuration_test.hpp"
#include "experiments/trial_run.hpp"
#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

/// Two robots and a moving disc in a small area; everything random is switched on.
RunConfiguration small_configuration(const std::vector<Setting>& settings = {}) {
  return run_configuration_from_text(
      "family: explicit\n"
      "robots: [{start: [0, 0], goal: [3, 0]}, {start: [3, 1], goal: [0, 1]}]\n"
      "moving: [{position: [1.5, 3], velocity: [0.1, -0.3], radius: 0.3}]\n"
      "border: {low: [-2, -3], high: [5, 5]}\n"
      "noise: {model: walk, level: 1}\n"
      "sensing: {map: sensed, detections: noisy, range_sigma: 0.01}\n"
      "pose_noise: {position_sigma: 0.01}\n"
      "radio: {loss: 0.1}\n",
      "small.yaml", settings);
}

void expect_same(const TrialRecord& a, const TrialRecord& b) {
  TrialRecord first = a, second = b;
  first.plan_time = second.plan_time = first.control_time = second.control_time = {};
  first.new_plan_time = second.new_plan_time = first.optimiser_time = second.optimiser_time = {};
  first.wall_time = second.wall_time = 0.0;
  EXPECT_EQ(to_json_line(first), to_json_line(second));
}

TEST(CampaignRunThreads, GivesTheSameRecordsForAnyNumberOfJobs) {
  const RunConfiguration config = small_configuration();
  const std::vector<TrialRecord> alone = run_configuration(config, 10, 5);
  ASSERT_EQ(alone.size(), 5u);
  for (const int jobs : {2, 4}) {
    CampaignRequest request;
    request.jobs = jobs;
    const std::vector<TrialRecord> together = run_configuration(config, 10, 5, request);
    ASSERT_EQ(together.size(), 5u);
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_EQ(alone[i].key.trial, 10 + static_cast<int>(i));
      expect_same(alone[i], together[i]);
    }
  }
  EXPECT_NE(alone[0].digest, alone[1].digest);
}

TEST(CampaignRunThreads, DropsTrialsUnderWayWhenToldToStop) {
  for (const int jobs : {1, 3}) {
    std::atomic<bool> stop{false};
    int ended = 0;
    CampaignRequest request;
    request.jobs = jobs;
    request.stop = [&stop] { return stop.load(); };
    request.finished = [&](const TrialRecord&) {
      if (++ended == 2) stop = true;
    };
    const std::vector<TrialRecord> kept = run_configuration(small_configuration(), 0, 100, request);
    EXPECT_EQ(kept.size(), static_cast<std::size_t>(ended));
    EXPECT_LT(ended, 3 + jobs);  // the second, and at most what the other threads were just ending
  }
}

TEST(CampaignRun, NamesTheTrialThatCannotRun) {
  RunConfiguration config = small_configuration();
  config.scene.robots[1].start = config.scene.robots[0].start;
  EXPECT_THAT(
      [&] { (void)run_configuration(config, 7, 2); },
      testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("trial 7 of explicit, space_time")));
}

TEST(TrialRun, RecordingChangesNothing) {
  const Cell cell = cell_of(small_configuration());
  TrialOptions options;
  const FinishedTrial plain = run_trial(cell, 3, options);
  options.record = true;
  const FinishedTrial recorded = run_trial(cell, 3, options);
  expect_same(plain.record, recorded.record);
  EXPECT_EQ(plain.recording, nullptr);
  EXPECT_NE(recorded.recording, nullptr);
}

TEST(TrialRun, StopsWhenToldTo) {
  TrialOptions options;
  options.progress = [](double time) { return time < 0.95; };
  const FinishedTrial stopped = run_trial(cell_of(small_configuration()), 0, options);
  EXPECT_TRUE(stopped.stopped);
  EXPECT_LT(stopped.record.sim_time, 1.5);
}

TEST(TrialRun, TimesOnlyWithAClock) {
  const Cell cell = cell_of(small_configuration());
  const TrialRecord untimed = run_trial(cell, 0).record;
  EXPECT_EQ(untimed.plan_time.count(), 0);
  EXPECT_EQ(untimed.new_plan_time.count(), 0);
  double ticks = 0.0;
  TrialOptions options;
  options.clock = [&ticks] { return ticks += 1e-6; };
  const TrialRecord record = run_trial(cell, 0, options).record;
  EXPECT_GT(record.new_plan_time.count(), 0);
  EXPECT_LE(record.new_plan_time.count(), record.plan_time.count());
  EXPECT_GT(record.control_time.count(), 0);
  EXPECT_GT(record.wall_time, 0.0);
}

TEST(TrialRun, SaysWhyATrialFailed) {
  const TrialRecord late = run_trial(cell_of(small_configuration({{"trial.time_limit=1"}})), 0).record;
  EXPECT_EQ(late.outcome, sim::TrialOutcome::timeout);
  EXPECT_EQ(late.failure.rfind("not arrived in time: robot 0", 0), 0u) << late.failure;
  EXPECT_FALSE(late.robots[0].arrived);
  ASSERT_TRUE(late.cause.has_value());
  EXPECT_EQ(late.cause->robot, 0);
  EXPECT_EQ(late.cause->stand_reason, "moving");

  // A disc that no robot can escape: faster, and as wide as the corridor.
  const RunConfiguration doomed = run_configuration_from_text(
      "family: explicit\nrobots: [{start: [0, 0], goal: [9, 0]}]\nborder: {low: [-1, -1], high: [10, 1]}\n"
      "moving: [{position: [8, 0], velocity: [-3, 0], radius: 0.9}]\n",
      "doomed.yaml");
  const TrialRecord hit = run_trial(cell_of(doomed), 0).record;
  ASSERT_EQ(hit.outcome, sim::TrialOutcome::collision);
  ASSERT_TRUE(hit.contact.has_value());
  EXPECT_EQ(hit.contact->with, "disc");
  EXPECT_EQ(hit.contact->robot, 0);
  EXPECT_NE(hit.failure.find("touched disc 0"), std::string::npos) << hit.failure;
  ASSERT_TRUE(hit.cause.has_value());
  EXPECT_EQ(hit.cause->robot, 0);
  EXPECT_FALSE(hit.cause->last_plan.empty());
}

/// The watch has seen what a recording shows.
TEST(TrialRun, TellsOfWheelsAndCausesWhatARecordingShows) {
  TrialOptions options;
  options.record = true;
  const FinishedTrial trial = run_trial(cell_of(small_configuration({{"trial.time_limit=2"}})), 0, options);
  const sim::Recording& recording = *trial.recording;
  double most = 0.0;
  for (const sim::RecordedFrame& frame : recording.frames)
    for (const sim::RecordedRobot& robot : frame.robots)
      most = std::max(
          {most, robot.wheel_speeds.cwiseAbs().maxCoeff(), robot.wheel_commands.cwiseAbs().maxCoeff()});
  EXPECT_EQ(trial.record.wheel_share, most / recording.scenario.robot.max_wheel_speed);
  ASSERT_TRUE(trial.record.cause.has_value());
  const CauseRecord& cause = *trial.record.cause;
  const auto robot = static_cast<std::size_t>(cause.robot);
  EXPECT_EQ(cause.blocking_id, recording.frames.back().robots[robot].status.blocking_id);
  const sim::RecordedPlan* last = nullptr;
  for (const sim::RecordedPlan& plan : recording.plans)
    if (plan.robot == cause.robot) last = &plan;
  ASSERT_NE(last, nullptr);
  EXPECT_EQ(cause.last_plan, to_string(last->outcome));
  EXPECT_EQ(cause.plan_age, trial.record.sim_time - last->time);
  const FinishedTrial ideal = run_trial(cell_of(small_configuration({{"trial.tracking=ideal"}})), 0);
  EXPECT_TRUE(std::isnan(ideal.record.wheel_share));
}

TEST(TrialRun, NamesItsTrials) {
  const Cell cell = cell_of(small_configuration({{"method=es2"}, {"trial.tracking=ideal"}, {"seed=5"}}));
  const TrialKey key = run_trial(cell, 7).record.key;
  EXPECT_EQ(key.family, "explicit");
  EXPECT_EQ(key.method, "es2");
  EXPECT_EQ(key.noise, "walk");
  EXPECT_EQ(key.level, 1.0);
  EXPECT_EQ(key.tracking, "ideal");
  EXPECT_EQ(key.seed, 5u);
  EXPECT_EQ(key.trial, 7);
}

/// Static clutter as in public benchmarks of ground robots: discs of 0.075 m at random on a lattice between
/// two walls, some hundreds of them.
std::string cluttered_corridor(std::uint64_t seed) {
  RandomStream random{seed};
  std::string text =
      "family: explicit\n"
      "robot: {radius: 0.2}\n"
      "robots: [{start: [0, 2.25], goal: [12, 2.25]}]\n"
      "walls: [{from: [-1, 0], to: [13, 0]}, {from: [-1, 4.5], to: [13, 4.5]}]\n"
      "discs:\n";
  for (int i = 0; i < 66; ++i)
    for (int j = 1; j < 30; ++j)
      if (random.uniform() < 0.16)
        text += "  - {center: [" + std::to_string(1.0 + 0.15 * i) + ", " + std::to_string(0.15 * j) +
                "], radius: 0.075}\n";
  return text;
}

TEST(TrialRun, CrossesStaticClutterOfHundredsOfDiscs) {
  // Clumps with lanes between them: the middle lane is kept clear in part, so that a way through exists.
  std::string text = cluttered_corridor(4);
  RunConfiguration config = run_configuration_from_text(text, "clutter.yaml");
  std::erase_if(config.scene.discs, [](const DiscEntry& disc) {
    const double lane = 2.25 + 0.8 * std::sin(0.9 * disc.center.x());
    return std::abs(disc.center.y() - lane) < 0.5;
  });
  EXPECT_GT(config.scene.discs.size(), 150U);
  const TrialRecord record = run_trial(cell_of(config), 0).record;
  EXPECT_TRUE(record.succeeded()) << record.failure;
}

}  // namespace
}  // namespace spf
