// Parameters of the space-time method, our addition to the paper (docs/space_time.md).
#pragma once

#include "spf/math/parameters.hpp"

namespace spf {

struct SpaceTimeParameters {
  double horizon = 3.0;         ///< [s] looked ahead
  double step = 0.1;            ///< [s] between samples of a roll-out
  int headings = 16;            ///< [1] directions of the sidesteps
  double slow_fraction = 0.5;   ///< [1] second speed of the sidesteps, as a part of max_speed
  double short_sidestep = 0.7;  ///< [s] then towards the goal, or brake
  double long_sidestep = 1.6;   ///< [s] then towards the goal
  double risk_price = 1000.0;   ///< [s] travel time worth one certain contact
  double risk_fading = 0.7;     ///< [s] a risk this far ahead counts 1/e: there is time to plan again
  double accepted_risk = 0.02;  ///< [s] the direct way is taken at once below this
  double keep_bonus = 0.05;     ///< [s] in favour of the plan under way
  double stand_bonus = 0.3;     ///< [s] in favour of standing while slow: a blocked robot shall not fidget
  double early_progress = 0.3;  ///< [1] weight of the way to go at instants before the horizon
  double margin = 0.1;          ///< [m] added to the radii towards moving obstacles
  double static_margin = 0.02;  ///< [m] added to the robot's radius towards the static map
  double static_sigma = 0.02;   ///< [m] softness of static surfaces
  double sigma_floor = 0.03;    ///< [m] smallest uncertainty of a moving obstacle
  double peer_sigma = 0.02;     ///< [m] uncertainty of a peer's plan now
  double peer_sigma_growth = 0.08;     ///< [m/s] and its growth: peers plan again
  double standing_peer_growth = 0.25;  ///< [1] of that growth for a peer that stands
  double peer_margin = 0.05;           ///< [m] added to the radii towards peers
  double peer_risk_fading = 0.4;       ///< [s] as risk_fading, for peers: they plan around each other
  double lower_priority_weight = 0.3;  ///< [1] weight of the risk with peers that have to yield to us
  double renewal = 1.0;                ///< [s] a plan under way is kept at most this long
  bool smoothing = true;               ///< the chosen way is made smooth by the optimiser
  int smoothing_evaluations = 40;      ///< [1] cost evaluations of that at most
  double smoothing_tolerance = 0.05;   ///< [s] by which the smooth way may be dearer than the chosen one
  bool predict_bounces = true;         ///< the mean motion of an obstacle turns at static surfaces

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("horizon", self.horizon, kSecondsByRobot, Range{0.5, 6.0}, "time looked ahead by the roll-outs");
    visit("step", self.step, kSecondsByRobot, Range{0.05, 0.5},
          "time between samples of a roll-out; horizon / step must not exceed 30");
    visit("headings", self.headings, "1", Range{4, 64}, "directions of the sidesteps");
    visit("slow_fraction", self.slow_fraction, "1", Range{0.05, 1.0},
          "second speed of the sidesteps, as a part of max_speed");
    visit("short_sidestep", self.short_sidestep, kSecondsByRobot, Range{0.1, 3.0},
          "length of a short sidestep");
    visit("long_sidestep", self.long_sidestep, kSecondsByRobot, Range{0.1, 6.0}, "length of a long sidestep");
    visit("risk_price", self.risk_price, kSecondsByRobot, Range{0.0, 1e6},
          "travel time worth one certain contact");
    visit("risk_fading", self.risk_fading, kSecondsByRobot, Range{0.05, 20.0},
          "a risk this far ahead counts 1/e, since there is time to plan again");
    visit("accepted_risk", self.accepted_risk, kSecondsByRobot, Range{0.0, 100.0},
          "the direct way is taken at once when its risk costs less");
    visit("keep_bonus", self.keep_bonus, kSecondsByRobot, Range{0.0, 10.0}, "bonus of the plan under way");
    visit("stand_bonus", self.stand_bonus, kSecondsByRobot, Range{0.0, 10.0},
          "bonus of standing while slow, so that a blocked robot does not fidget");
    visit("early_progress", self.early_progress, "1", Range{0.0, 10.0},
          "weight of the way still to go at instants before the horizon: no putting off");
    visit("margin", self.margin, kMetresBySize, Range{0.0, 2.0},
          "added to the radii towards moving obstacles");
    visit("static_margin", self.static_margin, kMetresBySize, Range{0.0, 2.0},
          "added to the robot's radius towards the static map");
    visit("static_sigma", self.static_sigma, kMetresBySize, Range{0.001, 1.0}, "softness of static surfaces");
    visit("sigma_floor", self.sigma_floor, kMetresBySize, Range{0.001, 1.0},
          "smallest uncertainty of a moving obstacle");
    visit("peer_sigma", self.peer_sigma, kMetresBySize, Range{0.001, 1.0},
          "uncertainty of a peer's broadcast plan now");
    visit("peer_sigma_growth", self.peer_sigma_growth, kSpeedByRobot, Range{0.0, 2.0},
          "growth of that uncertainty, since peers plan again");
    visit("standing_peer_growth", self.standing_peer_growth, "1", Range{0.0, 10.0},
          "part of that growth for a peer that stands");
    visit("peer_margin", self.peer_margin, kMetresBySize, Range{0.0, 2.0},
          "added to the radii towards peers");
    visit("peer_risk_fading", self.peer_risk_fading, kSecondsByRobot, Range{0.05, 20.0},
          "as risk_fading, for peers, who avoid each other");
    visit("lower_priority_weight", self.lower_priority_weight, "1", Range{0.0, 1.0},
          "weight of the risk with peers that yield to this robot");
    visit("renewal", self.renewal, kSecondsByRobot, Range{0.1, 2.0},
          "a plan under way is kept at most this long");
    visit("smoothing", self.smoothing, "the chosen way is made smooth by the optimiser (MINCO under L-BFGS)");
    visit("smoothing_evaluations", self.smoothing_evaluations, "1", Range{5, 10000},
          "cost evaluations of the smoothing at most");
    visit("smoothing_tolerance", self.smoothing_tolerance, kSecondsByRobot, Range{0.0, 10.0},
          "by which the smooth way may be dearer than the chosen one");
    visit("predict_bounces", self.predict_bounces,
          "predicted obstacles turn at static surfaces of the robot's map");
  }
};

}  // namespace spf
