// A scene that runs and may be changed while it does: the simulator and the robots' software of the program,
// one tick after the other, and what the page draws of it. A scene is {"scenario": {...}, "trial": 0,
// "changes": [...]}: a scenario file as JSON, and what was changed of what it gives (scene_change.hpp).
// Frame: world, SI.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "playground/scene_change.hpp"
#include "sim/simulation.hpp"
#include "study/scenario_file.hpp"

namespace spf::playground {

class Engine {
 public:
  /// Throws std::exception, with every reason, when the text is no scene that can run. `clock`: seconds of
  /// some steady clock.
  Engine(const std::string& scene, std::function<double()> clock);

  /// Goes on to a time [s] (at once where that has passed). Returns JSON: {"time", "outcome" (null until the
  /// trial has ended), "digest", "run": what was recorded since the last call, as in a replay page}; without
  /// "run" when nothing was.
  [[nodiscard]] std::string advance(double until);

  /// Changes what runs, and what a restart begins with. Throws std::invalid_argument with the reason when
  /// that cannot be; all is then as before.
  void change(const std::string& change);

 private:
  void change_live(const SceneChange& change);
  void move_robot(int robot, const Eigen::Vector2d& position_world);

  RunConfiguration config_;
  int trial_ = 0;
  sim::Scenario setup_;  // that it began with, as changed since
  std::unique_ptr<sim::Simulation> simulation_;
  std::optional<sim::TrialResult> result_;  // once the trial has ended
};

}  // namespace spf::playground
