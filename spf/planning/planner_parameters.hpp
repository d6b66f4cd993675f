// Parameters of the paper's planner (eq. 9-13) and its baselines. Lengths scale with the robot; weights are
// freed of the robot's scale (see each cost term), so one set serves a 0.05 m and a 1 m robot alike.
#pragma once

#include "spf/math/lbfgs.hpp"
#include "spf/math/parameters.hpp"

namespace spf {

/// What is assumed about moving obstacles. The baselines ES2 and ES2* differ in nothing else: both take them
/// as discs that are kept away from as from peers, and check them without a margin.
enum class DynamicModel {
  none,               ///< ignored (checks included)
  frozen,             ///< ES2: stays at its present position
  constant_velocity,  ///< ES2*: moves on at its present velocity
  probability_field,  ///< the paper: safety probability field, both sides tried
};

template <>
struct EnumNames<DynamicModel> {
  static constexpr std::array<std::pair<DynamicModel, const char*>, 4> values{
      {{DynamicModel::none, "none"},
       {DynamicModel::frozen, "frozen"},
       {DynamicModel::constant_velocity, "constant_velocity"},
       {DynamicModel::probability_field, "probability_field"}}};
};

/// Weights of the cost terms (eq. 9). Those in 1/s compare with `time`: a cost rate of 10 there is worth as
/// much as standing still with a time weight of 10.
struct CostWeights {
  double smoothness = 1.0;     ///< [1/s] of |jerk|^2 / (max_acceleration^2 / max_speed)^2
  double time = 10.0;          ///< [1/s]
  double limits = 1e4;         ///< [1/s] of the cubed relative excess of the squared limit
  double peers = 1000.0;       ///< [1/s] at contact
  double static_hard = 30.0;   ///< [1/s] at the inflated surface
  double static_soft = 100.0;  ///< [1/s] about that of the inflated surface
  double spacing = 10.0;       ///< [1] at the mean node distance of piece_length / nodes_per_piece
  double dynamic = 50.0;       ///< [1] omega_dyn of eq. 9, per point on the field's ellipse

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    constexpr Range kWeight{0.0, 1e9};
    visit("smoothness", self.smoothness, "1/s", kWeight,
          "weight of the squared jerk relative to the robot's own");
    visit("time", self.time, "1/s", kWeight, "weight of the travel time");
    visit("limits", self.limits, "1/s", kWeight, "weight of exceeded velocity, acceleration and jerk limits");
    visit("peers", self.peers, "1/s", kWeight,
          "weight of peers (and of obstacles that are predicted as discs), at contact");
    visit("static_hard", self.static_hard, "1/s", kWeight,
          "weight of static obstacles within hard_clearance, at contact");
    visit("static_soft", self.static_soft, "1/s", kWeight,
          "weight of static obstacles within soft_clearance, at contact");
    visit("spacing", self.spacing, "1", kWeight, "weight of long and uneven gaps between nodes");
    visit("dynamic", self.dynamic, "1", kWeight, "weight of uncertain moving obstacles, omega_dyn of eq. 9");
  }
};

/// Shares of max_speed and max_acceleration [1] at which they begin to cost: the penalty gives in a little
/// where time presses, and is to give in within the limits.
inline constexpr double kSpeedOnset = 0.975;
inline constexpr double kAccelerationOnset = 0.95;
/// Accepted excess of a plan over max_speed and max_acceleration [1]: less than commands may exceed them
/// (CommandLimiter), so that a robot can follow it.
inline constexpr double kSpeedTolerance = 0.005;
inline constexpr double kAccelerationTolerance = 0.05;

struct PlannerParameters {
  DynamicModel dynamic_model = DynamicModel::probability_field;
  double horizon = 7.5;          ///< [m] distance to the local target
  double piece_length = 1.5;     ///< [m] path length per piece (ES2)
  int max_pieces = 8;            ///< [1] no setting
  int nodes_per_piece = 5;       ///< [1] intervals between nodes in a piece (ES2); no setting
  double static_margin = 0.02;   ///< [m] beyond the robot's radius, for search and checks
  double hard_clearance = 0.1;   ///< [m] wanted beyond that from static obstacles
  double soft_clearance = 0.3;   ///< [m] comfortable beyond that
  double peer_margin = 0.05;     ///< [m] beyond contact with peers, for checks
  double peer_clearance = 0.25;  ///< [m] wanted beyond contact with peers and obstacles predicted as discs
  double safety_distance = 0.3;  ///< [m] d_saf of eq. 10, wanted beyond the field's ellipse
  double least_lateral_share =
      0.7;  ///< [1] sine of the least angle between escape direction and path through the field
  int run_evaluations = 60;      ///< [1] deadline of one optimiser run; no setting
  int max_evaluations = 400;     ///< [1] deadline of one plan
  double goal_tolerance = 0.01;  ///< [m] closer and at rest: the plan is to stay
  CostWeights weights;
  LbfgsParameters optimizer;  ///< no settings

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    constexpr Range kLength{0.0, 100.0};
    visit("dynamic_model", self.dynamic_model, "what is assumed about moving obstacles");
    visit("horizon", self.horizon, kMetresByStopping, Range{0.05, 100.0},
          "distance to the local target (ES2: 7.5)");
    visit("static_margin", self.static_margin, kMetresBySize, kLength,
          "beyond the radius, for search and checks of static obstacles");
    visit("hard_clearance", self.hard_clearance, kMetresBySize, Range{0.001, 100.0},
          "wanted beyond static_margin (ES2: 0.1)");
    visit("soft_clearance", self.soft_clearance, kMetresBySize, Range{0.001, 100.0},
          "comfortable beyond static_margin (ES2: 0.5)");
    visit("peer_margin", self.peer_margin, kMetresBySize, kLength, "beyond contact with peers, for checks");
    visit("peer_clearance", self.peer_clearance, kMetresBySize, Range{0.001, 100.0},
          "wanted beyond contact with them (and with obstacles that are predicted as discs)");
    visit("safety_distance", self.safety_distance, kMetresBySize, Range{0.001, 100.0}, "d_saf of eq. 10");
    visit("least_lateral_share", self.least_lateral_share, "1", Range{0.0, 1.0},
          "sine of the least angle between an escape direction and the path through the field; 0 = eq. 11 as "
          "printed");
    visit("max_evaluations", self.max_evaluations, "1", Range{5, 1000000},
          "cost evaluations of one plan: its deadline");
    visit.group("weights", self.weights);
  }

  /// No settings, but they follow the robot.
  template <class Self, class Visitor>
  static void visit_constants(Self& self, Visitor&& visit) {
    visit(self.piece_length, Scale::stopping_distance, Range{0.01, 100.0});
    visit(self.goal_tolerance, Scale::size, Range{0.0, 100.0});
  }
};

}  // namespace spf
