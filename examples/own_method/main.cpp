// A user-defined method, complete in this file, and an spf program that offers it besides the built-in ones.
//
//   own_method run examples/own_method/yard.yaml --method straight_ahead
// "Straight ahead" follows the guide at a constant speed and stops for any obstacle. It is a poor method but
// a good example: it does all that a planner must do in a few lines.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "apps/program.hpp"
#include "spf/planning/cost_to_go.hpp"
#include "spf/planning/plan_judge.hpp"
#include "spf/trajectory/constant_acceleration.hpp"

namespace {

class StraightAhead final : public spf::Planner {
 public:
  explicit StraightAhead(const spf::AgentParameters& agent)
      : robot_{agent.robot}, judge_{agent.planner, agent.robot} {}

  void plan(const spf::PlanRequest& request, spf::PlanResult& result) override {
    result.clear();
    if (const std::optional<spf::PlanOutcome> refused = spf::refusal(request)) {
      spf::stand_instead(request, robot_, *refused, result);
      return;
    }
    // 1. The velocity: along the guide, at a speed from which the robot can stop at the goal.
    const Eigen::Vector2d& here = request.head.position_world;
    const double distance = request.guide->cost_to_go(here);
    const double speed = std::min(kSpeed * robot_.max_speed, std::sqrt(robot_.max_acceleration * distance));
    const Eigen::Vector2d velocity = speed * request.guide->direction(here);
    // 2. The trajectory: take that velocity up, hold it until the next plan, brake to rest.
    result.trajectory = spf::Trajectory{request.time};
    spf::FlatState end = request.head;
    const double change = (velocity - end.velocity_world).norm();
    append(end, velocity, std::max(change / robot_.max_acceleration, kShortest), result.trajectory);
    append(end, velocity, kHold, result.trajectory);
    append(end, {0.0, 0.0}, std::max(speed / robot_.max_acceleration, kShortest), result.trajectory);
    result.action = spf::PlanAction::follow;
    // 3. The clearance check decides whether that is a good plan; if not, the robot stops.
    judge_.judge(request, result.trajectory.end_time() + kLookAhead, result);
    if (result.outcome == spf::PlanOutcome::unsafe)
      spf::stand_instead(request, robot_, spf::PlanOutcome::unsafe, result);
  }

 private:
  static constexpr double kSpeed = 0.5;      // [1] of max_speed
  static constexpr double kHold = 0.2;       // [s] two planning periods
  static constexpr double kShortest = 0.05;  // [s] of a piece
  static constexpr double kLookAhead = 0.5;  // [s] beyond the stop

  /// Constant acceleration to a velocity; moves `state` to the piece's end.
  static void append(spf::FlatState& state, const Eigen::Vector2d& velocity, double duration,
                     spf::Trajectory& trajectory) {
    trajectory.append(
        spf::constant_acceleration(state.position_world, state.velocity_world, velocity, duration));
    state.position_world += 0.5 * duration * (state.velocity_world + velocity);
    state.velocity_world = velocity;
  }

  spf::RobotParameters robot_;
  spf::PlanJudge judge_;
};

}  // namespace

int main(int argc, char** argv) {
  spf::MethodTable methods;
  methods.add({"straight_ahead", "follows the guide and stops for what is in its way",
               [](const spf::AgentParameters& agent) { return std::make_unique<StraightAhead>(agent); }});
  return spf::run_program(argc, argv, methods);
}
