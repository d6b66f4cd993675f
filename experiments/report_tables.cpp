#include "experiments/report_tables.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "config/parameter_text.hpp"
#include "experiments/failure_cause.hpp"
#include "experiments/paper_figures.hpp"
#include "experiments/statistics.hpp"
#include "report/table.hpp"

namespace spf {
namespace {

PageCell text(std::string words) {
  return {std::move(words)};
}
PageCell row_header(std::string words, std::string sub = {}) {
  PageCell cell{std::move(words), std::move(sub)};
  cell.header = true;
  return cell;
}

std::string percent(int count, int all) {
  return all == 0 ? "-" : fixed(100.0 * count / all, 1);
}

std::string triple(const std::vector<double>& values, int decimals) {
  return fixed(mean(values), decimals) + " | " + fixed(minimum(values), decimals) + " | " +
         fixed(standard_deviation(values), decimals);
}
std::string paper_triple(const PaperTriple& paper) {
  return "paper " + fixed(paper.mean, 2) + " | " + fixed(paper.minimum, 2) + " | " +
         fixed(paper.deviation, 2);
}

/// Successful trials of a cell: path lengths and times per robot, dynamic distance per trial.
struct Successes {
  std::vector<double> lengths, times, distances;

  explicit Successes(const CellTrials& trials) {
    for (const TrialRecord& trial : trials) {
      if (!trial.succeeded()) continue;
      if (std::isfinite(trial.dynamic_distance)) distances.push_back(trial.dynamic_distance);
      for (const RobotRecord& robot : trial.robots) {
        lengths.push_back(robot.path_length);
        times.push_back(robot.travel_time);
      }
    }
  }
};

PageCell success_cell(const ResultRow& row, const std::string& paper, bool best) {
  PageCell cell{fixed(100.0 * row.success_rate, 1), "[" + fixed(100.0 * row.wilson_low, 1) + ", " +
                                                        fixed(100.0 * row.wilson_high, 1) + "]" + paper};
  cell.strong = best;
  return cell;
}

/// Cells grouped by `name`, in the order of their first occurrence.
using Group = std::vector<const CellTrials*>;
std::vector<Group> grouped(const CampaignParts& parts,
                           const std::function<std::string(const TrialKey&)>& name) {
  std::vector<std::string> names;
  std::vector<Group> groups;
  for (const CellTrials& cell : parts.cells) {
    const std::string called = name(cell.front().key);
    const auto index =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), called) - names.begin());
    if (index == names.size()) {
      names.push_back(called);
      groups.emplace_back();
    }
    groups[index].push_back(&cell);
  }
  return groups;
}

double best_rate(const Group& group, const std::function<bool(const TrialKey&)>& counts) {
  double best = 0.0;
  for (const CellTrials* cell : group)
    if (counts(cell->front().key)) best = std::max(best, result_row(*cell).success_rate);
  return best;
}

std::vector<PageCell> table2_row(const CellTrials& cell, double best) {
  const ResultRow row = result_row(cell);
  const PaperTable2Row* paper = row.family == "t2" ? paper_table2(row.level, row.method) : nullptr;
  const Successes good{cell};
  const auto beside = [paper](const std::string& value) { return paper == nullptr ? "" : value; };
  return {
      row_header(to_text(row.level) + " Sigma"),
      text(row.method),
      text(std::to_string(row.trials)),
      success_cell(row, beside(paper ? ", paper " + fixed(paper->success, 0) : ""), row.success_rate == best),
      {percent(row.timeout, row.trials), beside(paper ? "paper " + fixed(paper->timeout, 0) : "")},
      text(percent(row.collision, row.trials)),
      {triple(good.distances, 2), beside(paper ? paper_triple(paper->distance) : "")},
      {triple(good.lengths, 2), beside(paper ? paper_triple(paper->path) : "")},
      {triple(good.times, 2), beside(paper ? paper_triple(paper->time) : "")},
      text(fixed(row.travel_time_ratio, 3)),
      {fixed(row.optimiser_calls_per_robot, 2), beside(paper ? "paper " + fixed(paper->iterations, 2) : "")}};
}

std::vector<PageCell> table3_row(const CellTrials& cell, double best) {
  const ResultRow row = result_row(cell);
  const PaperTable3Row* paper = paper_table3(row.condition, row.method);
  return {row_header(row.condition),
          text(row.method),
          text(std::to_string(row.trials)),
          success_cell(row, paper ? ", paper " + fixed(paper->success, 0) : "", row.success_rate == best),
          {percent(row.timeout, row.trials), paper ? "paper " + fixed(paper->timeout, 0) : ""},
          text(percent(row.collision, row.trials)),
          {fixed(row.travel_time_mean, 2), paper ? "paper " + fixed(paper->time, 2) : ""},
          text(fixed(row.travel_time_ratio, 3)),
          text(fixed(row.dynamic_clearance_min, 3))};
}

std::string p_text(double p) {
  return p < 1e-4 ? "< 0.0001" : fixed(p, 4);
}

std::string microseconds(double seconds) {
  return fixed(1e6 * seconds, 1);
}
std::string times_of(const DurationHistogram& histogram) {
  if (histogram.count() == 0) return "-";
  return microseconds(histogram.percentile(0.5)) + " | " + microseconds(histogram.percentile(0.99)) + " | " +
         microseconds(histogram.maximum());
}

}  // namespace

std::string scene_text(const TrialKey& key) {
  return (key.condition.empty() ? "" : key.condition + ", ") + key.noise + " noise at " + to_text(key.level) +
         " Sigma, " + key.tracking + " tracking";
}

std::vector<std::string> method_names(const CampaignParts& parts) {
  std::vector<std::string> names;
  const auto add = [&names](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const CellTrials& cell : parts.cells) add(cell.front().key.method);
  return names;
}

PageTable rows_table(const CampaignParts& parts) {
  PageTable table{"All rows",
                  {"family", "condition", "noise", "Sigma", "tracking", "method", "n", "SR %", "OR %", "CR %",
                   "travel [s]", "time ratio", "path [m]", "path ratio", "least clearance [m]",
                   "optimiser calls", "planning call, median | p99 [us]", "control tick, median | p99 [us]"},
                  {}};
  for (const CellTrials& cell : parts.cells) {
    const ResultRow row = result_row(cell);
    table.rows.push_back({row_header(row.family), text(row.condition.empty() ? "-" : row.condition),
                          text(row.noise), text(to_text(row.level)), text(row.tracking), text(row.method),
                          text(std::to_string(row.trials)), success_cell(row, "", false),
                          text(percent(row.timeout, row.trials)), text(percent(row.collision, row.trials)),
                          text(fixed(row.travel_time_mean, 2)), text(fixed(row.travel_time_ratio, 3)),
                          text(fixed(row.path_length_mean, 2)), text(fixed(row.path_length_ratio, 3)),
                          text(fixed(row.dynamic_clearance_min, 3)),
                          text(fixed(row.optimiser_calls_per_robot, 2)),
                          text(fixed(1e3 * row.plan_ms_median, 1) + " | " + fixed(1e3 * row.plan_ms_p99, 1)),
                          text(fixed(row.control_us_median, 1) + " | " + fixed(row.control_us_p99, 1))});
  }
  return table;
}

PageTable crossings_table(const CampaignParts& parts) {
  PageTable table{"Crossings among recorded people",
                  {"scene", "method", "crossings", "ok %", "contacts while moving", "a robot-minute",
                   "hits while standing", "robot-minutes"},
                  {}};
  for (const CellTrials& cell : parts.cells) {
    const ResultRow row = result_row(cell);
    if (row.crossings == 0) continue;
    const Interval interval = wilson_interval(row.crossings_ok, row.crossings);
    const TrialKey& key = cell.front().key;
    table.rows.push_back(
        {row_header(key.family + ", " + scene_text(key)),
         text(row.method),
         text(std::to_string(row.crossings)),
         {percent(row.crossings_ok, row.crossings),
          "[" + fixed(100.0 * interval.low, 1) + ", " + fixed(100.0 * interval.high, 1) + "]"},
         text(std::to_string(row.contacts_moving)),
         text(fixed(row.contacts_moving / std::max(row.robot_minutes, 1e-9), 3)),
         text(std::to_string(row.hits_while_standing)),
         text(fixed(row.robot_minutes, 1))});
  }
  return table;
}

std::vector<PageTable> table2_tables(const CampaignParts& parts) {
  std::vector<PageTable> tables;
  for (const Group& group : grouped(parts, [](const TrialKey& key) {
         return key.noise + " noise, " + key.tracking + " tracking" +
                (key.condition.empty() ? "" : ", " + key.condition);
       })) {
    const TrialKey& first = group.front()->front().key;
    PageTable table{first.noise + " noise, " + first.tracking + " tracking" +
                        (first.condition.empty() ? "" : ", " + first.condition),
                    {"level", "method", "n", "SR %", "OR %", "CR %", "dynamic distance [m]",
                     "path length [m]", "travel time [s]", "time ratio", "optimiser calls"},
                    {}};
    for (const CellTrials* cell : group) {
      const double level = cell->front().key.level;
      table.rows.push_back(
          table2_row(*cell, best_rate(group, [level](const TrialKey& key) { return key.level == level; })));
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

std::vector<PageTable> table3_tables(const CampaignParts& parts) {
  std::vector<PageTable> tables;
  const auto name = [](const TrialKey& key) {
    return "moving obstacles: " + key.noise + " noise at " + to_text(key.level) + " Sigma; " + key.tracking +
           " tracking";
  };
  for (const Group& group : grouped(parts, name)) {
    PageTable table{name(group.front()->front().key),
                    {"own pose", "method", "n", "SR %", "OR %", "CR %", "travel time [s]", "time ratio",
                     "least clearance [m]"},
                    {}};
    for (const CellTrials* cell : group) {
      const std::string condition = cell->front().key.condition;
      table.rows.push_back(table3_row(
          *cell, best_rate(group, [&condition](const TrialKey& key) { return key.condition == condition; })));
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

std::vector<PageTable> paired_tables(const CampaignParts& parts) {
  std::vector<PageTable> tables;
  std::string scene;
  std::vector<PairedRow> pairs = pairs_of(parts.cells);
  const auto key_of_pair = [](const PairedRow& pair) {
    return TrialKey{pair.family, "", pair.noise, pair.level, pair.tracking, pair.seed, 0, pair.condition};
  };
  std::stable_sort(pairs.begin(), pairs.end(), [&](const PairedRow& a, const PairedRow& b) {
    return scene_text(key_of_pair(a)) < scene_text(key_of_pair(b));
  });
  for (const PairedRow& pair : pairs) {
    const std::string here = pair.family + ": " + scene_text(key_of_pair(pair));
    if (here != scene || tables.empty())
      tables.push_back(
          {here,
           {"A", "B", "n", "both", "only A", "only B", "neither", "difference B - A [points]", "p"},
           {}});
    scene = here;
    PageCell p{p_text(pair.mcnemar_p)};
    p.strong = pair.mcnemar_p < 0.05;
    tables.back().rows.push_back({row_header(pair.method_a), text(pair.method_b),
                                  text(std::to_string(pair.trials)), text(std::to_string(pair.both)),
                                  text(std::to_string(pair.only_a)), text(std::to_string(pair.only_b)),
                                  text(std::to_string(pair.neither)),
                                  text(fixed(100.0 * (pair.only_b - pair.only_a) / pair.trials, 1)), p});
  }
  return tables;
}

PageTable failure_table(const CampaignParts& parts) {
  const std::vector<std::string> methods = method_names(parts);
  std::map<std::string, std::map<std::string, int>> counts;
  std::map<std::string, int> totals, failed, trials;
  for (const CellTrials& cell : parts.cells)
    for (const TrialRecord& record : cell) {
      ++trials[record.key.method];
      if (record.succeeded()) continue;
      const std::string kind = failure_kind(record);
      ++counts[kind][record.key.method];
      ++totals[kind];
      ++failed[record.key.method];
    }
  std::vector<std::pair<std::string, int>> kinds{totals.begin(), totals.end()};
  std::stable_sort(kinds.begin(), kinds.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  PageTable table{"Kinds of failure, by method", {"what happened", "all"}, {}};
  for (const std::string& method : methods) table.headers.push_back(method);
  for (const auto& [kind, total] : kinds) {
    std::vector<PageCell> row{row_header(kind), text(std::to_string(total))};
    for (const std::string& method : methods) row.push_back(text(std::to_string(counts[kind][method])));
    table.rows.push_back(std::move(row));
  }
  int all_failed = 0, all_trials = 0;
  std::vector<PageCell> last;
  for (const std::string& method : methods) {
    all_failed += failed[method];
    all_trials += trials[method];
    last.push_back(text(std::to_string(failed[method]) + " of " + std::to_string(trials[method])));
  }
  last.insert(last.begin(),
              {row_header("failed"), text(std::to_string(all_failed) + " of " + std::to_string(all_trials))});
  table.rows.push_back(std::move(last));
  return table;
}

PageTable runtime_table(const CampaignParts& parts) {
  PageTable table{"Median | p99 | largest [us]",
                  {"method", "condition", "planning calls", "every planning call", "a new plan",
                   "one optimiser call", "control tick"},
                  {}};
  for (const Group& group :
       grouped(parts, [](const TrialKey& key) { return key.method + "\n" + key.condition; })) {
    DurationHistogram calls, plans, optimiser, control;
    for (const CellTrials* cell : group)
      for (const TrialRecord& trial : *cell) {
        calls.merge(trial.plan_time);
        plans.merge(trial.new_plan_time);
        optimiser.merge(trial.optimiser_time);
        control.merge(trial.control_time);
      }
    const TrialKey& key = group.front()->front().key;
    table.rows.push_back({row_header(key.method), text(key.condition.empty() ? "-" : key.condition),
                          text(std::to_string(calls.count())), text(times_of(calls)), text(times_of(plans)),
                          text(times_of(optimiser)), text(times_of(control))});
  }
  return table;
}

PageTable wheel_table(const CampaignParts& parts) {
  PageTable table{"Wheel speeds and commands against the drive limit",
                  {"method", "scene", "trials", "within the limit", "largest, of the limit"},
                  {}};
  for (const CellTrials& cell : parts.cells) {
    int known = 0, within = 0;
    double most = 0.0;
    for (const TrialRecord& trial : cell) {
      if (!std::isfinite(trial.wheel_share)) continue;
      ++known;
      within += trial.wheel_share <= 1.0 + 1e-9 ? 1 : 0;  // rounding of the ratio
      most = std::max(most, trial.wheel_share);
    }
    if (known == 0) continue;
    const TrialKey& key = cell.front().key;
    table.rows.push_back({row_header(key.method), text(key.family + ", " + scene_text(key)),
                          text(std::to_string(known)), text(std::to_string(within)), text(fixed(most, 4))});
  }
  return table;
}

}  // namespace spf
