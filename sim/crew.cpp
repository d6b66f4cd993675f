#include "sim/crew.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "host/contradictions.hpp"
#include "sim/simulation.hpp"

namespace spf::sim {

std::vector<Crew> crews_of(const Scenario& scenario, const std::vector<AgentParameters>& agents) {
  const std::size_t kinds = std::max<std::size_t>(1, scenario.fleet.size());
  if (agents.size() != 1 && agents.size() != kinds)
    throw std::invalid_argument("parameters of " + std::to_string(agents.size()) + " kinds of robots for " +
                                std::to_string(kinds));
  std::vector<Crew> crews;
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    AgentParameters agent = agents[agents.size() == 1 ? 0 : kind];
    if (!scenario.fleet.empty()) agent.robot = scenario.fleet[kind];
    agent = agent_parameters_for(scenario, std::move(agent));
    host::refuse_contradictions(contradictions(scenario, agent));
    crews.push_back({agent, host_parameters_for(scenario, agent)});
  }
  return crews;
}

}  // namespace spf::sim
