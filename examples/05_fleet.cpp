// A fleet in the simulator: a scenario as text, one trial, its figures and a still picture. The same text in
// a file runs with `spf run` (docs/scenarios.md).
#include <experiments/replay_export.hpp>
#include <report/frame_svg.hpp>
#include <report/table.hpp>

#include <fstream>
#include <iostream>

namespace {

const char* const kScenario = R"(
family: explicit
border: {low: [-6, -5], high: [6, 5]}
robots:
  - {start: [-5, 0], goal: [5, 0]}
  - {start: [5, 0.5], goal: [-5, 0.5]}
  - {start: [-5, 3], goal: [5, -3]}
  - {start: [5, 3], goal: [-5, -3]}
  - {start: [0, -4], goal: [0, 4]}
discs:
  - {center: [-2, 1.5], radius: 0.5}
  - {center: [2, -1.5], radius: 0.5}
people:
  - {waypoints: [[-3, -4], [3, 4]], speed: 0.8}
)";

}  // namespace

int main() {
  const spf::Cell cell = spf::cell_of(spf::run_configuration_from_text(kScenario, "fleet"));
  spf::TrialOptions options;
  options.record = true;
  const spf::FinishedTrial trial = spf::run_trial(cell, 0, options);

  spf::Table table{{{"robot"}, {"travel time [s]"}, {"over the optimum [1]"}, {"path [m]"}}};
  for (std::size_t i = 0; i < trial.record.robots.size(); ++i) {
    const spf::RobotRecord& robot = trial.record.robots[i];
    table.add_row({std::to_string(i), spf::fixed(robot.travel_time, 2),
                   spf::fixed(robot.travel_time_ratio, 3), spf::fixed(robot.path_length, 2)});
  }
  std::cout << table.to_text() << to_string(trial.record.outcome) << ", clearance to the person at least "
            << spf::fixed(trial.record.dynamic_clearance, 2) << " m\n";

  std::ofstream{"05_fleet.svg"} << spf::render_frame_svg(spf::replay_data(cell.config, trial), 4.5);
  return trial.record.succeeded() ? 0 : 1;
}
