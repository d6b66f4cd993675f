// The unconstrained optimisation of Section "Optimization problem construction" (eq. 9): MINCO waypoints and
// durations under L-BFGS, with the cost terms of costs/. Frame: world.
#pragma once

#include <Eigen/Core>

#include <limits>
#include <vector>

#include "spf/math/lbfgs.hpp"
#include "spf/planning/costs/guide_pair.hpp"
#include "spf/planning/costs/node_set.hpp"
#include "spf/planning/moving_disc.hpp"
#include "spf/planning/planner_parameters.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/trajectory/decision_vector.hpp"
#include "spf/trajectory/minco.hpp"

namespace spf {

/// Waypoints (a column each, one fewer than durations) and durations [s]; fixed capacity.
struct TrajectorySeed {
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, Minco::kMaxPieces> waypoints_world;
  Minco::Durations durations;

  void resize(int pieces) {
    waypoints_world.resize(2, pieces - 1);
    durations.resize(pieces);
  }
  [[nodiscard]] int pieces() const { return static_cast<int>(durations.size()); }
};

/// A further cost term of the caller over the nodes, called once per evaluation: adds to NodeSet::penalty(k),
/// with gradients with respect to position and, where it depends on absolute time, to time. Does not own the
/// term.
class NodeTermRef {
 public:
  NodeTermRef() = default;
  /// `term` is called as term(NodeSet&).
  template <class Term>
  explicit NodeTermRef(const Term& term)
      : object_{&term}, add_{[](const void* object, NodeSet& nodes) {
          (*static_cast<const Term*>(object))(nodes);
        }} {}
  void add(NodeSet& nodes) const {
    if (add_ != nullptr) add_(object_, nodes);
  }

 private:
  const void* object_ = nullptr;
  void (*add_)(const void*, NodeSet&) = nullptr;
};

/// The problem of one run, besides the weights. The pointers must stay valid during the run.
struct TrajectoryProblem {
  double start_time = 0.0;                         ///< [s] absolute time of the head
  MincoEnds ends;                                  ///< head and tail
  int last_moving_node = 1 << 20;                  ///< nodes beyond it ignore peers and moving obstacles
  const std::vector<MovingDisc>* discs = nullptr;  ///< peers, and obstacles that are predicted as discs
  const std::vector<GuidePair>* static_pairs = nullptr;
  const std::vector<GuidePair>* field_pairs = nullptr;  ///< guide points of the probability field
  // Factors on weights, raised after a failed check.
  double peer_factor = 1.0;
  double dynamic_factor = 1.0;
  double static_factor = 1.0;
  double max_speed = std::numeric_limits<double>::infinity();  ///< [m/s] where less than the robot's
  double limits_factor = 1.0;
  NodeTermRef extra;  ///< a further term of the caller
};

/// Result of a run.
struct OptimizerResult {
  LbfgsOutcome outcome = LbfgsOutcome::not_finite;
  double cost = 0.0;
  int iterations = 0;
  int evaluations = 0;
};

/// Holds all workspaces; nothing allocates after construction.
class TrajectoryOptimizer {
 public:
  /// Throws std::invalid_argument when parameters are out of range.
  TrajectoryOptimizer(const PlannerParameters& planner, const RobotParameters& robot);

  /// Minimises from the seed. After it, solution(), nodes() and trajectory() describe the result (the best
  /// point found, when the outcome is a failure).
  OptimizerResult optimise(const TrajectoryProblem& problem, const TrajectorySeed& seed) {
    return optimise(problem, seed, [](const NodeSet&) { return LbfgsSignal::proceed; });
  }
  /// The same with a hook, called as LbfgsSignal(const NodeSet&) after every evaluation (its nodes);
  /// cancelling ends the run at the point before the current line search.
  template <class Hook>
  OptimizerResult optimise(const TrajectoryProblem& problem, const TrajectorySeed& seed, Hook&& hook) {
    begin(problem, seed);
    const LbfgsResult run = lbfgs_.minimize(
        decision_.head(layout_.size()),
        [this](const Lbfgs::Point& x, Lbfgs::Gradient gradient) { return evaluate(x, gradient); },
        [this, &hook](const Lbfgs::Point&, double) { return hook(static_cast<const NodeSet&>(nodes_)); });
    return finish(run);
  }

  /// Solves MINCO for a seed and evaluates its nodes without optimising, for example to find conflicts first.
  void set(const TrajectoryProblem& problem, const TrajectorySeed& seed);

  /// Total cost and its gradient with respect to the decision vector (decision_vector.hpp) for the problem of
  /// the last set/optimise.
  double evaluate(const Lbfgs::Point& decision, Lbfgs::Gradient gradient);

  [[nodiscard]] const TrajectorySeed& solution() const { return solution_; }
  [[nodiscard]] const NodeSet& nodes() const { return nodes_; }
  /// The motion without a heading, beginning at the problem's start time.
  [[nodiscard]] Trajectory trajectory() const { return minco_.trajectory(problem_.start_time); }

 private:
  void begin(const TrajectoryProblem& problem, const TrajectorySeed& seed);
  OptimizerResult finish(const LbfgsResult& run);
  void add_node_terms();

  PlannerParameters planner_;
  RobotParameters robot_;
  TrajectoryProblem problem_;
  Minco minco_;
  NodeSet nodes_;
  Lbfgs lbfgs_;
  DecisionLayout layout_;
  Eigen::VectorXd decision_;
  Minco::Coefficients wrt_coefficients_;
  Minco::Durations wrt_durations_;
  TrajectorySeed solution_;
};

}  // namespace spf
