#include "sim/simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "sim/families.hpp"
#include "sim/geometry.hpp"
#include "sim/recording.hpp"

namespace spf::sim {
namespace {

/// One robot crosses 10 m of an empty field.
Scenario lone_robot(TrackingMode tracking) {
  Scenario scenario;
  scenario.border = square(Eigen::Vector2d::Zero(), 20.0);
  RobotTask task;
  task.start = {{-5.0, 1.0}, 0.0};
  task.goal_world = {5.0, 1.0};
  scenario.robots = {task};
  scenario.simulation.trial.tracking = tracking;
  return scenario;
}

TrialResult run(const Scenario& scenario, const SimulationOptions& options = {}) {
  return Simulation{scenario, AgentParameters{}, options}.run();
}

TrialResult run_recorded(const Scenario& scenario) {
  SimulationOptions options;
  options.record = true;
  return run(scenario, options);
}

class Tracking : public testing::TestWithParam<TrackingMode> {};

TEST_P(Tracking, ALoneRobotArrivesByTheStraightPath) {
  const TrialResult result = run(lone_robot(GetParam()));
  EXPECT_EQ(result.outcome, TrialOutcome::success);
  ASSERT_EQ(result.robots.size(), 1U);
  EXPECT_TRUE(result.robots[0].arrived);
  EXPECT_GT(result.robots[0].travel_time, 9.9);  // no robot covers 9.9 m faster at 1 m/s
  EXPECT_LT(result.robots[0].travel_time_ratio, 1.1);
  EXPECT_NEAR(result.robots[0].path_length_ratio, 0.99, 0.02);  // it has arrived 0.1 m before the goal
  EXPECT_EQ(result.last_arrival, result.robots[0].travel_time);
  EXPECT_TRUE(std::isinf(result.dynamic_distance));
}

INSTANTIATE_TEST_SUITE_P(Both, Tracking, testing::Values(TrackingMode::ideal, TrackingMode::full),
                         [](const auto& which) { return std::string{enum_name(which.param)}; });

TEST(Simulation, RecordsTheBeginningOfALongTrial) {
  const auto frames = [](double always, std::size_t records) {
    SimulationOptions options;
    options.record = true;
    options.record_limit = {always, records};
    return run(lone_robot(TrackingMode::full), options).recording;
  };
  const std::size_t all = frames(300.0, 0)->frames.size();
  EXPECT_GT(all, 100U);
  EXPECT_EQ(frames(0.0, all)->frames.size(), all);
  EXPECT_EQ(frames(3.0, 10)->frames.size(), 30U);
  const auto cut = frames(0.0, 50);
  EXPECT_EQ(cut->frames.size(), 50U);
  EXPECT_LT(cut->plans.back().time, 5.2);
  for (const RecordedEvent& event : cut->events) EXPECT_NE(event.kind, RecordedEvent::Kind::arrival);
}

TEST(Simulation, RepeatsBitForBitAndTakesNoNoticeOfClockOrRecording) {
  Scenario scenario = make_scenario(family_setup(Family::t2), kDefaultSeed, 10000);
  scenario.simulation.noise.level = 1.0;
  scenario.simulation.trial.time_limit = 5.0;
  const TrialResult first = run(scenario);
  const TrialResult again = run(scenario);
  SimulationOptions options;
  options.record = true;
  double seconds = 0.0;
  options.clock = [&seconds] { return seconds += 1e-6; };
  struct Timings : TrialListener {
    void planned(double /*time*/, const RobotAgent& /*agent*/, double plan_ms) override { plans += plan_ms; }
    void controlled(double /*time*/, int /*robot*/, double control_us) override { ticks += control_us; }
    double plans = 0.0;  // [ms]
    double ticks = 0.0;  // [us]
  } timings;
  options.listener = &timings;
  const TrialResult watched = run(scenario, options);
  EXPECT_NE(first.digest, 0U);
  EXPECT_EQ(first.digest, again.digest);
  EXPECT_EQ(first.digest, watched.digest);
  EXPECT_GT(timings.plans, 0.0);
  EXPECT_GT(timings.ticks, 0.0);
  EXPECT_GT(watched.wall_seconds, 0.0);

  scenario.seed += 1;
  EXPECT_NE(first.digest, run(scenario).digest);
}

/// Positions of the moving obstacles in every frame.
std::vector<Eigen::Vector2d> obstacle_path(const Scenario& scenario) {
  std::vector<Eigen::Vector2d> path;
  const TrialResult result = run_recorded(scenario);
  for (const RecordedFrame& frame : result.recording->frames)
    for (const RecordedDynamicObstacle& obstacle : frame.dynamic_obstacles)
      path.push_back(obstacle.state.position_world);
  return path;
}

TEST(Simulation, NoRobotSensorOrRadioMovesTheObstacles) {
  Scenario scenario = make_scenario(family_setup(Family::t2), kDefaultSeed, 10001);
  scenario.simulation.noise.level = 1.0;
  scenario.simulation.noise.model = NoiseModel::walk;
  scenario.simulation.trial.time_limit = 3.0;
  scenario.simulation.trial.after_contact = AfterContact::wreck;  // so that all run equally long
  const std::vector<Eigen::Vector2d> plain = obstacle_path(scenario);
  ASSERT_GT(plain.size(), 100U);
  scenario.simulation.pose_noise.position_sigma = 0.02;
  scenario.simulation.sensing.detections = DetectionQuality::noisy;
  scenario.simulation.sensing.map = MapKnowledge::sensed;
  scenario.simulation.sensing.range_sigma = 0.01;
  scenario.simulation.radio.loss = 0.2;
  scenario.simulation.trial.tracking = TrackingMode::ideal;
  scenario.robots.pop_back();
  EXPECT_EQ(plain, obstacle_path(scenario));
}

/// A disc faster than any robot comes from the side and meets the robot wherever it is: the whole width is
/// filled.
Scenario doomed_robot() {
  Scenario scenario = lone_robot(TrackingMode::full);
  scenario.border = Box{{-6.0, 0.0}, {8.0, 2.0}};
  ObstacleState disc;
  disc.position_world = {4.0, 1.0};
  disc.velocity_world = {-2.0, 0.0};
  disc.radius = 0.95;
  scenario.moving = {disc};
  return scenario;
}

TEST(Simulation, AContactEndsTheTrialAndIsRecorded) {
  const TrialResult result = run_recorded(doomed_robot());
  EXPECT_EQ(result.outcome, TrialOutcome::collision);
  ASSERT_EQ(result.contacts.size(), 1U);
  EXPECT_EQ(result.contacts[0].with, ContactWith::moving);
  EXPECT_NEAR(result.contacts[0].other_speed, 2.0, 0.05);
  EXPECT_NEAR(result.contacts[0].time, result.sim_seconds, 0.0051);  // within the last tick
  EXPECT_LE(result.dynamic_clearance, 0.0);
  EXPECT_FALSE(result.robots[0].arrived);
  const auto is_contact = [](const RecordedEvent& event) {
    return event.kind == RecordedEvent::Kind::contact;
  };
  EXPECT_EQ(std::count_if(result.recording->events.begin(), result.recording->events.end(), is_contact), 1);
}

TEST(Simulation, WrecksStayAndTheOthersGoOn) {
  Scenario scenario = doomed_robot();
  scenario.border = Box{{-6.0, 0.0}, {8.0, 30.0}};
  scenario.boxes = {{{-6.0, 2.0}, {8.0, 3.0}}};  // two lanes
  RobotTask safe;
  safe.start = {{-5.0, 20.0}, 0.0};
  safe.goal_world = {5.0, 20.0};
  scenario.robots.push_back(safe);
  scenario.simulation.trial.after_contact = AfterContact::wreck;
  const TrialResult result = run_recorded(scenario);
  EXPECT_EQ(result.outcome, TrialOutcome::collision);
  EXPECT_EQ(result.contacts.size(), 1U);
  EXPECT_TRUE(result.robots[0].wrecked);
  EXPECT_FALSE(result.robots[0].arrived);
  EXPECT_TRUE(result.robots[1].arrived);
  const double crash = result.contacts[0].time;
  std::vector<Eigen::Vector2d> positions;
  for (const RecordedFrame& frame : result.recording->frames)
    if (frame.time > crash + 0.01) positions.push_back(frame.robots[0].pose.position_world);
  ASSERT_GT(positions.size(), 10U);
  EXPECT_EQ(positions.front(), positions.back());
}

TEST(Simulation, TimeRunsOut) {
  Scenario scenario = lone_robot(TrackingMode::full);
  scenario.simulation.trial.time_limit = 2.0;
  const TrialResult result = run(scenario);
  EXPECT_EQ(result.outcome, TrialOutcome::timeout);
  EXPECT_NEAR(result.sim_seconds, 2.0, 1e-9);
  EXPECT_FALSE(result.robots[0].arrived);
}

TEST(Simulation, TheCallerCanStopIt) {
  SimulationOptions options;
  options.progress = [](double time) { return time < 0.95; };
  EXPECT_NEAR(run(lone_robot(TrackingMode::full), options).sim_seconds, 1.005, 1e-9);
}

TEST(Simulation, RefusesWhatCannotRunWithAllReasons) {
  Scenario scenario = lone_robot(TrackingMode::full);
  scenario.robots[0].goal_world = {30.0, 0.0};
  scenario.simulation.radio.delay = std::nan("");
  try {
    (void)run(scenario);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string{error.what()}.find("robots[0].goal"), std::string::npos) << error.what();
    EXPECT_NE(std::string{error.what()}.find("radio.delay"), std::string::npos) << error.what();
  }
}

/// From a position to the nearest surface that a beam can have hit at about that time: a square, a robot, the
/// disc.
double distance_to_anything(const Eigen::Vector2d& position, const Scenario& scenario, double time,
                            const Recording& recording) {
  double nearest = 1e9;
  for (const Box& box : scenario.boxes) nearest = std::min(nearest, distance_to_box(position, box));
  for (const RecordedFrame& frame : recording.frames) {
    if (std::abs(frame.time - time) > 0.45) continue;  // a few sweeps make a cell occupied
    for (const RecordedRobot& robot : frame.robots)
      nearest = std::min(nearest, (robot.pose.position_world - position).norm() - scenario.robot.radius);
    for (const RecordedDynamicObstacle& obstacle : frame.dynamic_obstacles)
      nearest = std::min(nearest, (obstacle.state.position_world - position).norm() - obstacle.state.radius);
  }
  return nearest;
}

TEST(Simulation, RecordsWhatAReplayShows) {
  Scenario scenario = make_scenario(family_setup(Family::f7), kDefaultSeed, 10000);
  scenario.simulation.trial.time_limit = 2.0;
  const TrialResult result = run_recorded(scenario);
  const Recording& recording = *result.recording;
  ASSERT_GE(recording.frames.size(), 20U);
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    EXPECT_NEAR(recording.frames[i].time, 0.1 * static_cast<double>(i), 1e-9);
    EXPECT_EQ(recording.frames[i].robots.size(), 12U);
    EXPECT_EQ(recording.frames[i].dynamic_obstacles.size(), 1U);
  }
  EXPECT_GE(recording.plans.size(), 12U);
  for (const RecordedPlan& plan : recording.plans) EXPECT_FALSE(plan.points.empty());
  ASSERT_FALSE(recording.cells.empty());
  for (const RecordedCells& update : recording.cells)
    for (const Eigen::Vector2i& cell : update.added) {
      const Eigen::Vector2d position =
          recording.map_frame.origin_world + recording.map_frame.resolution * cell.cast<double>();
      EXPECT_LT(distance_to_anything(position, scenario, update.time, recording), 0.4);
    }
  for (std::size_t i = 1; i < recording.events.size(); ++i)
    EXPECT_LE(recording.events[i - 1].time, recording.events[i].time + 0.1);
}

// The watchdogs of a robot bear the periods that are studied: it would brake between any two plans else.
TEST(Simulation, LetsSlowPlannersControllersAndPosesDrive) {
  for (const int slow : {0, 1, 2}) {
    Scenario scenario = lone_robot(TrackingMode::full);
    AgentParameters agent;
    if (slow == 0) agent.team.plan_period = 0.8;
    if (slow == 1) agent.tracker.control_period = 0.6;
    if (slow == 2) scenario.simulation.pose_noise.rate = 1.5;
    if (slow == 2) agent.team.stale_time = 1.6;
    const host::HostParameters host = host_parameters_for(scenario, agent);
    EXPECT_GE(host.plan_silence, 3.0 * agent.team.plan_period - 1e-12);
    EXPECT_GE(host.command_silence, 3.0 * agent.tracker.control_period);
    EXPECT_GE(host.clock_jump, 3.0 / scenario.simulation.pose_noise.rate);
    EXPECT_TRUE(contradictions(scenario, agent).empty());
    const TrialResult result = Simulation{scenario, agent}.run();
    EXPECT_EQ(result.outcome, TrialOutcome::success) << slow;
  }
}

/// Adds up what the planner of the default method returns, apart from whoever else does.
class Tally final : public Planner {
 public:
  struct Sums {
    int calls = 0;
    int failed = 0;
    std::int64_t optimiser_calls = 0;
    std::int64_t inner_iterations = 0;
  };
  Tally(const AgentParameters& agent, Sums* sums) : planner_{make_space_time_planner(agent)}, sums_{sums} {}
  void plan(const PlanRequest& request, PlanResult& result) override {
    planner_->plan(request, result);
    ++sums_->calls;
    sums_->failed += succeeded(result.outcome) ? 0 : 1;
    sums_->optimiser_calls += result.stats.optimiser_calls;
    sums_->inner_iterations += result.stats.inner_iterations;
  }

 private:
  std::unique_ptr<Planner> planner_;
  Sums* sums_;
};

// What is seen comes so late that the robot has to stop again and again, which is no plan of its planner.
TEST(Simulation, CountsTheCallsOfThePlannerAlone) {
  struct Stops : TrialListener {
    void planned(double /*time*/, const RobotAgent& agent, double /*plan_ms*/) override {
      ++plans;
      EXPECT_EQ(agent.stop_cause(), StopCause::none);
    }
    void stopped(double /*time*/, const RobotAgent& agent) override {
      ++stops;
      EXPECT_EQ(agent.stop_cause(), StopCause::no_obstacles);
    }
    int plans = 0;
    int stops = 0;
  } listener;
  Scenario scenario = lone_robot(TrackingMode::full);
  scenario.simulation.trial.computing_delay = 0.25;
  scenario.simulation.trial.time_limit = 5.0;
  Tally::Sums sums;
  AgentParameters agent;
  agent.make_planner = [&](const AgentParameters& parameters) {
    return std::make_unique<Tally>(parameters, &sums);
  };
  SimulationOptions options;
  options.listener = &listener;
  options.clock = [ticks = 0.0]() mutable { return ticks += 1e-6; };
  const TrialResult result = Simulation{scenario, agent, options}.run();
  EXPECT_GT(listener.stops, 10);
  EXPECT_GT(sums.calls, 10);
  EXPECT_EQ(listener.plans, sums.calls);
  EXPECT_EQ(result.robots[0].plans, sums.calls);
  EXPECT_EQ(result.robots[0].failed_plans, sums.failed);
  EXPECT_EQ(result.robots[0].optimiser_calls, sums.optimiser_calls);
  EXPECT_EQ(result.robots[0].inner_iterations, sums.inner_iterations);
}

// One that never re-anchors is not stopped at the default distance from its plan instead.
TEST(Simulation, LetsRobotsFallAsFarBehindAsTheyReanchor) {
  const Scenario scenario = lone_robot(TrackingMode::full);
  AgentParameters agent;
  const double usual = host_parameters_for(scenario, agent).largest_plan_error;
  agent.team.reanchor_distance = 0.5;
  EXPECT_EQ(host_parameters_for(scenario, agent).largest_plan_error, usual);
  agent.team.reanchor_distance = 10.0;
  EXPECT_GT(host_parameters_for(scenario, agent).largest_plan_error, 10.0);
  EXPECT_TRUE(contradictions(scenario, agent).empty());
}

TEST(Simulation, RefusesSettingsWithWhichNoRobotCouldSee) {
  Scenario scenario = lone_robot(TrackingMode::full);
  scenario.simulation.trial.computing_delay = 0.4;
  EXPECT_THROW((Simulation{scenario, AgentParameters{}}), std::invalid_argument);
}

TEST(Contradictions, OfAScenarioAreOfItsOwnKeys) {
  Scenario scenario = lone_robot(TrackingMode::full);
  SensingParameters& sensing = scenario.simulation.sensing;
  const auto keys = [&] {
    std::string all;
    for (const host::Contradiction& found : contradictions(scenario, AgentParameters{}))
      all += (all.empty() ? "" : " ") + found.key;
    return all;
  };
  EXPECT_EQ(keys(), "");
  sensing.map_grain.reach = 0.1;
  sensing.map_grain.resolution = 0.05;
  EXPECT_EQ(keys(), "sensing.map_max_distance");
  sensing.map_grain.reach = 2.0;
  sensing.map_grain.resolution = 0.4;
  EXPECT_EQ(keys(), "sensing.map_resolution");
  sensing.map_grain.resolution = 0.1;
  scenario.robots.push_back(scenario.robots.front());
  scenario.simulation.radio.loss = 1.0;
  EXPECT_EQ(keys(), "radio.loss");
  sensing.map = MapKnowledge::sensed;  // their scanners show them to each other
  EXPECT_EQ(keys(), "");
  sensing.peers_block_beams = false;
  EXPECT_EQ(keys(), "radio.loss");
  sensing.peer_detection_range = 3.0;
  EXPECT_EQ(keys(), "");
}

TEST(RobotMap, KnowsTheStaticShapesOnlyWhenTheyAreKnown) {
  Scenario scenario = lone_robot(TrackingMode::full);
  scenario.boxes = {square({2.0, 2.0}, 1.0)};
  scenario.discs = {{{-2.0, -2.0}, 0.5}};
  scenario.walls = {{{-3.0, 5.0}, {3.0, 6.0}}};
  const OccupancyMap known = robot_map(scenario);
  EXPECT_NEAR(known.distance({2.0, 3.2}), 0.7, 1e-5);
  EXPECT_NEAR(known.distance({-2.0, -3.0}), 0.5, 1e-2);
  EXPECT_NEAR(known.distance({0.0, 5.1}), distance_to_segment({0.0, 5.1}, scenario.walls[0]), 5e-3);
  EXPECT_NEAR(known.distance({9.5, 0.0}), 0.5, 1e-5);
  scenario.simulation.sensing.map = MapKnowledge::sensed;
  const OccupancyMap empty = robot_map(scenario);
  EXPECT_NEAR(empty.distance({2.0, 2.0}), empty.max_distance(), 1e-5);
  EXPECT_NEAR(empty.distance({9.5, 0.0}), 0.5, 1e-5);  // the border is always known
}

}  // namespace
}  // namespace spf::sim
