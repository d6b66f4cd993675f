// The entries of a scenario file that tell of what happens to robots while a trial runs.
#pragma once

#include <Eigen/Core>

#include <limits>
#include <optional>

#include "sim/fleet_event.hpp"

namespace spf {

/// Marks coordinates that the file has to set.
inline const Eigen::Vector2d kUnsetPoint =
    Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
inline constexpr Range kCoordinate{-1e5, 1e5};

/// A condition: a robot has reached so many goals.
struct AfterEntry {
  int robot = 0;
  int goals = 1;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("robot");
    visit("robot", self.robot, "1", Range{0, 9999}, "which robot");
    visit("goals", self.goals, "1", Range{1, 1000000}, "how many goals it has reached by then");
  }
};

struct EventEntry {
  double at = 0.0;
  std::optional<AfterEntry> after;
  int robot = 0;
  sim::FleetAct act = sim::FleetAct::pause;
  std::optional<Eigen::Vector2d> goal;
  std::optional<double> goal_heading;
  int priority = 0;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("robot");
    visit.required("do");
    visit("at", self.at, "s", Range{0.0, 1e6}, "when: time of the trial, or, with after, since then");
    visit.optional_group("after", self.after, "not before a robot has reached some goals; none: at once");
    visit("robot", self.robot, "1", Range{0, 9999}, "to which robot");
    visit(
        "do", self.act,
        "goal: goes to another goal; cancel: has none any more; pause, resume; stop, release: the emergency "
        "stop; break_down: stands silent; repair: begins afresh there; leave: is taken away; join: begins "
        "at its start (before its first join a robot is not there), once nobody is in the way; priority");
    visit("goal", self.goal, "m", kCoordinate, "where to (do: goal)");
    visit("goal_heading", self.goal_heading, "rad", Range{-6.3, 6.3}, "of its x axis there; none: any");
    visit("priority", self.priority, "1", Range{0, 1000000}, "the smaller goes first (do: priority)");
  }
};

/// The event of an entry.
[[nodiscard]] inline sim::FleetEvent event_of(const EventEntry& entry) {
  sim::FleetEvent event;
  event.order = {
      entry.robot, entry.act, {entry.goal.value_or(kUnsetPoint), entry.goal_heading}, entry.priority};
  event.time = entry.at;
  if (entry.after) {
    event.after_robot = entry.after->robot;
    event.after_goals = entry.after->goals;
  }
  return event;
}

}  // namespace spf
