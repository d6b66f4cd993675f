// Parameters of the reactive rule (spf/planning/orca/orca_planner.hpp).
#pragma once

#include "spf/math/parameters.hpp"

namespace spf {

struct OrcaParameters {
  double margin = 0.05;              ///< [m] beyond contact, towards everything
  double time_horizon = 2.0;         ///< [s] no contact with what moves sooner than this
  double time_horizon_static = 1.0;  ///< [s] likewise with static surfaces
  double neighbour_distance = 10.0;  ///< [m] between surfaces; who is farther does not count
  int max_neighbours = 16;           ///< [1] and of those within it only the nearest
  double obstacle_share = 1.0;    ///< [1] of avoiding a moving obstacle; 1/2 takes it for one that avoids too
  double goal_tolerance = 0.005;  ///< [m] nearer to the goal the preferred velocity is zero
  bool limit_acceleration = true;  ///< false: the chosen velocity is taken up at once, as published

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("margin", self.margin, kMetresBySize, Range{0.0, 5.0},
          "distance beyond contact, towards everything");
    visit("time_horizon", self.time_horizon, kSecondsByRobot, Range{0.05, 60.0},
          "a velocity must be free of contact with what moves for this long, tau of the publication");
    visit("time_horizon_static", self.time_horizon_static, kSecondsByRobot, Range{0.05, 60.0},
          "likewise for static surfaces");
    visit("neighbour_distance", self.neighbour_distance, kMetresByStopping, Range{0.0, 1000.0},
          "gap beyond which others do not count");
    visit("max_neighbours", self.max_neighbours, "1", Range{0, 1000}, "nearest others that count");
    visit("obstacle_share", self.obstacle_share, "1", Range{0.0, 1.0},
          "part of avoiding a moving obstacle that falls to the robot; 1/2 takes it for one that avoids too");
    visit("limit_acceleration", self.limit_acceleration,
          "approach the chosen velocity at max_acceleration instead of taking it up at once");
  }

  /// No settings, but they follow the robot.
  template <class Self, class Visitor>
  static void visit_constants(Self& self, Visitor&& visit) {
    visit(self.goal_tolerance, Scale::size, Range{1e-6, 1.0});
  }
};

}  // namespace spf
