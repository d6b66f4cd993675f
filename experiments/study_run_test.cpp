#include "experiments/study_run.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

/// Two robots and a walking disc in a small place; everything random is switched on.
Study small_study(const std::vector<Setting>& settings = {}) {
  return study_from_text(
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
  first.wall_time = second.wall_time = 0.0;
  EXPECT_EQ(to_json_line(first), to_json_line(second));
}

TEST(StudyRunThreads, GivesTheSameRecordsForAnyNumberOfJobs) {
  const Study study = small_study();
  StudyRequest request;
  request.first = 10;
  request.trials = 5;
  const std::vector<TrialRecord> alone = run_study(study, request);
  request.jobs = 4;
  const std::vector<TrialRecord> together = run_study(study, request);
  ASSERT_EQ(alone.size(), 5u);
  ASSERT_EQ(together.size(), 5u);
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(alone[i].key.trial, 10 + static_cast<int>(i));
    expect_same(alone[i], together[i]);
  }
  EXPECT_NE(alone[0].digest, alone[1].digest);
}

TEST(StudyRun, RecordingChangesNothing) {
  const Study study = small_study();
  StudyRequest request;
  request.first = 3;
  const std::vector<TrialRecord> plain = run_study(study, request);
  SingleRequest single;
  single.trial = 3;
  single.record = true;
  const RecordedTrial recorded = run_single(study, single);
  ASSERT_EQ(plain.size(), 1u);
  expect_same(plain[0], recorded.record);
  EXPECT_NE(recorded.recording, nullptr);
}

TEST(StudyRun, StopsWhenToldTo) {
  StudyRequest request;
  request.trials = 100;
  request.progress = [](const TrialRecord&, int done) { return done < 2; };
  EXPECT_EQ(run_study(small_study(), request).size(), 2u);
  SingleRequest single;
  single.progress = [](double time) { return time < 0.95; };
  const RecordedTrial stopped = run_single(small_study(), single);
  EXPECT_TRUE(stopped.stopped);
  EXPECT_LT(stopped.record.sim_time, 1.5);
}

TEST(StudyRunThreads, DropsTrialsUnderWayWhenToldToStop) {
  std::atomic<bool> stop{false};
  StudyRequest request;
  request.trials = 100;
  request.jobs = 3;
  request.clock = [] { return 0.0; };
  request.stop = [&stop] { return stop.load(); };
  int ended = 0;
  request.progress = [&](const TrialRecord&, int) {
    if (++ended == 2) stop = true;
    return true;
  };
  const std::vector<TrialRecord> kept = run_study(small_study(), request);
  EXPECT_EQ(kept.size(), static_cast<std::size_t>(ended));
  EXPECT_LT(ended, 6);  // the second, and at most what the other threads were just ending
}

TEST(StudyRun, TimesOnlyWithAClock) {
  StudyRequest request;
  EXPECT_EQ(run_study(small_study(), request)[0].plan_time.count(), 0);
  double ticks = 0.0;
  request.clock = [&ticks] { return ticks += 1e-6; };
  const TrialRecord record = run_study(small_study(), request)[0];
  EXPECT_GT(record.plan_time.count(), 0);
  EXPECT_GT(record.control_time.count(), 0);
  EXPECT_GT(record.wall_time, 0.0);
}

TEST(StudyRun, SaysWhyATrialFailed) {
  StudyRequest request;
  const TrialRecord late = run_study(small_study({{"trial.time_limit=1"}}), request)[0];
  EXPECT_EQ(late.outcome, "overtime");
  EXPECT_EQ(late.failure.rfind("not home in time: robot 0", 0), 0u) << late.failure;
  EXPECT_FALSE(late.robots[0].arrived);

  // A disc that no robot can escape: faster, and as wide as the corridor.
  const Study doomed = study_from_text(
      "family: explicit\nrobots: [{start: [0, 0], goal: [9, 0]}]\nborder: {low: [-1, -1], high: [10, 1]}\n"
      "moving: [{position: [8, 0], velocity: [-3, 0], radius: 0.9}]\n",
      "doomed.yaml");
  const TrialRecord hit = run_study(doomed, request)[0];
  ASSERT_EQ(hit.outcome, "collision");
  ASSERT_TRUE(hit.contact.has_value());
  EXPECT_EQ(hit.contact->with, "disc");
  EXPECT_EQ(hit.contact->robot, 0);
  EXPECT_NE(hit.failure.find("touched disc 0"), std::string::npos) << hit.failure;
}

TEST(StudyRun, NamesItsTrials) {
  const TrialKey key = key_of(small_study({{"method=es2"}, {"trial.tracking=ideal"}, {"seed=5"}}), 7);
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

TEST(StudyRun, CrossesStaticClutterOfHundredsOfDiscs) {
  // Clumps with lanes between them: the middle lane is kept clear in part, so that a way through exists.
  std::string text = cluttered_corridor(4);
  Study study = study_from_text(text, "clutter.yaml");
  std::erase_if(study.scene.discs, [](const DiscEntry& disc) {
    const double lane = 2.25 + 0.8 * std::sin(0.9 * disc.center.x());
    return std::abs(disc.center.y() - lane) < 0.5;
  });
  EXPECT_GT(study.scene.discs.size(), 150U);
  StudyRequest request;
  const std::vector<TrialRecord> records = run_study(study, request);
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records.front().outcome, "success") << records.front().failure;
}

}  // namespace
}  // namespace spf
