#include "experiments/campaign_run.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include "experiments/failure_cause.hpp"
#include "experiments/study_run.hpp"
#include "sim/simulation.hpp"

namespace spf {
namespace {

/// Ends the trial under way from inside, when told to stop.
struct Stopped {};

/// Planning calls by what they did: most only find that the plan is still good.
void time_parts(const sim::Recording& recording, TrialRecord& record) {
  for (const sim::RecordedPlan& plan : recording.plans) {
    const PlanStats& stats = plan.stats;
    if (!(plan.plan_ms > 0.0) || stats.optimiser_calls + stats.manoeuvres == 0) continue;
    record.new_plan_time.add(1e-3 * plan.plan_ms);
    if (stats.optimiser_calls > 0) record.optimiser_time.add(1e-3 * plan.plan_ms / stats.optimiser_calls);
  }
}

/// Commands and true speeds; unknown where nothing drives wheels (ideal tracking).
double wheel_share(const sim::Recording& recording) {
  if (recording.scenario.simulation.trial.tracking == sim::TrackingMode::ideal) return kNotKnown;
  double most = 0.0;
  for (const sim::RecordedFrame& frame : recording.frames)
    for (const sim::RecordedRobot& robot : frame.robots)
      most = std::max(
          {most, robot.wheel_speeds.cwiseAbs().maxCoeff(), robot.wheel_commands.cwiseAbs().maxCoeff()});
  return most / recording.scenario.robot.max_wheel_speed;
}

TrialRecord run_trial(const Cell& cell, int trial, const CampaignRequest& request) {
  sim::SimulationOptions options;
  options.record = true;  // for the cause of a failure; it is dropped with the result
  options.clock = request.clock;
  if (request.clock && request.stop)
    options.clock = [&request] {
      if (request.stop()) throw Stopped{};
      return request.clock();
    };
  sim::TrialResult result =
      sim::Simulation{make_trial(cell.study, trial), agent_parameters(cell.study), options}.run();
  result.trial = trial;
  TrialRecord record = record_of(cell.study, result);
  record.key = cell.key;
  record.key.trial = trial;
  record.setup = cell.setup;
  record.cause = cause_of(result);
  record.wheel_share = wheel_share(*result.recording);
  time_parts(*result.recording, record);
  return record;
}

/// What the threads share.
struct Bench {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;  // guards what follows, and `finished`
  std::exception_ptr failure;
};

void work(const CampaignPlan& plan, const CampaignRequest& request, Bench& bench) {
  while (!bench.stop && !(request.stop && request.stop())) {
    const std::size_t index = bench.next++;
    if (index >= request.trials.size()) return;
    const CampaignTrial& item = request.trials[index];
    const Cell& cell = plan.cells[static_cast<std::size_t>(item.cell)];
    const auto fail = [&bench](std::exception_ptr failure) {
      const std::lock_guard lock{bench.mutex};
      if (!bench.failure) bench.failure = std::move(failure);
      bench.stop = true;
    };
    TrialRecord record;
    try {
      record = run_trial(cell, item.trial, request);
    } catch (const Stopped&) {
      return;
    } catch (const std::bad_alloc&) {
      return fail(std::current_exception());
    } catch (const std::exception& error) {
      return fail(std::make_exception_ptr(std::runtime_error{"trial " + std::to_string(item.trial) + " of " +
                                                             cell_text(cell.key) + ": " + error.what()}));
    }
    const std::lock_guard lock{bench.mutex};
    if (bench.stop) return;
    try {
      if (request.finished) request.finished(record);
    } catch (...) {
      bench.failure = std::current_exception();
      bench.stop = true;
    }
  }
}

}  // namespace

std::vector<CampaignTrial> trials_of(const CampaignPlan& plan, Shard shard) {
  std::vector<CampaignTrial> trials;
  const auto cells = static_cast<std::int64_t>(plan.cells.size());
  // Few shards: every cell in turn over all of them. More shards than trials: one after the other, so that
  // all are equally long.
  const bool few = shard.count <= plan.campaign.trials;
  for (std::int64_t k = 0; k < plan.campaign.trials; ++k)
    for (std::int64_t cell = 0; cell < cells; ++cell)
      if ((few ? k + cell : k * cells + cell) % shard.count == shard.index - 1)
        trials.push_back({static_cast<int>(cell), plan.campaign.first + static_cast<int>(k)});
  return trials;
}

void run_campaign(const CampaignPlan& plan, const CampaignRequest& request) {
  Bench bench;
  const std::size_t most = std::max<std::size_t>(request.trials.size(), 1);
  const std::size_t jobs =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::max(request.jobs, 1)), 1, most);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 1; i < jobs; ++i) threads.emplace_back([&] { work(plan, request, bench); });
    work(plan, request, bench);
  }  // joined here
  if (bench.failure) std::rethrow_exception(bench.failure);
}

int cell_index(const CampaignPlan& plan, const TrialRecord& record) {
  for (std::size_t i = 0; i < plan.cells.size(); ++i)
    if (same_cell(plan.cells[i].key, record.key) && plan.cells[i].setup == record.setup)
      return static_cast<int>(i);
  return -1;
}

void sort_records(const CampaignPlan& plan, std::vector<TrialRecord>& records) {
  std::vector<std::pair<int, std::size_t>> order;
  for (std::size_t i = 0; i < records.size(); ++i) order.emplace_back(cell_index(plan, records[i]), i);
  std::sort(order.begin(), order.end(), [&records](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : records[a.second].key.trial < records[b.second].key.trial;
  });
  std::vector<TrialRecord> sorted;
  sorted.reserve(records.size());
  for (const auto& [cell, index] : order) sorted.push_back(std::move(records[index]));
  records = std::move(sorted);
}

}  // namespace spf
