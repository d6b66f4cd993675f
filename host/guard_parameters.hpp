// What can be set about the guard below everything (host/scan_guard.hpp).
#pragma once

#include "spf/math/parameters.hpp"

namespace spf::host {

struct GuardParameters {
  bool enabled = true;            ///< the scan guards the robot's path
  double margin = 0.02;           ///< [m] left between the robot and what it stops before
  double own_radius = 0.2;        ///< [m] what is nearer to the centre is part of the robot
  double fastest_approach = 2.0;  ///< [m/s] at which something may come towards it; 0: all stands still

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("enabled", self.enabled,
          "raw scans slow and stop the robot before what is in its way, whatever its plan says");
    visit("margin", self.margin, kMetresBySize, Range{0.0, 10.0},
          "left in front of the robot when it stops before something");
    visit("own_radius", self.own_radius, kMetresBySize, Range{0.0, 5.0},
          "returns nearer to the robot's centre are parts of itself; keep it below the radius by the "
          "scanner's noise (a robot with corners goes by its outline)");
    visit("fastest_approach", self.fastest_approach, "m/s", Range{0.0, 20.0},
          "what comes towards the robot no faster than this is stopped for while it comes; 0: all counts as "
          "standing");
  }
};

}  // namespace spf::host
