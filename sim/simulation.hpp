// Hosts one RobotAgent per robot in a scenario's ground truth and runs one trial to its end, in the order of
// docs/protocol.md. Deterministic: the result depends on scenario and parameters alone, never on clocks or
// threads.
#pragma once

#include <functional>
#include <memory>

#include "sim/scenario.hpp"
#include "sim/trial_listener.hpp"
#include "sim/trial_result.hpp"
#include "spf/team/agent_parameters.hpp"

namespace spf::sim {

struct SimulationOptions {
  bool record = false;  ///< fill TrialResult::recording
  /// Seconds of some steady clock; used to measure computing only. None: nothing is measured.
  std::function<double()> clock;
  /// Called every 0.1 simulated seconds with the time [s]; false ends the trial (as overtime).
  std::function<bool(double)> progress;
  TrialListener* listener = nullptr;  ///< told of what happens; must outlive the simulation
};

class Simulation {
 public:
  /// `agent` is the fleet's parameters; its robot and (from below) goal tolerance are the scenario's. Throws
  /// std::invalid_argument with all reasons when the scenario or the parameters cannot be used.
  Simulation(const Scenario& scenario, const AgentParameters& agent, const SimulationOptions& options = {});
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Runs the trial. Call it once.
  [[nodiscard]] TrialResult run();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The map that robots are given: its frame, the border, and the static shapes when they are known.
[[nodiscard]] OccupancyMap robot_map(const Scenario& scenario, const OccupancyParameters& parameters);

/// The parameters an agent gets in this scenario: the robot's and the rules of the trial over the fleet's.
[[nodiscard]] AgentParameters agent_parameters_for(const Scenario& scenario, AgentParameters agent);

}  // namespace spf::sim
