#include "experiments/campaign_pictures.hpp"

#include <algorithm>
#include <cmath>

#include "config/parameter_text.hpp"
#include "experiments/replay_export.hpp"
#include "experiments/trial_run.hpp"
#include "report/chart_svg.hpp"
#include "report/frame_svg.hpp"
#include "report/table.hpp"
#include "spf/robot/drive.hpp"

namespace spf {
namespace {

bool shows(const Campaign& campaign, CampaignFigure figure) {
  return std::find(campaign.figures.begin(), campaign.figures.end(), figure) != campaign.figures.end();
}

/// Speed of one wheel of every robot.
std::string wheel_chart(const sim::Recording& recording, const std::string& method, int wheel) {
  const sim::Scenario& scenario = recording.scenario;
  double limit = 0.0;  // of the fastest wheel
  for (std::size_t i = 0; i < scenario.robots.size(); ++i)
    limit = std::max(limit, scenario.robot_of(i).max_wheel_speed);
  LineChart chart;
  chart.x.label = "time [s]";
  chart.y.label = "speed [m/s]";
  chart.limits = {{"limit", limit}, {"", -limit}};
  double most = 0.0;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    if (wheel >= Drive{scenario.robot_of(i)}.rims()) continue;
    ChartSeries series{"robot " + std::to_string(i), static_cast<int>(i), {}, SeriesLook::line};
    for (const sim::RecordedFrame& frame : recording.frames) {
      const double speed = frame.robots[i].wheel_speeds[wheel];
      most = std::max(most, std::abs(speed));
      series.points.push_back({frame.time, speed});
    }
    chart.series.push_back(std::move(series));
  }
  chart.title = method + ", wheel " + std::to_string(wheel + 1) + ": at most " + fixed(most, 3) + " of " +
                fixed(limit, 3) + " m/s";
  return standalone(line_chart(chart));
}

std::string stem_of(const TrialKey& key) {
  const std::string file = cell_file_name(key);
  return file.substr(0, file.size() - std::string{".yaml"}.size());
}

/// 3.5 -> "003.5", so that names sort by time.
std::string padded(double time) {
  const std::string text = fixed(time, 1);
  return std::string(text.size() < 5 ? 5 - text.size() : 0, '0') + text;
}

}  // namespace

bool has_pictures(const Campaign& campaign) {
  return shows(campaign, CampaignFigure::wheels) || shows(campaign, CampaignFigure::scenes);
}

std::vector<StoredPicture> pictures_of(const Campaign& campaign, const Cell& cell, int trial) {
  std::vector<StoredPicture> pictures;
  if (!has_pictures(campaign)) return pictures;
  TrialOptions options;
  options.record = true;
  const FinishedTrial recorded = run_trial(cell, trial, options);
  const std::string name = stem_of(cell.key) + "_trial" + std::to_string(trial);
  const sim::Scenario& scenario = recorded.recording->scenario;
  int rims = 0;  // of the robot that has the most
  for (std::size_t i = 0; i < scenario.robots.size(); ++i)
    rims = std::max(rims, Drive{scenario.robot_of(i)}.rims());
  if (shows(campaign, CampaignFigure::wheels))
    for (int wheel = 0; wheel < rims; ++wheel)
      pictures.push_back({"wheels_" + name + "_wheel" + std::to_string(wheel + 1) + ".svg",
                          wheel_chart(*recorded.recording, cell.key.method, wheel)});
  if (!shows(campaign, CampaignFigure::scenes)) return pictures;
  const ReplayData data = replay_data(cell.config, recorded);
  for (const double time : campaign.times)
    pictures.push_back({"scene_" + name + "_" + padded(time) + "s.svg", render_frame_svg(data, time)});
  return pictures;
}

}  // namespace spf
