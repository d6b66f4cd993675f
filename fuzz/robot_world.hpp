// A robot for fuzz programs, in one process or split, and the invariants that hold for any input.
#pragma once

#include <cmath>

#include "fuzz/fuzz_input.hpp"
#include "host/perception_host.hpp"
#include "host/robot_host.hpp"
#include "host/split_host.hpp"
#include "spf/team/method_table.hpp"
#include "spf/team/robot_agent.hpp"

namespace spf::fuzz {

inline OccupancyMap small_map() {
  OccupancyMap map{GridFrame::covering({-5.0, -5.0}, {5.0, 5.0}, 0.25), 1.0};
  map.add_box({1.0, -0.5}, {1.5, 0.5});
  return map;
}

inline AgentParameters agent_of(Bytes& bytes) {
  constexpr const char* kMethods[] = {"space_time", "spf_empc", "orca", "es2_constant_velocity"};
  return with_method(AgentParameters{}, kMethods[bytes.up_to(3)]);
}

/// All numbers of a peer are believable.
inline void require_finite(const Peer& peer, double time) {
  require(
      std::isfinite(peer.position(time).squaredNorm()) && std::isfinite(peer.velocity(time).squaredNorm()),
      "peers have finite positions");
}

inline void require_sound(const RobotAgent& agent) {
  require(agent.committed().position(1e3).allFinite(), "a committed plan ends at a finite position");
  require(std::isfinite(agent.committed().duration()), "a committed plan ends");
  require(agent.peers().size() <= kMostPeers, "peers are bounded");
  require(agent.tracks().size() <= kMostTracks, "tracks are bounded");
  for (const Peer& peer : agent.peers())
    for (const double time : {-1e9, 0.0, 0.5, 1e9}) require_finite(peer, time);
  for (const ObstacleTrack& track : agent.tracks())
    require(track.state.position_world.allFinite() && track.state.velocity_world.allFinite(),
            "tracks have finite positions");
}

/// A robot that takes whatever is given at its word, already started.
inline host::RobotHost trusting_robot(const AgentParameters& agent) {
  host::HostParameters parameters;
  parameters.relies_on_scan = parameters.relies_on_obstacles = false;
  parameters.trusts_peers = true;
  host::RobotHost robot{0, agent, parameters};
  robot.planner().set_goal({{3.0, 0.0}, std::nullopt});
  robot.start(small_map(), Pose2{}, 0.0);
  return robot;
}

inline void step(host::RobotHost& robot, double time) {
  require(robot.step(time).wheel_speeds.allFinite(), "wheel speeds are numbers");
  if (robot.planner().agent() != nullptr) require_sound(*robot.planner().agent());
}

/// The first byte of an input chooses what receives the rest: a robot without gates, a robot with them, or
/// one part alone.
inline void give(Bytes bytes, void (*to_agent)(Bytes), void (*to_hosts)(Bytes), void (*to_part)(Bytes)) {
  const int choice = bytes.up_to(3);
  (choice == 0 ? to_agent : choice == 1 ? to_hosts : to_part)(bytes);
}

}  // namespace spf::fuzz
