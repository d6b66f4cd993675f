// How far the robot sees, and what may come from where it does not.
#pragma once

#include "spf/math/parameters.hpp"

namespace spf {

struct SightParameters {
  double range = 1000.0;      ///< [m] up to which whatever moves is seen; scans bound it further
  double unseen_speed = 1.0;  ///< [m/s] of what may come from beyond: a brisk walk; 0 = nothing does

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("range", self.range, "m", Range{0.1, 1000.0},
          "distance up to which whatever moves is seen; what scans show bounds it further");
    visit(
        "unseen_speed", self.unseen_speed, "m/s", Range{0.0, 20.0},
        "speed of what may come from beyond: the robot can give way before it is there (0 = nothing comes)");
  }
};

}  // namespace spf
