// One trial of a scenario, step by step: from one pose to the next, with the radio between its robots.
#pragma once

#include <optional>
#include <vector>

#include "python/scenario.hpp"
#include "sim/radio.hpp"
#include "sim/world.hpp"

namespace spf::python {

class WorldStepper {
 public:
  /// Begins trial `trial`. Throws std::invalid_argument where robots are not moved by their wheels.
  WorldStepper(const ScenarioFile& scenario, int trial);

  /// Begins anew: everything is sensed at time 0.
  void reset(int trial);
  /// Holds these inputs until the next pose is due, or the trial has ended. Row i is robot i's.
  void step(const std::vector<DriveInput>& inputs);
  /// The robots' words, on the air with the next step.
  void broadcast(int robot, const HeardMessage& message);

  [[nodiscard]] const sim::World& world() const { return *world_; }
  [[nodiscard]] const ScenarioFile& scenario() const { return scenario_; }
  [[nodiscard]] int trial() const { return trial_; }
  /// What robots are told with this step, or befalls them.
  [[nodiscard]] const std::vector<sim::FleetOrder>& orders() const { return orders_; }
  /// How often it has begun.
  [[nodiscard]] int beginnings() const { return beginnings_; }
  [[nodiscard]] bool finished() const { return world_->finished(); }

  // As last sensed, by robot.
  [[nodiscard]] const std::vector<PoseMeasurement>& poses() const { return poses_; }
  [[nodiscard]] const std::vector<Observation>& observations() const { return observations_; }
  /// Whether a robot's is new with this step.
  [[nodiscard]] bool observed(std::size_t robot) const { return observed_[robot]; }
  [[nodiscard]] const std::vector<std::vector<HeardMessage>>& messages() const { return messages_; }

 private:
  void sense();

  ScenarioFile scenario_;
  int trial_ = 0;
  int beginnings_ = 0;
  std::vector<sim::FleetOrder> orders_;
  std::optional<sim::World> world_;
  std::optional<sim::Radio> radio_;
  std::vector<PoseMeasurement> poses_;
  std::vector<Observation> observations_;
  std::vector<char> observed_;
  std::vector<std::vector<HeardMessage>> messages_;
};

}  // namespace spf::python
