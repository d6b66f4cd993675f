// What a person of a scene does. Frame: world, SI.
#pragma once

#include <Eigen/Core>

#include <array>
#include <utility>
#include <vector>

#include "spf/math/parameters.hpp"

namespace spf {
namespace sim {

enum class PersonBehaviour {
  fixed,     ///< walks straight from waypoint to waypoint at constant speed, whatever is in the way
  reacting,  ///< avoids robots, other people, moving discs and everything static, and comes back to its path
};

enum class AtLastWaypoint {
  back,  ///< back along the waypoints, and again
  loop,  ///< on to the first
  stay,
};

struct PersonTask {
  std::vector<Eigen::Vector2d> waypoints;  ///< [m] the first is the start; one alone: stands there
  double speed = 1.3;                      ///< [m/s]
  double radius = 0.25;                    ///< [m]
  PersonBehaviour behaviour = PersonBehaviour::reacting;
  AtLastWaypoint at_last = AtLastWaypoint::back;
  bool anywhere = false;  ///< every trial draws where on the path it starts
};

}  // namespace sim

template <>
struct EnumNames<sim::PersonBehaviour> {
  static constexpr std::array<std::pair<sim::PersonBehaviour, const char*>, 2> values{
      {{sim::PersonBehaviour::fixed, "fixed"}, {sim::PersonBehaviour::reacting, "reacting"}}};
};
template <>
struct EnumNames<sim::AtLastWaypoint> {
  static constexpr std::array<std::pair<sim::AtLastWaypoint, const char*>, 3> values{
      {{sim::AtLastWaypoint::back, "back"},
       {sim::AtLastWaypoint::loop, "loop"},
       {sim::AtLastWaypoint::stay, "stay"}}};
};

}  // namespace spf
