#include "playground/engine.hpp"

#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "experiments/hexadecimal.hpp"
#include "experiments/replay_export.hpp"
#include "report/replay_json.hpp"
#include "sim/task_between.hpp"
#include "sim/world.hpp"

namespace spf::playground {
namespace {

using nlohmann::json;

TrialKey key_of(const RunConfiguration& config, int trial) {
  TrialKey key;
  key.family = enum_name(config.family);
  key.method = config.method.name();
  key.noise = enum_name(config.simulation.noise.model);
  key.level = config.simulation.noise.level;
  key.tracking = enum_name(config.simulation.trial.tracking);
  key.seed = config.seed;
  key.trial = trial;
  return key;
}

void set_price_of_risk(RunConfiguration& config, double seconds) {
  config.agent.space_time.collision_cost = seconds;
  for (RobotKind& kind : config.fleet) kind.agent.space_time.collision_cost = seconds;
}

}  // namespace

Engine::Engine(const std::string& scene, std::function<double()> clock) {
  const json parts = json::parse(scene, nullptr, false);
  if (!parts.is_object() || !parts.contains("scenario"))
    throw std::invalid_argument{"scene: must be a JSON object with a scenario"};
  config_ = run_configuration_from_text(parts["scenario"].dump(), "scenario");
  const json trial = parts.value("trial", json(0));
  if (!trial.is_number_integer() || trial.get<std::int64_t>() < 0 || trial.get<std::int64_t>() > 1'000'000)
    throw std::invalid_argument{"scene: trial = " + trial.dump() + " must be a whole number in [0, 1000000]"};
  trial_ = trial.get<int>();
  setup_ = make_trial(config_, trial_);
  for (const json& change : parts.value("changes", json::array())) {
    const SceneChange read = scene_change(change.dump());
    if (read.kind == SceneChange::Kind::risk) set_price_of_risk(config_, read.number);
    apply(read, setup_);
  }
  sim::SimulationOptions options;
  options.record = true;
  options.record_limit.always = sim::kUnlimited;
  options.clock = std::move(clock);
  simulation_ = std::make_unique<sim::Simulation>(setup_, agents_of(config_), options);
}

std::string Engine::advance(double until) {
  bool frame = false;  // what was recorded without one waits for the next
  while (simulation_->world().time() < until) {
    frame = frame || simulation_->world().step_due();
    simulation_->tick();
    if (!result_ && simulation_->finished()) result_ = simulation_->result();
  }
  FinishedTrial part;
  const sim::TrialResult now = result_ ? *result_ : simulation_->result();
  part.record.key = key_of(config_, trial_);
  part.record.outcome = now.outcome;
  part.record.sim_time = now.sim_seconds;
  json told = {
      {"time", simulation_->world().time()}, {"digest", hexadecimal(now.digest)}, {"outcome", nullptr}};
  if (result_) told["outcome"] = enum_name(now.outcome);
  if (result_) told["ended"] = now.sim_seconds;
  std::string text = told.dump();
  if (!frame) return text;
  part.recording = simulation_->take_recording();
  text.back() = ',';
  return text + "\"run\":" + replay_json(replay_data(config_, part)) + "}";
}

void Engine::change(const std::string& change) {
  const SceneChange read = scene_change(change);
  const bool moves = read.kind == SceneChange::Kind::robot || read.kind == SceneChange::Kind::moving;
  if (!moves) apply(read, setup_);
  change_live(read);
}

void Engine::change_live(const SceneChange& change) {
  sim::World& world = simulation_->world();
  switch (change.kind) {
    case SceneChange::Kind::goal: {
      sim::FleetOrder order{change.index, sim::FleetAct::goal, {change.at, std::nullopt}, 0};
      return world.tell(order);
    }
    case SceneChange::Kind::robot:
      return move_robot(change.index, change.at);
    case SceneChange::Kind::moving:
      return world.place_moving(change.index, change.at);
    case SceneChange::Kind::risk:
      set_price_of_risk(config_, change.number);
      return simulation_->reconfigure(agents_of(config_));
    case SceneChange::Kind::person:
    case SceneChange::Kind::crowd:
    case SceneChange::Kind::wall:
    case SceneChange::Kind::pillar:
      return simulation_->change(setup_);
  }
}

/// Lifted out of the scene and put back elsewhere, where it begins afresh.
void Engine::move_robot(int robot, const Eigen::Vector2d& position_world) {
  sim::World& world = simulation_->world();
  const auto index = static_cast<std::size_t>(robot);
  if (index >= setup_.robots.size())
    throw std::invalid_argument{"change: robot = " + std::to_string(robot) + ", of which there are " +
                                std::to_string(setup_.robots.size())};
  if (world.shapes().clearance(position_world, setup_.robot_of(index).radius) <= 0.0)
    throw std::invalid_argument{"robot " + std::to_string(robot) + " does not fit there"};
  const std::optional<host::Goal> goal = world.goal(robot);
  simulation_->put(robot,
                   sim::task_between(position_world, goal ? goal->position_world : position_world).start);
}

}  // namespace spf::playground
