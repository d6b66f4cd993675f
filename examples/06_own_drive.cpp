// A robot of your own: its numbers describe the drive, and planner, controller and simulator follow. A
// tricycle that steers like a car and cannot reverse gets to a goal behind it, beside robots on other wheels.
#include <experiments/replay_export.hpp>
#include <report/frame_svg.hpp>
#include <report/table.hpp>
#include <spf/robot/drive.hpp>

#include <fstream>
#include <iostream>

namespace {

const char* const kScenario = R"(
family: explicit
border: {low: [-7, -4.5], high: [7, 4.5]}
fleet:
  - robot: {drive: car, radius: 0.35, wheel_base: 0.5, min_turning_radius: 0.9, may_reverse: false}
  - robot: {drive: differential}
  - robot: {drive: mecanum}
robots:
  - {start: [2, 2], goal: [-4, 2.5], heading: 0}
  - {start: [2, 0], goal: [-4, -1], heading: 0}
  - {start: [2, -3], goal: [-4, -3.5], heading: 0}
)";

}  // namespace

int main() {
  const spf::Cell cell = spf::cell_of(spf::run_configuration_from_text(kScenario, "own_drive"));
  for (const spf::AgentParameters& kind : spf::agents_of(cell.config)) {
    const spf::Drive drive{kind.robot};
    std::cout << enum_name(drive.type()) << ": inputs for 0.5 m/s ahead and 0.4 rad/s to the left: "
              << drive.input_for({0.5, 0.0, 0.4}).transpose() << ", turns within "
              << spf::fixed(drive.min_turning_radius(), 2) << " m\n";
  }
  spf::TrialOptions options;
  options.record = true;
  const spf::FinishedTrial trial = spf::run_trial(cell, 0, options);
  for (const spf::RobotRecord& robot : trial.record.robots)
    std::cout << spf::fixed(robot.travel_time, 2) << " s for " << spf::fixed(robot.path_length, 2) << " m, "
              << spf::fixed(robot.travel_time_ratio, 3) << " times the straight optimum\n";
  std::ofstream{"06_own_drive.svg"} << spf::render_frame_svg(spf::replay_data(cell.config, trial), 6.0);
  return trial.record.succeeded() ? 0 : 1;
}
