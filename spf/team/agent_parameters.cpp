#include "spf/team/agent_parameters.hpp"

#include "spf/robot/robot_scale.hpp"

namespace spf {

AgentParameters defaults_for(const RobotParameters& robot) {
  AgentParameters parameters = scaled(AgentParameters{}, RobotScale{robot});
  parameters.robot = robot;
  return parameters;
}

AgentParameters with_method(AgentParameters parameters, Method method) {
  if (method == Method::space_time || method == Method::orca) {
    parameters.generator = method == Method::orca ? Generator::orca : Generator::space_time;
    return parameters;
  }
  parameters.generator = Generator::field;

  // The paper's own presets (Section "Experimental Setup"): its field, its observer with its gains, its
  // self-sampling.
  parameters.field.directional = true;
  parameters.tracker.observer.kind = ObserverKind::eso;
  parameters.tracker.reference.self_sampling = true;
  parameters.planner.dynamic_model = DynamicModel::probability_field;
  switch (method) {
    case Method::es2:
      parameters.planner.dynamic_model = DynamicModel::frozen;
      break;
    case Method::es2_constant_velocity:
      parameters.planner.dynamic_model = DynamicModel::constant_velocity;
      break;
    case Method::spf_empc_without_field:
      parameters.field.directional = false;
      break;
    case Method::spf_empc_without_self_sampling:
      parameters.tracker.reference.self_sampling = false;
      break;
    case Method::spf_empc_without_observer:
      parameters.tracker.observer.kind = ObserverKind::none;
      break;
    case Method::spf_empc:
    case Method::orca:
    case Method::space_time:
      break;
  }
  return parameters;
}

}  // namespace spf
