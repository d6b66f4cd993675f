// Runs one host::RobotHost per robot in a scenario's ground truth, one trial to its end, in the order of
// docs/protocol.md. Within a tick every robot thinks with what it has sensed and heard before, so they may
// do it at the same time; what they say and command takes effect afterwards, by number. Deterministic: the
// result depends on scenario and parameters alone, never on clocks or threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "host/contradictions.hpp"
#include "host/host_parameters.hpp"
#include "sim/recording.hpp"
#include "sim/scenario.hpp"
#include "sim/trial_listener.hpp"
#include "sim/trial_result.hpp"
#include "spf/team/agent_parameters.hpp"

namespace spf::sim {

class World;

/// Calls job(i) once for every i of 0 ... count - 1, on any threads and in any order, and returns when all
/// have ended.
using ForEach = std::function<void(std::size_t count, const std::function<void(std::size_t)>& job)>;

struct SimulationOptions {
  bool record = false;  ///< fill TrialResult::recording
  RecordLimit record_limit;
  /// Seconds of some steady clock; used to measure computing only. None: nothing is measured.
  std::function<double()> clock;
  /// Called every 0.1 simulated seconds with the time [s]; false ends the trial (as a timeout).
  std::function<bool(double)> progress;
  TrialListener* listener = nullptr;  ///< told of what happens; must outlive the simulation
  /// How the robots of one tick think; none: one after the other, on the calling thread. `clock` is then read
  /// on the threads of this.
  ForEach for_each;
};

class Simulation {
 public:
  /// `agents` are the parameters of each kind of robot (Scenario::fleet), one where all are alike; robot and
  /// (from below) goal tolerance are the scenario's. Throws std::invalid_argument with all reasons when the
  /// scenario or the parameters cannot be used.
  Simulation(const Scenario& scenario, const std::vector<AgentParameters>& agents,
             const SimulationOptions& options = {});
  /// The same where robots of all kinds have the same parameters.
  Simulation(const Scenario& scenario, const AgentParameters& agent, const SimulationOptions& options = {});
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Runs the trial. Call it once.
  [[nodiscard]] TrialResult run();

  // Or tick by tick, by the caller, who may change the world meanwhile (World::tell, World::place_moving).
  void tick();
  [[nodiscard]] bool finished() const;
  [[nodiscard]] TrialResult result() const;
  [[nodiscard]] World& world();
  /// World::change, whose static shapes robots are told where they know the map.
  void change(const Scenario& changed);
  /// Lifts a robot out and puts it back elsewhere when poses are due next and nobody is there, where its
  /// computer begins afresh with the goal that it had.
  void put(int robot, const Pose2& pose_world);
  /// Robots of all kinds go on with these parameters. Throws std::invalid_argument when they cannot be used.
  void reconfigure(const std::vector<AgentParameters>& agents);
  /// What has been recorded since the last call; requires SimulationOptions::record.
  [[nodiscard]] std::shared_ptr<const Recording> take_recording();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The map that robots are given: its frame, the border, and the static shapes when they are known.
[[nodiscard]] OccupancyMap robot_map(const Scenario& scenario);

/// The parameters an agent gets in this scenario: the robot's (unless there are kinds of robots: then
/// agent.robot stays as it is) and the rules of the trial over those given.
[[nodiscard]] AgentParameters agent_parameters_for(const Scenario& scenario, AgentParameters agent);

/// What a robot's host reckons with in this scenario. Its guards are up, and as wide as the scenario's own
/// noise of poses asks for: trials study noise that would be a fault elsewhere. Robots of a trial are
/// honest, so peers are taken at their word, as the experiments assume; observations always say what moves
/// around. Watchdogs bear three periods of what they wait for, so that slow planners, controllers and poses
/// can be studied.
[[nodiscard]] host::HostParameters host_parameters_for(const Scenario& scenario,
                                                       const AgentParameters& agent);

/// What contradicts each other in a scenario with this agent. Keys are those of scenario files.
[[nodiscard]] std::vector<host::Contradiction> contradictions(const Scenario& scenario,
                                                              const AgentParameters& agent);

}  // namespace spf::sim
