// A campaign: two methods on the same trials, at growing noise of what moves, with intervals. Few trials,
// so wide intervals; `spf experiment` runs as many as you like, resumes them and writes a report.
#include <experiments/campaign_results.hpp>
#include <experiments/campaign_run.hpp>
#include <report/chart_svg.hpp>
#include <report/table.hpp>

#include <fstream>
#include <iostream>

namespace {

const char* const kCampaign = R"(
name: example
families: [t2]
methods: [space_time, orca]
noise: [walk]
levels: [0.5, 1]
tracking: [ideal]
first: 10000
trials: 3
)";

}  // namespace

int main() {
  const spf::CampaignPlan plan = spf::campaign_from_text(kCampaign, "example", ".");
  std::vector<spf::TrialRecord> records;
  spf::CampaignRequest request;
  request.trials = spf::trials_of(plan);
  request.finished = [&records](const spf::TrialRecord& record) { records.push_back(record); };
  spf::run_campaign(plan, request);

  spf::Table table{{{"method", spf::Alignment::left}, {"level"}, {"success"}, {"95 %"}, {"time ratio [1]"}}};
  spf::LineChart chart;
  chart.title = "Success under growing noise, 3 trials each, 95 % intervals";
  chart.x.label = "noise level [Sigma]";
  chart.y = {"success [1]", false, true, 0.0, 1.0};
  for (const std::string& method : plan.campaign.methods)
    chart.series.push_back({method, static_cast<int>(chart.series.size()), {}});
  for (const spf::ResultRow& row : spf::rows_of(spf::by_cell(records))) {
    table.add_row({row.method, spf::fixed(row.level, 1),
                   std::to_string(row.success) + " of " + std::to_string(row.trials),
                   spf::fixed(row.wilson_low, 2) + " to " + spf::fixed(row.wilson_high, 2),
                   spf::fixed(row.travel_time_ratio, 3)});
    for (spf::ChartSeries& series : chart.series)
      if (series.name == row.method)  // intervals side by side
        series.points.push_back(
            {row.level + 0.01 * series.style, row.success_rate, row.wilson_low, row.wilson_high});
  }
  std::cout << table.to_text();
  std::ofstream{"11_campaign.svg"} << spf::standalone(spf::line_chart(chart));
}
