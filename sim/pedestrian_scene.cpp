#include "sim/pedestrian_scene.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "sim/crowd.hpp"
#include "sim/task_between.hpp"

namespace spf::sim {
namespace {

constexpr double kStartGap = 1.0;    // [m] from a robot's centre to a person's
constexpr double kStartShift = 0.4;  // [s]
constexpr int kSides = 4;

template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream sentence;
  (sentence << ... << parts);
  throw std::runtime_error{sentence.str()};
}

/// Robot 0, 4, 8, ... enters from the left, 1, 5, ... from the right, then from below, then from above; those
/// of one side are spread evenly, a single one is in the middle.
RobotTask task_from_side(const Box& extent, int robot, int robots) {
  const int side = robot % kSides;
  const int on_side = (robots - side + kSides - 1) / kSides;
  const double share = (robot / kSides + 0.5) / on_side;
  const Eigen::Vector2d along = extent.low + share * (extent.high - extent.low);
  Eigen::Vector2d start = along;
  Eigen::Vector2d goal = along;
  const int axis = side < 2 ? 0 : 1;
  start[axis] = side % 2 == 0 ? extent.low[axis] : extent.high[axis];
  goal[axis] = side % 2 == 0 ? extent.high[axis] : extent.low[axis];
  return task_between(start, goal);
}

bool everybody_away(Crowd& crowd, double time, const std::vector<RobotTask>& robots) {
  bool away = true;
  crowd.visit(time, 0.0, [&](int, const Eigen::Vector2d& person, const Eigen::Vector2d&) {
    for (const RobotTask& task : robots)
      away = away && (person - task.start.position_world).norm() >= kStartGap;
  });
  return away;
}

}  // namespace

int pedestrian_trials(const CrowdRecording& crowd, const LayoutParameters& layout) {
  return crowd.window_count(layout.window, layout.window_spacing);
}

void place_among_people(const CrowdRecording& crowd, const LayoutParameters& layout, int trial,
                        Scenario& scenario) {
  const int windows = pedestrian_trials(crowd, layout);
  if (trial < 0 || trial >= windows)
    refuse("trial ", trial, " is beyond the recording, which has ", windows, " windows of ", layout.window,
           " s: trials 0 to ", windows - 1);
  for (int i = 0; i < layout.robots; ++i)
    scenario.robots.push_back(task_from_side(crowd.extent(), i, layout.robots));
  give_kinds_in_turn(scenario);
  const double slowest = slowest_time_of(scenario);
  const double nominal = crowd.begin() + trial * layout.window_spacing;
  // The latest start for which the robots still cross among people.
  const double latest = std::max(nominal, crowd.end() - slowest);
  Crowd people{crowd.samples(), crowd.longest_gap()};
  double begin = nominal;
  for (int shift = 0; !everybody_away(people, begin, scenario.robots);)
    if ((begin = nominal + kStartShift * ++shift) > latest)
      refuse("trial ", trial, " cannot begin: from ", nominal,
             " s to the end of the recording a person is always within ", kStartGap, " m of a robot's start");
  const double duration =
      scenario.simulation.trial.time_limit > 0.0 ? scenario.simulation.trial.time_limit : layout.window;
  scenario.simulation.trial.time_limit = duration;
  scenario.crowd = crowd.window(begin, duration);
  scenario.crowd_gap = crowd.longest_gap();
}

}  // namespace spf::sim
