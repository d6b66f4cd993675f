// What happens to the robots of a trial besides going to their first goal: what they are told while it runs,
// and that they break down, leave and join, at given times or after goals. Frame: world, SI.
#pragma once

#include <array>
#include <utility>

#include "host/goal.hpp"
#include "spf/math/parameters.hpp"

namespace spf::sim {

enum class FleetAct {
  goal,        ///< goes to another goal from now on
  cancel,      ///< has none any more, and stands
  pause,       ///< stands until resumed
  resume,      ///< goes on
  stop,        ///< emergency stop, until released
  release,     ///< of the emergency stop
  break_down,  ///< stands silent where it is, its computer and motors off
  repair,      ///< begins afresh where it stands
  leave,       ///< is taken out of the scene
  join,        ///< begins at its start, as soon as nobody is there
  priority,    ///< has another priority from now on
};

/// One act, whose time has come. Whoever runs the robots' software hands it on to them (fleet_order.hpp).
struct FleetOrder {
  int robot = 0;
  FleetAct act = FleetAct::goal;
  host::Goal goal;   ///< of FleetAct::goal
  int priority = 0;  ///< of FleetAct::priority
};

struct FleetEvent {
  FleetOrder order;
  double time = 0.0;     ///< [s] of the trial; with a condition, after it has come true
  int after_robot = -1;  ///< the condition: this robot has reached `after_goals` goals; -1 = none
  int after_goals = 1;
};

}  // namespace spf::sim

namespace spf {
/// Words of scenario files.
template <>
struct EnumNames<sim::FleetAct> {
  static constexpr std::array<std::pair<sim::FleetAct, const char*>, 11> values{
      {{sim::FleetAct::goal, "goal"},
       {sim::FleetAct::cancel, "cancel"},
       {sim::FleetAct::pause, "pause"},
       {sim::FleetAct::resume, "resume"},
       {sim::FleetAct::stop, "stop"},
       {sim::FleetAct::release, "release"},
       {sim::FleetAct::break_down, "break_down"},
       {sim::FleetAct::repair, "repair"},
       {sim::FleetAct::leave, "leave"},
       {sim::FleetAct::join, "join"},
       {sim::FleetAct::priority, "priority"}}};
};
}  // namespace spf
