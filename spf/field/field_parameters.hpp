// How a moving obstacle is spread into a safety probability field, and where the field counts as dangerous
// (eq. 1-4).
#pragma once

#include "spf/math/parameters.hpp"

namespace spf {

struct FieldParameters {
  double attention = 0.5;       ///< [1] weight of the present position, 1 = no shift (lambda of eq. 2)
  double shift_interval = 2.0;  ///< [s] look-ahead of the centre (dt of eq. 2)
  double stretch_time = 2.0;    ///< [s] travel folded into the long axis (t below eq. 3)
  double threshold_scale =
      1.0;                  ///< [1] times the smallest ellipse that holds the disc now and after stretch_time
  bool directional = true;  ///< false: the speed counts as zero, a round field (ablation "without field")

  /// The only list of these fields.
  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("attention", self.attention, "1", Range{0.0, 1.0},
          "weight of the present position, lambda of eq. 2");
    visit("shift_interval", self.shift_interval, kSecondsByRobot, Range{0.0, 10.0},
          "look-ahead of the centre, dt of eq. 2");
    visit("stretch_time", self.stretch_time, kSecondsByRobot, Range{0.0, 10.0},
          "travel folded into the long axis, t below eq. 3");
    visit("threshold_scale", self.threshold_scale, "1", Range{0.5, 5.0},
          "danger threshold, times the smallest ellipse that holds the obstacle now and after stretch_time");
    visit("directional", self.directional, "false makes the field round (ablation without the field)");
  }
};

}  // namespace spf
