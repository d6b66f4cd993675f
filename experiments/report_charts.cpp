#include "experiments/report_charts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "config/parameter_text.hpp"
#include "experiments/report_tables.hpp"
#include "experiments/statistics.hpp"
#include "report/chart_svg.hpp"
#include "report/table.hpp"

namespace spf {
namespace {

int style_of(const std::vector<std::string>& methods, const std::string& method) {
  return static_cast<int>(std::find(methods.begin(), methods.end(), method) - methods.begin());
}

std::string panel_of(const TrialKey& key) {
  return (key.condition.empty() ? "" : key.condition + ", ") + key.noise + " noise, " + key.tracking +
         " tracking";
}

/// Counts in bins that are wide enough to be visible: 12 a decade.
void fill_histogram(const DurationHistogram& histogram, ChartRow& row) {
  constexpr double kBinsPerDecade = 12.0;
  std::map<int, double> bins;
  for (const auto& [bucket, count] : histogram.buckets()) {
    const DurationHistogram one = DurationHistogram::from_buckets({{bucket, 1}}, 0.0, 1e9);
    const double microseconds = 1e6 * one.percentile(0.5);
    bins[static_cast<int>(std::floor(kBinsPerDecade * std::log10(microseconds)))] +=
        static_cast<double>(count) / static_cast<double>(histogram.count());
  }
  if (bins.empty()) return;
  for (int bin = bins.begin()->first; bin <= bins.rbegin()->first; ++bin) {
    row.edges.push_back(std::pow(10.0, bin / kBinsPerDecade));
    row.shares.push_back(bins.count(bin) > 0 ? bins[bin] : 0.0);
  }
  row.edges.push_back(std::pow(10.0, (bins.rbegin()->first + 1) / kBinsPerDecade));
}

using PickHistogram = std::function<const DurationHistogram&(const TrialRecord&)>;

const DurationHistogram& planning_of(const TrialRecord& record) {
  return record.new_plan_time.count() > 0 ? record.new_plan_time : record.plan_time;
}
const DurationHistogram& optimiser_of(const TrialRecord& record) {
  return record.optimiser_time;
}
const DurationHistogram& control_of(const TrialRecord& record) {
  return record.control_time;
}

std::string time_chart(const CampaignParts& parts, const std::string& title, const PickHistogram& pick) {
  const std::vector<std::string> methods = method_names(parts);
  RowChart chart{title, RowKind::histogram, {"time [us]", true}, {}};
  for (const std::string& method : methods) {
    DurationHistogram merged;
    for (const CellTrials& cell : parts.cells)
      for (const TrialRecord& record : cell)
        if (record.key.method == method) merged.merge(pick(record));
    if (merged.count() == 0) continue;
    ChartRow row;
    row.label = method;
    row.note =
        "median " + fixed(1e6 * merged.percentile(0.5), 1) + " us, n = " + std::to_string(merged.count());
    row.style = style_of(methods, method);
    fill_histogram(merged, row);
    chart.rows.push_back(std::move(row));
  }
  return chart.rows.empty() ? "" : row_chart(chart);
}

std::string part_chart(const CampaignParts& parts, const std::string& title, const PickHistogram& pick) {
  const std::vector<std::string> methods = method_names(parts);
  RowChart chart{title, RowKind::bar, {"median, whisker to p99 [us]", true}, {}};
  std::vector<std::pair<std::string, std::string>> rows;  // method, condition
  for (const std::string& method : methods)
    for (const CellTrials& cell : parts.cells) {
      const TrialKey& key = cell.front().key;
      const std::pair<std::string, std::string> row{key.method, key.condition};
      if (key.method == method && std::find(rows.begin(), rows.end(), row) == rows.end()) rows.push_back(row);
    }
  for (const auto& [method, condition] : rows) {
    DurationHistogram merged;
    for (const CellTrials& cell : parts.cells)
      for (const TrialRecord& record : cell)
        if (record.key.method == method && record.key.condition == condition) merged.merge(pick(record));
    if (merged.count() == 0) continue;
    ChartRow row;
    row.label = method;
    row.note = condition;
    row.style = style_of(methods, method);
    row.bar = 1e6 * merged.percentile(0.5);
    row.whisker = 1e6 * merged.percentile(0.99);
    chart.rows.push_back(std::move(row));
  }
  return chart.rows.empty() ? "" : row_chart(chart);
}

void add_unless_empty(std::vector<std::string>& charts, std::string chart) {
  if (!chart.empty()) charts.push_back(std::move(chart));
}

}  // namespace

std::vector<std::string> success_charts(const CampaignParts& parts) {
  const std::vector<std::string> methods = method_names(parts);
  std::vector<std::string> panels;
  for (const CellTrials& cell : parts.cells) {
    const std::string panel = panel_of(cell.front().key);
    if (std::find(panels.begin(), panels.end(), panel) == panels.end()) panels.push_back(panel);
  }
  std::vector<std::string> charts;
  for (const std::string& panel : panels) {
    LineChart chart{panel, {"noise level [Sigma]"}, {"success [%]", false, false, 0.0, 100.0}, {}, {}};
    std::size_t most = 0;
    for (const std::string& method : methods) {
      ChartSeries series{method, style_of(methods, method), {}};
      for (const CellTrials& cell : parts.cells) {
        const TrialKey& key = cell.front().key;
        if (panel_of(key) != panel || key.method != method) continue;
        const ResultRow row = result_row(cell);
        series.points.push_back(
            {key.level, 100.0 * row.success_rate, 100.0 * row.wilson_low, 100.0 * row.wilson_high});
      }
      most = std::max(most, series.points.size());
      std::sort(series.points.begin(), series.points.end(),
                [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; });
      if (!series.points.empty()) chart.series.push_back(std::move(series));
    }
    if (most > 1) charts.push_back(line_chart(chart));
  }
  return charts;
}

std::vector<std::string> travel_charts(const CampaignParts& parts) {
  const std::vector<std::string> methods = method_names(parts);
  std::vector<std::pair<std::string, RowChart>> charts;
  for (const CellTrials& cell : parts.cells) {
    const std::string scene = scene_text(cell.front().key);
    std::size_t index = 0;
    while (index < charts.size() && charts[index].first != scene) ++index;
    if (index == charts.size())
      charts.push_back({scene, {scene, RowKind::box, {"travel time of a robot [s]"}, {}}});
    RowChart& chart = charts[index].second;
    std::vector<double> times;
    for (const TrialRecord& trial : cell)
      if (trial.succeeded())
        for (const RobotRecord& robot : trial.robots) times.push_back(robot.travel_time);
    ChartRow row;
    row.label = cell.front().key.method;
    row.note = times.empty() ? "no success" : "n = " + std::to_string(times.size());
    row.style = style_of(methods, row.label);
    if (!times.empty())
      for (const double share : {0.05, 0.25, 0.5, 0.75, 0.95})
        row.quantiles.push_back(percentile(times, share));
    chart.rows.push_back(std::move(row));
  }
  std::vector<std::string> drawn;
  for (const auto& [scene, chart] : charts) drawn.push_back(row_chart(chart));
  return drawn;
}

std::vector<std::string> time_charts(const CampaignParts& parts) {
  std::vector<std::string> charts;
  add_unless_empty(charts, time_chart(parts, "Planning calls that look for a new plan", planning_of));
  add_unless_empty(charts, time_chart(parts, "Control ticks", control_of));
  return charts;
}

std::vector<std::string> part_charts(const CampaignParts& parts) {
  std::vector<std::string> charts;
  add_unless_empty(charts, part_chart(parts, "Planner: a new plan", planning_of));
  add_unless_empty(charts, part_chart(parts, "Planner: one optimiser call", optimiser_of));
  add_unless_empty(charts, part_chart(parts, "Controller: one tick", control_of));
  return charts;
}

}  // namespace spf
