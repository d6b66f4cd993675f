// The whole agent: computing time of a planning call (including its observations and messages) and of a
// control tick (including the poses since the last one) in simulated trials of the experiment protocol
// (docs/protocol.md). One iteration simulates the first ten seconds of one trial; the counters are over all
// calls of all robots: plan_us_*, control_us_*. `x_real_time` is simulated time over wall time on one core
// with all robots.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "sim/families.hpp"
#include "sim/simulation.hpp"

namespace {

constexpr int kFirstTrial = 10000;  // lower numbers are reserved for claims
constexpr double kSeconds = 10.0;   // [s] simulated of each trial

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A quantile of values; reorders them.
double quantile(std::vector<float>& values, double share) {
  if (values.empty()) return 0.0;
  const auto last = static_cast<double>(values.size() - 1);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * last);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

void report(benchmark::State& state, const char* name, std::vector<float>& values, double to_microseconds) {
  const std::string prefix = name;
  state.counters[prefix + "_median"] = to_microseconds * quantile(values, 0.5);
  state.counters[prefix + "_p99"] = to_microseconds * quantile(values, 0.99);
  state.counters[prefix + "_max"] = to_microseconds * quantile(values, 1.0);
}

/// Keeps the computing times of all calls.
struct Timings : spf::sim::TrialListener {
  void planned(double /*time*/, const spf::RobotAgent& /*agent*/, double ms) override {
    plan_ms.push_back(static_cast<float>(ms));
  }
  void controlled(double /*time*/, int /*robot*/, double us) override {
    control_us.push_back(static_cast<float>(us));
  }
  std::vector<float> plan_ms, control_us;
};

void agent_in(benchmark::State& state, spf::sim::Family family, int robots, spf::sim::TrackingMode tracking) {
  spf::sim::FamilySetup setup = spf::sim::family_setup(family);
  setup.layout.robots = robots;
  setup.simulation.noise.level = 1.0;
  setup.simulation.trial.tracking = tracking;
  setup.simulation.trial.time_limit = kSeconds;
  setup.simulation.trial.after_contact = spf::sim::AfterContact::wreck;  // every trial counts its ten seconds
  spf::sim::SimulationOptions options;
  options.clock = steady_seconds;
  Timings timings;
  options.listener = &timings;
  double simulated = 0.0;
  double wall = 0.0;
  int trial = kFirstTrial;
  for (auto _ : state) {
    const spf::sim::Scenario scenario = make_scenario(setup, spf::sim::kDefaultSeed, trial++);
    const spf::sim::TrialResult result =
        spf::sim::Simulation{scenario, spf::AgentParameters{}, options}.run();
    simulated += result.sim_seconds;
    wall += result.wall_seconds;
  }
  report(state, "plan_us", timings.plan_ms, 1e3);
  report(state, "control_us", timings.control_us, 1.0);
  state.counters["x_real_time"] = simulated / wall;
  state.counters["wall_ms_per_robot_second"] = 1e3 * wall / (simulated * robots);
}

constexpr auto kIdeal = spf::sim::TrackingMode::ideal;
constexpr auto kFull = spf::sim::TrackingMode::full;

BENCHMARK_CAPTURE(agent_in, t2_ideal, spf::sim::Family::t2, 5, kIdeal)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(agent_in, t2_full, spf::sim::Family::t2, 5, kFull)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(agent_in, t2_hard_full, spf::sim::Family::t2_hard, 12, kFull)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(agent_in, f7_full, spf::sim::Family::f7, 12, kFull)
    ->Iterations(2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(agent_in, field_50_full, spf::sim::Family::field, 50, kFull)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
