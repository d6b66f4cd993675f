#include "sim/trials.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace spf::sim {
namespace {

/// What the threads share.
struct Bench {
  std::atomic<int> next{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;  // guards everything below
  int done = 0;
  std::vector<std::optional<TrialResult>> results;
  std::vector<std::exception_ptr> failures;
};

TrialResult run_one(const TrialsRequest& request, int trial) {
  SimulationOptions options;
  options.record = request.record;
  options.clock = request.clock;
  TrialResult result = Simulation{request.scenario(trial), request.agent, options}.run();
  result.trial = trial;
  return result;
}

void work(const TrialsRequest& request, Bench& bench) {
  while (!bench.stop) {
    const int index = bench.next++;
    if (index >= request.count) return;
    const auto slot = static_cast<std::size_t>(index);
    try {
      TrialResult result = run_one(request, request.first + index);
      const std::lock_guard lock{bench.mutex};
      bench.results[slot] = std::move(result);
      ++bench.done;
      if (request.progress && !request.progress(*bench.results[slot], bench.done)) bench.stop = true;
    } catch (...) {
      const std::lock_guard lock{bench.mutex};
      bench.failures[slot] = std::current_exception();
      bench.stop = true;
    }
  }
}

}  // namespace

std::vector<TrialResult> run_trials(const TrialsRequest& request) {
  const int count = std::max(request.count, 0);
  Bench bench;
  bench.results.resize(static_cast<std::size_t>(count));
  bench.failures.resize(static_cast<std::size_t>(count));
  const int machine = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const int jobs = std::clamp(request.jobs > 0 ? request.jobs : machine, 1, std::max(count, 1));
  {
    std::vector<std::jthread> threads;
    for (int i = 1; i < jobs; ++i) threads.emplace_back([&] { work(request, bench); });
    work(request, bench);
  }  // joined here
  for (const std::exception_ptr& failure : bench.failures)
    if (failure) std::rethrow_exception(failure);
  std::vector<TrialResult> results;
  for (std::optional<TrialResult>& result : bench.results)
    if (result) results.push_back(std::move(*result));
  return results;
}

}  // namespace spf::sim
