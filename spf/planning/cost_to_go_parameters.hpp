// Parameters of the cost-to-go (spf/planning/cost_to_go.hpp).
#pragma once

#include "spf/math/parameters.hpp"

namespace spf {

struct CostToGoParameters {
  double clearance = 0.15;      ///< [m] distance to static surfaces that paths keep beyond the robot's radius
  double resolution = 0.2;      ///< [m] spacing of nodes; less where the distance kept asks for it
  double window_margin = 10.0;  ///< [m] the wavefront first stays this close to the box around robot and goal

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(
        "clearance", self.clearance, kMetresBySize, Range{0.0, 20.0},
        "distance to static surfaces that the global path keeps beyond the robot's radius; space_time takes "
        "narrower passages, at a price");
    visit("resolution", self.resolution, kMetresBySize, Range{0.005, 5.0},
          "spacing of the nodes of the global path's search");
  }

  /// No settings, but they follow the robot.
  template <class Self, class Visitor>
  static void visit_constants(Self& self, Visitor&& visit) {
    visit(self.window_margin, Scale::stopping_distance, Range{0.0, 1000.0});
  }
};

}  // namespace spf
