// Settings that are each within their limits but contradict each other: wheels that cannot give what is
// planned, watchdogs that expire between two of the words they wait for, a robot that needs farther to stop
// than it sees. All such rules stand here; scenario files, robot files and hosts ask alike.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "host/host_parameters.hpp"
#include "spf/team/agent_parameters.hpp"

namespace spf::host {

/// What a robot works under that its own parameters do not say. Where something is not known it stays as it
/// is here, and nothing is said of it.
struct OperatingConditions {
  bool by_wheels = true;  ///< false: it is moved exactly as it plans, without poses and wheels
  double sensing_range = std::numeric_limits<double>::infinity();  ///< [m]
  double sensing_rate = std::numeric_limits<double>::infinity();   ///< [Hz] of scans and detections
  double pose_rate = std::numeric_limits<double>::infinity();      ///< [Hz]
  double computing_delay = 0.0;  ///< [s] that an observation is older when it is taken in
  bool others_report = false;    ///< obstacles, whether the robot relies on that or not
  bool has_peers = false;
  double peer_sight = std::numeric_limits<double>::infinity();  ///< [m] within which it senses other robots
  double message_range = std::numeric_limits<double>::infinity();  ///< [m]
  double message_loss = 0.0;                                       ///< [1] probability
  double message_delay = 0.0;                                      ///< [s]
};

enum class Severity {
  warning,  ///< dangerous or wasteful, but somebody may want it, to study it
  error,    ///< the robot could never do what it is for
};

struct Contradiction {
  Severity severity = Severity::warning;
  std::string key;       ///< as files call it: "robot.max_speed"
  std::string other;     ///< that it contradicts
  std::string value;     ///< of `key`, with its unit
  std::string sentence;  ///< follows "key = value", and names the limit
};

/// "robot.max_speed = 2 m/s is more than ..."
[[nodiscard]] std::string to_text(const Contradiction& contradiction);

/// All contradictions, by subject. Parameters must be within their ranges.
[[nodiscard]] std::vector<Contradiction> contradictions(const AgentParameters& agent,
                                                        const HostParameters& host,
                                                        const OperatingConditions& conditions = {});

/// Throws std::invalid_argument with every contradiction that is an error.
void refuse_contradictions(const std::vector<Contradiction>& found);

}  // namespace spf::host
