// When the agent plans: at a period, each robot at its own instants of it, and sooner where something has
// come that is not to wait for it. Times [s].
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/team/schedule.hpp"

namespace spf {

/// Robots that plan at the same instant answer each other's last plan, not the one that is being made: two
/// that dodge to one side do so again and again. So each plans at an instant of its own within the period.
class PlanSchedule {
 public:
  /// [s] Observations may come so much later than a period after the last ones, and half a period at most,
  /// before a plan is made without them.
  static constexpr double kLongestDelay = 0.05;

  /// The first plan is due at `time`, the others when the clock reads `phase` periods and a whole number of
  /// them, so that robots whose clocks agree keep apart.
  PlanSchedule(double period, double time, double phase)
      : period_{period}, next_{time}, since_{(std::floor(time / period) + phase) * period} {}

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
      double periods = std::ceil((now - since_) / period_);
      // Not the same one again, however coarse large times are.
      if (since_ + period_ * periods <= now + kTimeTolerance) periods += 1.0;
      next_ = since_ + period_ * periods;
      return;
    }
    forward_ = false;
    last_forward_ = now;
    next_ = since_ = now + period_ + std::min(0.5 * period_, kLongestDelay);
  }

 private:
  double period_;
  double next_;
  double since_;          // plans of the period are due whole periods before and after this instant
  bool forward_ = false;  // the next plan was brought forward
  double last_forward_ = -std::numeric_limits<double>::infinity();
};

}  // namespace spf
