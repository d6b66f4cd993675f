// A robot for fuzz programs: its agent, both hosts, and what must hold of them whatever comes in.
#pragma once

#include <cmath>

#include "fuzz/fuzz_input.hpp"
#include "host/perception_host.hpp"
#include "host/planner_host.hpp"
#include "host/tracker_host.hpp"
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

/// With numbers that can be reckoned with.
inline void require_somewhere(const Peer& peer, double time) {
  require(
      std::isfinite(peer.position(time).squaredNorm()) && std::isfinite(peer.velocity(time).squaredNorm()),
      "peers are somewhere");
}

inline void require_sound(const RobotAgent& agent) {
  require(agent.committed().position(1e3).allFinite(), "a committed plan leads to a place");
  require(std::isfinite(agent.committed().duration()), "a committed plan ends");
  require(agent.peers().size() <= kMostPeers, "peers are bounded");
  require(agent.tracks().size() <= kMostTracks, "tracks are bounded");
  for (const Peer& peer : agent.peers())
    for (const double time : {-1e9, 0.0, 0.5, 1e9}) require_somewhere(peer, time);
  for (const ObstacleTrack& track : agent.tracks())
    require(track.state.position_world.allFinite() && track.state.velocity_world.allFinite(),
            "tracks are somewhere");
}

inline void step(RobotAgent& agent, double time, const AgentInput& input) {
  const AgentOutput output = agent.step(time, input);
  require(output.wheel_speeds.allFinite(), "wheel speeds are numbers");
  require_sound(agent);
}

/// The first byte of an input chooses who is given the rest: one agent, a robot's hosts, or one part alone.
inline void give(Bytes bytes, void (*to_agent)(Bytes), void (*to_hosts)(Bytes), void (*to_part)(Bytes)) {
  const int choice = bytes.up_to(3);
  (choice == 0 ? to_agent : choice == 1 ? to_hosts : to_part)(bytes);
}

}  // namespace spf::fuzz
