// Parameters of the space-time method, our addition to the paper (docs/space_time.md).
#pragma once

#include "spf/math/parameters.hpp"

namespace spf {

struct SpaceTimeParameters {
  double horizon = 3.0;              ///< [s] looked ahead
  double step = 0.1;                 ///< [s] between samples of a roll-out
  int headings = 16;                 ///< [1] directions of the sidesteps
  double short_sidestep = 0.7;       ///< [s] then towards the goal, or brake
  double long_sidestep = 1.6;        ///< [s] then towards the goal
  double collision_cost = 1000.0;    ///< [s] travel time worth one certain contact
  double discount_time = 0.7;        ///< [s] a risk this far ahead counts 1/e: there is time to plan again
  double cost_threshold = 0.02;      ///< [s] the direct motion is taken at once below this
  double keep_bonus = 0.05;          ///< [s] in favour of the current plan
  double stand_bonus = 0.3;          ///< [s] in favour of stopping while slow: keeps a blocked robot still
  double margin = 0.1;               ///< [m] added to the radii towards moving obstacles
  double static_margin = 0.02;       ///< [m] added to the robot's radius towards the static map
  double static_sigma = 0.02;        ///< [m] softness of static surfaces
  double sigma_floor = 0.03;         ///< [m] smallest uncertainty of a moving obstacle
  double start_acceleration = 0.25;  ///< [m/s^2] spread per axis of what something does that stands
  double peer_sigma = 0.02;          ///< [m] uncertainty of a peer's plan now
  double peer_sigma_growth = 0.08;   ///< [m/s] and its growth: peers plan again
  double peer_margin = 0.05;         ///< [m] added to the radii towards peers
  double peer_discount_time = 0.4;   ///< [s] as discount_time, for peers: they plan around each other
  double renewal = 1.0;              ///< [s] a plan is kept at most this long
  bool smoothing = true;             ///< false: roll-outs are driven as they are (ablation)
  double smoothing_tolerance =
      0.05;                     ///< [s] by which the smoothed motion may be costlier than the chosen one
  bool predict_bounces = true;  ///< the mean motion of an obstacle turns at static surfaces

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("horizon", self.horizon, kSecondsByRobot, Range{0.5, 6.0},
          "time looked ahead by the roll-outs, 30 steps of them at most");
    visit("headings", self.headings, "1", Range{4, 64}, "directions of the sidesteps");
    visit("collision_cost", self.collision_cost, kSecondsByRobot, Range{0.0, 1e6},
          "travel time worth one certain contact");
    visit("discount_time", self.discount_time, kSecondsByRobot, Range{0.05, 20.0},
          "a risk this far ahead counts 1/e, since there is time to plan again");
    visit("cost_threshold", self.cost_threshold, kSecondsByRobot, Range{0.0, 100.0},
          "the direct motion is taken at once when its risk costs less");
    visit("margin", self.margin, kMetresBySize, Range{0.0, 2.0},
          "added to the radii towards moving obstacles");
    visit("static_margin", self.static_margin, kMetresBySize, Range{0.0, 2.0},
          "added to the robot's radius towards the static map");
    visit("peer_margin", self.peer_margin, kMetresBySize, Range{0.0, 2.0},
          "added to the radii towards peers");
    visit("predict_bounces", self.predict_bounces,
          "predicted obstacles turn at static surfaces of the robot's map");
    visit("smoothing", self.smoothing, "the chosen motion is smoothed by the optimiser (MINCO under L-BFGS)");
  }

  /// No settings, but they follow the robot.
  template <class Self, class Visitor>
  static void visit_constants(Self& self, Visitor&& visit) {
    visit(self.step, Scale::time, Range{0.05, 0.2});
    visit(self.short_sidestep, Scale::time, Range{0.1, 3.0});
    visit(self.long_sidestep, Scale::time, Range{0.1, 6.0});
    visit(self.keep_bonus, Scale::time, Range{0.0, 10.0});
    visit(self.stand_bonus, Scale::time, Range{0.0, 10.0});
    visit(self.static_sigma, Scale::size, Range{0.001, 1.0});
    visit(self.sigma_floor, Scale::size, Range{0.001, 1.0});
    visit(self.start_acceleration, Scale::acceleration, Range{0.001, 50.0});
    visit(self.peer_sigma, Scale::size, Range{0.001, 1.0});
    visit(self.peer_sigma_growth, Scale::speed, Range{0.0, 2.0});
    visit(self.peer_discount_time, Scale::time, Range{0.05, 20.0});
    visit(self.renewal, Scale::time, Range{0.1, 2.0});
    visit(self.smoothing_tolerance, Scale::time, Range{0.0, 10.0});
  }
};

}  // namespace spf
