#include "sim/fleet_life.hpp"

#include <algorithm>

namespace spf::sim {
namespace {

constexpr double kTimeRounding = 1e-9;  // [s]

}  // namespace

FleetLife::FleetLife(const Scenario& scenario)
    : source_{scenario}, goal_pause_{scenario.simulation.trial.goal_pause} {
  for (const FleetEvent& event : scenario.events) add(event);
}

void FleetLife::reached_goal(double time, std::size_t robot, int reached,
                             const Eigen::Vector2d& position_world,
                             const std::vector<std::optional<host::Goal>>& taken) {
  for (Pending& pending : pending_) {
    FleetEvent& event = pending.event;
    if (pending.timed || event.after_robot != static_cast<int>(robot) || reached < event.after_goals)
      continue;
    pending.timed = true;
    event.time += time;
  }
  const std::optional<host::Goal> next = source_.next(robot, position_world, taken);
  if (!next) return;
  FleetEvent event;
  event.order.robot = static_cast<int>(robot);
  event.order.goal = *next;
  event.time = time + goal_pause_;
  pending_.push_back({event, true});
}

void FleetLife::pass_on(double time, const std::function<bool(const FleetOrder&)>& happens,
                        std::vector<FleetOrder>& orders) {
  if (pending_.empty()) return;
  const auto has_happened = [&](const Pending& pending) {
    const FleetEvent& event = pending.event;
    if (!pending.timed || event.time > time + kTimeRounding || !happens(event.order)) return false;
    orders.push_back(event.order);
    return true;
  };
  pending_.erase(std::remove_if(pending_.begin(), pending_.end(), has_happened), pending_.end());
}

bool FleetLife::goes_on() const {
  return std::any_of(pending_.begin(), pending_.end(), [](const Pending& pending) { return pending.timed; });
}

bool FleetLife::goal_to_come(std::size_t robot) const {
  return std::any_of(pending_.begin(), pending_.end(), [&](const Pending& pending) {
    return pending.timed && pending.event.order.act == FleetAct::goal &&
           pending.event.order.robot == static_cast<int>(robot);
  });
}

}  // namespace spf::sim
