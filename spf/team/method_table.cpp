#include "spf/team/method_table.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "spf/planning/field/field_replanning.hpp"
#include "spf/planning/orca/orca_planner.hpp"
#include "spf/planning/space_time/space_time_planner.hpp"

namespace spf {
namespace {

std::unique_ptr<Planner> make_field(const AgentParameters& agent) {
  return std::make_unique<FieldReplanning>(agent.planner, agent.robot, agent.field, agent.team.replanning);
}

std::unique_ptr<Planner> make_orca(const AgentParameters& agent) {
  return std::make_unique<OrcaPlanner>(agent.orca, agent.robot, agent.team.plan_period, agent.planner);
}

/// The paper's own presets (Section "Experimental Setup"): its field, its observer with its gains, its
/// self-sampling.
void as_published(AgentParameters& agent) {
  agent.field.directional = true;
  agent.tracker.observer.kind = ObserverKind::eso;
  agent.tracker.reference.self_sampling = true;
  agent.planner.dynamic_model = DynamicModel::probability_field;
}

std::vector<Method> built_in() {
  return {
      {"es2", "baseline ES2: moving obstacles taken as standing where they are", make_field,
       [](AgentParameters& agent) {
         as_published(agent);
         agent.planner.dynamic_model = DynamicModel::frozen;
       }},
      {"es2_constant_velocity", "baseline ES2*: moving obstacles taken at constant velocity", make_field,
       [](AgentParameters& agent) {
         as_published(agent);
         agent.planner.dynamic_model = DynamicModel::constant_velocity;
       }},
      {"spf_empc", "the paper's method", make_field, as_published},
      {"spf_empc_without_field", "its field does not see velocity (Table 3, w/o SPF)", make_field,
       [](AgentParameters& agent) {
         as_published(agent);
         agent.field.directional = false;
       }},
      {"spf_empc_without_self_sampling", "its controller follows discrete points (Table 3, w/o SS)",
       make_field,
       [](AgentParameters& agent) {
         as_published(agent);
         agent.tracker.reference.self_sampling = false;
       }},
      {"spf_empc_without_observer", "its controller takes raw measurements (Table 3, w/o ESO)", make_field,
       [](AgentParameters& agent) {
         as_published(agent);
         agent.tracker.observer.kind = ObserverKind::none;
       }},
      {"orca", "a reactive rule as the yardstick", make_orca},
      {"space_time", "ours: many motion primitives against a belief that moves and grows",
       make_space_time_planner},
  };
}

}  // namespace

std::unique_ptr<Planner> make_space_time_planner(const AgentParameters& agent) {
  return std::make_unique<SpaceTimePlanner>(agent.space_time, agent.planner, agent.robot);
}

MethodTable::MethodTable() : methods_{std::make_shared<const std::vector<Method>>(built_in())} {}

void MethodTable::add(Method method) {
  if (method.name.empty()) throw std::invalid_argument{"a method needs a name"};
  if (!method.make_planner) throw std::invalid_argument{"method " + method.name + " makes no planner"};
  if (find(method.name) != nullptr) throw std::invalid_argument{"method " + method.name + " exists already"};
  std::vector<Method> methods = *methods_;
  methods.push_back(std::move(method));
  methods_ = std::make_shared<const std::vector<Method>>(std::move(methods));
}

const Method* MethodTable::find(std::string_view name) const {
  const auto found = std::find_if(methods_->begin(), methods_->end(),
                                  [name](const Method& method) { return method.name == name; });
  return found == methods_->end() ? nullptr : &*found;
}

const Method& MethodTable::at(std::string_view name) const {
  if (const Method* method = find(name)) return *method;
  std::string names;
  for (const Method& method : all()) names += (names.empty() ? "" : ", ") + method.name;
  throw std::invalid_argument{"no method is called " + std::string{name} + "; there are " + names};
}

AgentParameters with_method(AgentParameters parameters, const Method& method) {
  if (method.change) method.change(parameters);
  parameters.make_planner = method.make_planner;
  return parameters;
}

AgentParameters with_method(AgentParameters parameters, std::string_view built_in_name) {
  return with_method(std::move(parameters), MethodTable{}.at(built_in_name));
}

}  // namespace spf
