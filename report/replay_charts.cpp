#include "report/replay_charts.hpp"

#include <algorithm>
#include <cmath>

#include "report/chart_svg.hpp"
#include "report/table.hpp"

namespace spf {
namespace {

constexpr double kFarthestGap = 6.0;  // [m] what is farther away is not drawn

LineChart chart_over_time(const ReplayData& data, const std::string& title, const std::string& unit) {
  const double last = static_cast<double>(std::max<std::size_t>(frame_count(data), 1) - 1);
  return {title, {"time [s]", false, false, 0.0, last * data.frame_interval}, {unit}, {}, {}, true};
}

template <class Value>
ChartSeries line_over_time(const ReplayData& data, const ReplayRobot& robot, int style, Value&& value) {
  ChartSeries series{"", style, {}, SeriesLook::line};
  for (std::size_t k = 0; k < robot.frames.size(); ++k)
    series.points.push_back({data.frame_interval * static_cast<double>(k), value(robot.frames[k])});
  return series;
}

std::string wheel_chart(const ReplayData& data, const ReplayRobot& robot, const std::string& name) {
  LineChart chart =
      chart_over_time(data, "Wheel speeds of " + name + " over time, with their limit", "rim speed [m/s]");
  for (std::size_t wheel = 0; wheel < robot.wheels; ++wheel)
    chart.series.push_back(
        line_over_time(data, robot, static_cast<int>(wheel),
                       [wheel](const ReplayRobotFrame& frame) { return frame.wheel_speeds[wheel]; }));
  const double limit = robot.wheel_speed_limit;
  if (std::isfinite(limit) && limit > 0.0)
    chart.limits = {{"limit \xC2\xB1" + fixed(limit, 2) + " m/s", limit}, {"", -limit}};
  return line_chart(chart);
}

std::string clearance_chart(const ReplayData& data, const ReplayRobot& robot, const std::string& name) {
  LineChart chart = chart_over_time(
      data, "Gaps of " + name + " to the nearest moving obstacle, robot and static obstacle over time",
      "gap [m]");
  const auto line = [&](int style, ReplayClearance ReplayRobotFrame::*which) {
    return line_over_time(data, robot, style, [which](const ReplayRobotFrame& frame) {
      const double gap = (frame.*which).distance;
      return gap <= kFarthestGap ? gap : kUnknown;
    });
  };
  chart.series = {line(1, &ReplayRobotFrame::to_obstacle), line(0, &ReplayRobotFrame::to_peer),
                  line(2, &ReplayRobotFrame::to_static)};
  chart.limits = {{"contact", 0.0}};
  return line_chart(chart);
}

std::string computing_chart(const ReplayData& data, const ReplayRobot& robot, const std::string& name) {
  LineChart chart =
      chart_over_time(data, "Computing times of " + name + ": each plan and each control tick, logarithmic",
                      "[ms], logarithmic");
  chart.y.logarithmic = true;
  const auto shown = [](double seconds) { return seconds > 0.0 ? 1e3 * seconds : kUnknown; };
  chart.series = {line_over_time(data, robot, 0,
                                 [&](const ReplayRobotFrame& frame) { return shown(frame.control_time); }),
                  {"plan", 1, {}, SeriesLook::dots},
                  {"failed plan", 6, {}, SeriesLook::crosses}};
  for (const ReplayPlan& plan : robot.plans)
    chart.series[plan.points.empty() ? 2 : 1].points.push_back({plan.time, shown(plan.planning_time)});
  return line_chart(chart);
}

}  // namespace

std::string replay_charts(const ReplayData& data) {
  std::string html;
  for (const ReplayRobot& robot : data.robots) {
    const std::string name = "robot " + std::to_string(robot.id);
    html += "<template>\n" + wheel_chart(data, robot, name) + clearance_chart(data, robot, name) +
            computing_chart(data, robot, name) + "</template>\n";
  }
  return html;
}

}  // namespace spf
