#include "python/world.hpp"
#include "spf/math/index.hpp"

#include <stdexcept>

namespace spf::python {

WorldStepper::WorldStepper(const ScenarioFile& scenario, int trial) : scenario_{scenario} {
  if (scenario.config().simulation.trial.tracking != sim::TrackingMode::full)
    throw std::invalid_argument(std::string{"trial.tracking = "} +
                                enum_name(scenario.config().simulation.trial.tracking) +
                                " must be full: a World's robots are moved by their wheels");
  reset(trial);
}

void WorldStepper::reset(int trial) {
  if (const std::string problem = trials_problem(scenario_.config(), trial, 1); !problem.empty())
    throw std::invalid_argument("trial = " + std::to_string(trial) + ": " + problem);
  const sim::Scenario scene = make_trial(scenario_.config(), trial);
  trial_ = trial;
  ++beginnings_;
  world_.emplace(scene);
  radio_.emplace(scene);
  poses_.assign(scene.robots.size(), {});
  observations_.assign(scene.robots.size(), {});
  messages_.assign(scene.robots.size(), {});
  world_->begin_tick();
  orders_ = world_->orders();
  sense();
}

void WorldStepper::step(const std::vector<DriveInput>& inputs) {
  for (std::size_t i = 0; i < inputs.size(); ++i) world_->command(static_cast<int>(i), inputs[i]);
  world_->end_tick();
  while (!world_->finished()) {
    world_->begin_tick();
    orders_ = world_->orders();
    if (world_->pose_due()) return sense();
    world_->end_tick();
  }
  observed_.assign(poses_.size(), 0);
  orders_.clear();
  for (std::vector<HeardMessage>& heard : messages_) heard.clear();
}

void WorldStepper::broadcast(int robot, const HeardMessage& message) {
  radio_->send(world_->time(), message, world_->positions()[as_index(robot)]);
}

/// In the order of docs/protocol.md: what is heard, then poses and surroundings, robot by robot.
void WorldStepper::sense() {
  for (std::vector<HeardMessage>& heard : messages_) heard.clear();
  radio_->deliver(world_->time(), world_->robot_grid(), world_->positions(),
                  [this](int receiver, const HeardMessage& message) {
                    messages_[as_index(receiver)].push_back(message);
                  });
  observed_.assign(poses_.size(), 0);
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (!world_->robots()[i].active()) continue;
    const int robot = static_cast<int>(i);
    poses_[i] = world_->measure_pose(robot);
    observed_[i] = world_->observation_due(robot);
    if (observed_[i]) world_->observe(robot, observations_[i]);
  }
}

}  // namespace spf::python
