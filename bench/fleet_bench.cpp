// Cost of a robot in a fleet: complete trials in a field of equal density with 50 and with a thousand robots.
// The cost is processor time of all threads, so that other programs on the machine matter little; both sizes
// run in turn, and `ratio` is the larger fleet's cost over the smaller one's. `x_real_time` is simulated time
// over wall time.
#include <benchmark/benchmark.h>

#include <chrono>
#include <ctime>
#include <functional>

#include "parallel/worker_pool.hpp"
#include "sim/families.hpp"
#include "sim/simulation.hpp"

namespace {

constexpr int kFirstTrial = 10000;  // lower numbers are reserved for claims
constexpr int kSmall = 50;          // robots

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_seconds() {
  std::timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Sums over trials.
struct Cost {
  double processor = 0.0;                                                                // [s]
  double wall = 0.0;                                                                     // [s]
  double simulated = 0.0;                                                                // [s]
  double robot_seconds = 0.0;                                                            // [s]
  [[nodiscard]] double milliseconds() const { return 1e3 * processor / robot_seconds; }  // per robot-second
};

void add_trial(int robots, int trial, spf::WorkerPool& pool, Cost& cost) {
  spf::sim::FamilySetup setup = spf::sim::family_setup(spf::sim::Family::field);
  setup.layout.robots = robots;
  setup.simulation.trial.after_contact = spf::sim::AfterContact::wreck;
  spf::sim::SimulationOptions options;
  options.for_each = [&pool](std::size_t count, const std::function<void(std::size_t)>& job) {
    pool.for_each(count, job);
  };
  const spf::sim::Scenario scenario = make_scenario(setup, spf::sim::kDefaultSeed, trial);
  const double wall = steady_seconds();
  const double processor = processor_seconds();
  const spf::sim::TrialResult result = spf::sim::Simulation{scenario, spf::AgentParameters{}, options}.run();
  cost.processor += processor_seconds() - processor;
  cost.wall += steady_seconds() - wall;
  cost.simulated += result.sim_seconds;
  cost.robot_seconds += robots * result.sim_seconds;
}

void fleet(benchmark::State& state) {
  const int robots = static_cast<int>(state.range(0));
  spf::WorkerPool pool{static_cast<int>(state.range(1))};
  Cost small;
  Cost large;
  int trial = kFirstTrial;
  for (auto _ : state) {
    add_trial(kSmall, trial++, pool, small);
    add_trial(robots, trial, pool, large);
    add_trial(kSmall, trial++, pool, small);
  }
  state.counters["cpu_ms_per_robot_second"] = large.milliseconds();
  state.counters["of_50"] = small.milliseconds();
  state.counters["ratio"] = large.milliseconds() / small.milliseconds();
  state.counters["x_real_time"] = large.simulated / large.wall;
}

BENCHMARK(fleet)->Args({100, 2})->Args({1000, 1})->Args({1000, 2})->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
