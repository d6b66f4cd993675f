// A method of your own beside the built-in ones: it follows the guide at half speed and stops for what is in
// its way. docs/add_a_method.md says what a method must do; own_method/ is a whole program around one.
#include <experiments/replay_export.hpp>
#include <report/frame_svg.hpp>
#include <spf/planning/cost_to_go.hpp>
#include <spf/planning/plan_judge.hpp>
#include <spf/trajectory/constant_acceleration.hpp>

#include <fstream>
#include <iostream>

namespace {

class StraightAhead final : public spf::Planner {
 public:
  explicit StraightAhead(const spf::AgentParameters& agent)
      : robot_{agent.robot}, judge_{agent.planner, agent.robot} {}

  void plan(const spf::PlanRequest& request, spf::PlanResult& result) override {
    result.clear();
    if (const std::optional<spf::PlanOutcome> refused = spf::refusal(request))
      return spf::stand_instead(request, robot_, *refused, result);
    Eigen::Vector2d position = request.head.position_world, velocity = request.head.velocity_world;
    const double brake = robot_.max_acceleration;
    const double speed = std::min(0.5, std::sqrt(brake * request.guide->cost_to_go(position)));
    const Eigen::Vector2d target = speed * request.guide->direction(position), rest{0.0, 0.0};
    result.trajectory = spf::Trajectory{request.time};
    for (const auto& [next, least] : {std::pair{target, 0.05}, {target, 0.2}, {rest, 0.05}}) {
      const double duration = std::max((next - velocity).norm() / brake, least);
      result.trajectory.append(spf::constant_acceleration(position, velocity, next, duration));
      position += 0.5 * duration * (velocity + next);
      velocity = next;
    }
    result.action = spf::PlanAction::follow;
    judge_.judge(request, result.trajectory.end_time() + 0.5, result);  // is that a good plan?
    if (result.outcome == spf::PlanOutcome::unsafe)
      spf::stand_instead(request, robot_, spf::PlanOutcome::unsafe, result);
  }

 private:
  spf::RobotParameters robot_;
  spf::PlanJudge judge_;
};

}  // namespace

int main(int argc, char** argv) {  // [SCENARIO.yaml]
  spf::MethodTable methods;
  methods.add({"straight_ahead", "follows the guide and stops for what is in its way",
               [](const spf::AgentParameters& agent) { return std::make_unique<StraightAhead>(agent); }});
  const char* const file = argc > 1 ? argv[1] : "examples/own_method/yard.yaml";
  const spf::Cell cell = spf::cell_of(spf::read_run_configuration(file, {}, methods));
  spf::TrialOptions options;
  options.record = true;
  const spf::FinishedTrial trial = spf::run_trial(cell, 0, options);
  std::cout << to_string(trial.record.outcome) << " in " << trial.record.sim_time << " s\n";
  std::ofstream{"07_own_method.svg"} << spf::render_frame_svg(spf::replay_data(cell.config, trial), 12.0);
  return trial.record.succeeded() ? 0 : 1;
}
