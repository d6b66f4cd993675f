// How the topics of a robot are published and heard. Who only listens takes what any publisher offers: best
// effort matches both kinds. Table: docs/ros2.md.
#pragma once

#include "ros2/node/qos.hpp"

namespace spf_ros2 {

inline constexpr ros2::Qos kPoses{50, false, false, 0.0};        // odom, heard
inline constexpr ros2::Qos kScans = ros2::Qos::sensor_data();    // scan, obstacles, heard
inline constexpr ros2::Qos kCommands = ros2::Qos::keep_last(1);  // cmd_vel, wheel_speeds, told
inline constexpr ros2::Qos kFleet = ros2::Qos::keep_last(50);    // /swarm/trajectories, told
inline constexpr ros2::Qos kPeers = ros2::Qos::keep_last(200);   // likewise, heard
inline constexpr ros2::Qos kMaps = ros2::Qos::latched();         // /map, grid

}  // namespace spf_ros2
