// A fleet of a thousand: what a robot costs in memory, and that robots which think at the same time go the
// same ways.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "parallel/worker_pool.hpp"
#include "sim/families.hpp"
#include "sim/simulation.hpp"
#include "spf/testing/allocation_guard.hpp"

namespace spf::sim {
namespace {

Scenario fleet(Family family, int robots, double seconds) {
  FamilySetup setup = family_setup(family);
  if (robots > 0) setup.layout.robots = robots;
  setup.simulation.noise.level = 1.0;
  setup.simulation.trial.time_limit = seconds;
  return make_scenario(setup, kDefaultSeed, 10000);
}

TrialResult run_on(int threads, const Scenario& scenario) {
  SimulationOptions options;
  WorkerPool pool{threads};
  options.for_each = [&pool](std::size_t count, const std::function<void(std::size_t)>& job) {
    pool.for_each(count, job);
  };
  return Simulation{scenario, AgentParameters{}, options}.run();
}

/// Of the field, of sensed maps with their scans, and of small robots.
class FleetThreads : public testing::TestWithParam<Family> {};

TEST_P(FleetThreads, GoesTheSameWaysOnAnyNumberOfThreads) {
  const Scenario scenario = fleet(GetParam(), 0, 3.0);
  const TrialResult alone = Simulation{scenario, AgentParameters{}, {}}.run();
  for (const int threads : {1, 2, 3}) {
    const TrialResult together = run_on(threads, scenario);
    EXPECT_EQ(together.digest, alone.digest) << threads << " threads";
    EXPECT_EQ(together.messages, alone.messages) << threads << " threads";
    EXPECT_EQ(together.sim_seconds, alone.sim_seconds) << threads << " threads";
    ASSERT_EQ(together.robots.size(), alone.robots.size());
    for (std::size_t i = 0; i < alone.robots.size(); ++i) {
      EXPECT_EQ(together.robots[i].plans, alone.robots[i].plans) << "robot " << i;
      EXPECT_EQ(together.robots[i].stood, alone.robots[i].stood) << "robot " << i;
    }
  }
  EXPECT_GT(alone.messages, alone.robots.size());
}

INSTANTIATE_TEST_SUITE_P(Families, FleetThreads, testing::Values(Family::field, Family::f7, Family::p8),
                         [](const auto& which) { return std::string{enum_name(which.param)}; });

/// Everything but the map that all share: agents, world, radio, and what is measured meanwhile. By the second
/// second every robot has heard all that it will hear at a time.
TEST(FleetSlow, TakesAtMost300KilobytesARobotBesideTheMap) {
  constexpr int kRobots = 1000;
  const Scenario scenario = fleet(Family::field, kRobots, 2.0);
  const AllocationGuard of_map;
  long map_bytes = 0;
  {
    const OccupancyMap map = robot_map(scenario);
    map_bytes = of_map.bytes();
  }
  EXPECT_GT(map_bytes, 4'000'000);  // it is worth sharing
  const AllocationGuard of_fleet;
  long most = 0;
  SimulationOptions options;
  options.progress = [&](double) {
    most = std::max(most, of_fleet.bytes());
    return true;
  };
  const TrialResult result = Simulation{scenario, AgentParameters{}, options}.run();
  EXPECT_GT(result.messages, 2U * kRobots);
  const double each = static_cast<double>(most - map_bytes) / kRobots;
  RecordProperty("kilobytes_a_robot", std::to_string(1e-3 * each));
  EXPECT_LE(each, 300e3);
  EXPECT_GT(each, 50e3);  // were nothing counted, it would be less
}

}  // namespace
}  // namespace spf::sim
