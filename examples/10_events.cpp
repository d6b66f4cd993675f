// What happens to a fleet while it works: a robot breaks down in the way of others and is repaired, one is
// told to pause, one is given another goal, one joins later (docs/scenarios.md, events).
#include <experiments/replay_export.hpp>
#include <report/frame_svg.hpp>
#include <report/table.hpp>

#include <fstream>
#include <iostream>

namespace {

const char* const kScenario = R"(
family: explicit
border: {low: [-6, -4], high: [6, 4]}
boxes:
  - {low: [-1, -4], high: [1, -1.5]}
  - {low: [-1, 1.5], high: [1, 4]}
robots:
  - {start: [-5, 0.2], goal: [5, 0]}
  - {start: [-5, 2], goal: [5, 2]}
  - {start: [5, 1], goal: [-5, -1]}
  - {start: [5, -2], goal: [-5, -2]}
events:
  - {at: 4, robot: 0, do: break_down}
  - {at: 12, robot: 0, do: repair}
  - {at: 2, robot: 1, do: pause}
  - {at: 6, robot: 1, do: resume}
  - {at: 3, robot: 2, do: goal, goal: [-5, 3]}
  - {at: 5, robot: 3, do: join}
)";

}  // namespace

int main() {
  const spf::Cell cell = spf::cell_of(spf::run_configuration_from_text(kScenario, "events"));
  spf::TrialOptions options;
  options.record = true;
  const spf::FinishedTrial trial = spf::run_trial(cell, 0, options);
  const spf::ReplayData replay = spf::replay_data(cell.config, trial);
  for (const spf::ReplayEvent& event : replay.events)
    std::cout << spf::fixed(event.time, 1) << " s  robot " << event.robot << "  " << event.text << "\n";
  std::cout << to_string(trial.record.outcome) << " after " << spf::fixed(trial.record.sim_time, 1) << " s\n";
  std::ofstream{"10_events.svg"} << spf::render_frame_svg(replay, 9.0);
  return trial.record.succeeded() ? 0 : 1;
}
