// How subscribers are connected.
#pragma once

#include <ros/transport_hints.h>

namespace spf_empc_ros {

/// Small messages leave at once, rather than wait for others that would fill a packet.
inline ros::TransportHints no_delay() {
  return ros::TransportHints().tcpNoDelay();
}

}  // namespace spf_empc_ros
