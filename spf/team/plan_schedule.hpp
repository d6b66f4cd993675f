// When the agent plans: at a period, and sooner where something has come that is not to wait for it. Times
// [s].
#pragma once

#include <algorithm>
#include <limits>

#include "spf/team/schedule.hpp"

namespace spf {

class PlanSchedule {
 public:
  /// [s] Observations may come so much later than a period after the last ones, and half a period at most,
  /// before a plan is made without them.
  static constexpr double kLongestDelay = 0.05;

  /// The first plan is due at `time`.
  PlanSchedule(double period, double time) : period_{period}, next_{time} {}

  [[nodiscard]] bool due(double now) const { return is_due(next_, now); }
  /// When the next plan is due at the latest.
  [[nodiscard]] double next() const { return next_; }

  /// Something has come: a plan is due now, or `least_interval` after the last one that was brought forward.
  /// With an interval of a period or more plans keep to their period.
  void bring_forward(double now, double least_interval) {
    if (least_interval >= period_) return;
    forward_ = true;
    next_ = std::min(next_, std::max(now, last_forward_ + least_interval));
  }

  /// A plan is made. What comes regularly finds the next one waiting for it a little longer than a period,
  /// lest it come just after a plan that was made without it.
  void planned(double now) {
    if (!forward_) {
      next_ = next_due(next_, period_, now);
      return;
    }
    forward_ = false;
    last_forward_ = now;
    next_ = now + period_ + std::min(0.5 * period_, kLongestDelay);
  }

 private:
  double period_;
  double next_;
  bool forward_ = false;  // the next plan was brought forward
  double last_forward_ = -std::numeric_limits<double>::infinity();
};

}  // namespace spf
