#include "sim/crowd.hpp"

#include <gtest/gtest.h>

#include <map>

#include "sim/crowd_generator.hpp"
#include "sim/crowd_recording.hpp"
#include "sim/families.hpp"
#include "sim/pedestrian_scene.hpp"
#include "sim/simulation.hpp"

namespace spf::sim {
namespace {

/// One person along x at 1 m/s, sampled every 0.4 s over [from, to].
void add_walk(std::vector<CrowdSample>& samples, int id, const Eigen::Vector2d& start,
              const Eigen::Vector2d& velocity, double from, double to) {
  for (int k = 0; from + 0.4 * k <= to + 1e-9; ++k)
    samples.push_back({from + 0.4 * k, id, start + 0.4 * k * velocity});
}

std::vector<CrowdSample> sorted(std::vector<CrowdSample> samples) {
  std::stable_sort(samples.begin(), samples.end(),
                   [](const CrowdSample& a, const CrowdSample& b) { return a.time < b.time; });
  return samples;
}

/// An area of 12 m x 10 m in which two people stand in corners for 100 s.
std::vector<CrowdSample> quiet_scene() {
  std::vector<CrowdSample> samples;
  add_walk(samples, 1, {0.0, 0.0}, Eigen::Vector2d::Zero(), 0.0, 100.0);
  add_walk(samples, 2, {12.0, 10.0}, Eigen::Vector2d::Zero(), 0.0, 100.0);
  return samples;
}

FamilySetup setup_with(std::vector<CrowdSample> samples) {
  FamilySetup setup = family_setup(Family::ped);
  setup.crowd = std::make_shared<const CrowdRecording>(sorted(std::move(samples)));
  return setup;
}

TEST(Crowd, MovesLinearlyAndIsAwayInGaps) {
  std::vector<CrowdSample> samples;
  add_walk(samples, 7, {0.0, 0.0}, {1.0, 0.0}, 0.0, 2.0);
  add_walk(samples, 7, {9.0, 0.0}, {1.0, 0.0}, 4.0, 6.0);
  Crowd crowd{samples, 0.6};
  std::map<int, double> seen;  // by tenths of a second
  for (int k = 0; k <= 60; ++k)
    crowd.visit(0.1 * k, 0.1, [&](int id, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
      EXPECT_EQ(id, 7);
      EXPECT_NEAR(to.x() - from.x(), 0.1, 1e-12);
      seen[k] = from.x();
    });
  EXPECT_EQ(seen.size(), 40U);  // twenty steps each time
  EXPECT_NEAR(seen.at(13), 1.3, 1e-12);
  EXPECT_EQ(seen.count(20), 0U);
  EXPECT_EQ(seen.count(39), 0U);
  EXPECT_NEAR(seen.at(59), 10.9, 1e-12);
}

TEST(CrowdRecording, CountsWholeWindows) {
  std::vector<CrowdSample> samples;
  add_walk(samples, 1, {0.0, 0.0}, {0.1, 0.0}, 3.0, 103.0);
  const CrowdRecording recording{samples};
  EXPECT_NEAR(recording.interval(), 0.4, 1e-9);
  EXPECT_EQ(recording.window_count(60.0, 5.0), 9);   // 3, 8, ..., 43
  EXPECT_EQ(recording.window_count(100.0, 5.0), 1);  // exactly one
  EXPECT_EQ(recording.window_count(200.0, 5.0), 1);  // shorter than a window
  const std::vector<CrowdSample> window = recording.window(23.0, 10.0);
  EXPECT_NEAR(window.front().time, -0.4, 1e-6);
  EXPECT_NEAR(window.back().time, 10.4, 1e-6);
  EXPECT_THROW(CrowdRecording{{}}, std::invalid_argument);
}

TEST(PedestrianFamily, RobotsEnterInTheMiddleOfTheSides) {
  const Scenario scenario = make_scenario(setup_with(quiet_scene()), kDefaultSeed, 0);
  ASSERT_EQ(scenario.robots.size(), 4U);
  const std::vector<Eigen::Vector2d> starts{{0, 5}, {12, 5}, {6, 0}, {6, 10}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(scenario.robots[i].start.position_world, starts[i]);
    EXPECT_EQ(scenario.robots[i].goal_world, starts[i ^ 1U]);
  }
  EXPECT_EQ(time_limit_of(scenario), 60.0);
  EXPECT_TRUE(problems_of(scenario).empty());
}

TEST(PedestrianFamily, PutsTheStartOffUntilNobodyIsNear) {
  std::vector<CrowdSample> samples = quiet_scene();
  // Past the left start at x = 0, y = 5 from 2 m below it: within 1 m from 1 s to 3 s, both ends included.
  add_walk(samples, 3, {0.0, 3.0}, {0.0, 1.0}, 0.0, 4.0);
  FamilySetup setup = setup_with(samples);
  EXPECT_EQ(make_scenario(setup, kDefaultSeed, 0).crowd.front().time, 0.0);
  setup.layout.window_spacing = 2.0;  // the next begins at 2 s, delayed to 3.2 s
  const Scenario scenario = make_scenario(setup, kDefaultSeed, 1);
  Crowd crowd{scenario.crowd, scenario.crowd_gap};
  bool met = false;
  crowd.visit(0.0, 0.1, [&](int id, const Eigen::Vector2d& from, const Eigen::Vector2d&) {
    if (id != 3) return;
    met = true;
    EXPECT_NEAR(from.y(), 6.2, 1e-9);
  });
  EXPECT_TRUE(met);
}

TEST(PedestrianFamily, SaysWhatARecordingCannotGive) {
  FamilySetup setup = setup_with(quiet_scene());
  const auto message = [&](int trial) {
    try {
      static_cast<void>(make_scenario(setup, kDefaultSeed, trial));
    } catch (const std::exception& error) {
      return std::string{error.what()};
    }
    return std::string{"nothing"};
  };
  EXPECT_EQ(message(8), "nothing");
  EXPECT_NE(message(9).find("has 9 windows of 60 s: trials 0 to 8"), std::string::npos) << message(9);
  std::vector<CrowdSample> samples = quiet_scene();
  add_walk(samples, 3, {6.0, 0.5}, Eigen::Vector2d::Zero(), 0.0, 100.0);
  setup = setup_with(samples);
  EXPECT_NE(message(0).find("within 1 m of a robot's start"), std::string::npos) << message(0);
  setup.crowd.reset();
  EXPECT_NE(message(0).find("needs a recorded crowd"), std::string::npos) << message(0);
}

TEST(PedestrianFamily, ARobotAloneCrossesAndLeaves) {
  FamilySetup setup = setup_with(quiet_scene());
  setup.layout.robots = 1;
  const Scenario scenario = make_scenario(setup, kDefaultSeed, 0);
  const TrialResult result = Simulation{scenario, AgentParameters{}}.run();
  EXPECT_EQ(result.outcome, TrialOutcome::success);
  EXPECT_TRUE(result.robots.front().in_time);
  EXPECT_LT(result.robots.front().travel_time_ratio, 1.1);
}

TEST(PedestrianFamily, LateIsNotInTime) {
  FamilySetup setup = setup_with(quiet_scene());
  setup.simulation.trial.latest_arrival = 0.8;  // nobody is faster than the obstacle-free optimum
  setup.layout.robots = 1;
  const TrialResult result = Simulation{make_scenario(setup, kDefaultSeed, 0), AgentParameters{}}.run();
  EXPECT_TRUE(result.robots.front().arrived);
  EXPECT_FALSE(result.robots.front().in_time);
  EXPECT_EQ(result.outcome, TrialOutcome::timeout);
}

/// A person walks along the path of two robots that detect nothing until it is too late; the contact is
/// counted once for each of them, and all go on.
TEST(PedestrianFamily, AContactDoesNotEndTheTrial) {
  std::vector<CrowdSample> samples = quiet_scene();
  add_walk(samples, 10, {9.0, 5.0}, {-1.0, 0.0}, 0.0, 8.8);
  FamilySetup setup = setup_with(samples);
  setup.simulation.sensing.range = 0.1;
  setup.simulation.radio.loss = 1.0;
  setup.layout.robots = 1;
  AgentParameters careless;
  careless.sight.unseen_speed = 0.0;  // it sees nobody, and expects nobody
  const TrialResult result = Simulation{make_scenario(setup, kDefaultSeed, 0), careless}.run();
  EXPECT_EQ(result.outcome, TrialOutcome::collision);
  ASSERT_EQ(result.contacts.size(), 1U);
  EXPECT_EQ(result.contacts.front().with, ContactWith::person);
  EXPECT_TRUE(result.robots.front().touched);
  EXPECT_TRUE(result.robots.front().arrived);
}

TEST(CrowdGenerator, MakesPlausiblePeople) {
  CrowdGeneratorParameters parameters;
  parameters.duration = 120.0;
  const CrowdRecording recording{generate_crowd(parameters, 5)};
  EXPECT_EQ(recording.begin(), 0.0);
  EXPECT_NEAR(recording.end(), 120.0, 1e-6);
  EXPECT_NEAR(recording.interval(), 0.4, 1e-9);
  const double instants = 301.0;
  const double at_once = static_cast<double>(recording.samples().size()) / instants;
  EXPECT_GT(at_once, 6.0);
  EXPECT_LT(at_once, 20.0);
  std::map<int, CrowdSample> before;
  std::vector<double> speeds;
  double nearest = 1e9;
  for (std::size_t i = 0; i < recording.samples().size(); ++i) {
    const CrowdSample& sample = recording.samples()[i];
    if (before.count(sample.id) > 0) {
      const CrowdSample& last = before.at(sample.id);
      EXPECT_NEAR(sample.time - last.time, 0.4, 1e-9);  // nobody vanishes in between
      speeds.push_back((sample.position_world - last.position_world).norm() / 0.4);
    }
    before[sample.id] = sample;
    for (std::size_t j = i + 1; j < recording.samples().size() && recording.samples()[j].time == sample.time;
         ++j)
      nearest = std::min(nearest, (sample.position_world - recording.samples()[j].position_world).norm());
  }
  std::sort(speeds.begin(), speeds.end());
  EXPECT_GT(speeds[speeds.size() / 2], 1.0);
  EXPECT_LT(speeds[speeds.size() / 2], 1.5);
  EXPECT_LT(speeds.back(), 2.6);
  EXPECT_GT(nearest, 0.4);  // bodies of 0.25 m may brush, not overlap
}

TEST(CrowdGenerator, RepeatsForASeedAndRefusesNonsense) {
  CrowdGeneratorParameters parameters;
  parameters.duration = 20.0;
  const std::vector<CrowdSample> once = generate_crowd(parameters, 1), again = generate_crowd(parameters, 1);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].position_world, again[i].position_world);
  EXPECT_NE(generate_crowd(parameters, 2).front().position_world, once.front().position_world);
  parameters.width = 0.0;
  EXPECT_THROW(static_cast<void>(generate_crowd(parameters, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace spf::sim
