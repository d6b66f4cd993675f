// What `spf-ros2 simulator` is told when it starts (docs/ros2.md).
#pragma once

#include "ros2/node/node.hpp"
#include "simulator/settings.hpp"

namespace spf_ros2 {

/// Declares the parameters. Throws std::exception with every problem in one text; warns of what of the
/// scenario has no effect.
[[nodiscard]] spf::simulator::Settings read_simulator_config(ros2::Node& node);

}  // namespace spf_ros2
