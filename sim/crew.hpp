// What runs on the robots of a trial.
#pragma once

#include <vector>

#include "host/host_parameters.hpp"
#include "sim/scenario.hpp"
#include "spf/team/agent_parameters.hpp"

namespace spf::sim {

/// What runs on the robots of one kind.
struct Crew {
  AgentParameters agent;
  host::HostParameters host;
};

/// By kind (Scenario::fleet), of the parameters of each, or of those for all. Throws std::invalid_argument
/// with all reasons when they cannot be used.
[[nodiscard]] std::vector<Crew> crews_of(const Scenario& scenario,
                                         const std::vector<AgentParameters>& agents);

}  // namespace spf::sim
