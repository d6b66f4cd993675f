#include "ros2/node/parameter_services.hpp"

namespace ros2 {
namespace {

rcl_interfaces::SetParametersResult set(Parameters& parameters,
                                        const std::vector<rcl_interfaces::Parameter>& asked) {
  rcl_interfaces::SetParametersResult result;
  std::vector<Parameters::Named> changes;
  for (const rcl_interfaces::Parameter& parameter : asked) {
    const std::optional<ParameterValue> value = from_message(parameter.value);
    if (!value)
      result.reason =
          parameter.name + " is of type " + std::to_string(parameter.value.type) + ", which is none";
    else
      changes.emplace_back(parameter.name, *value);
  }
  if (result.reason.empty()) result.reason = parameters.set(changes);
  result.successful = result.reason.empty();
  return result;
}

}  // namespace

rcl_interfaces::GetParameters_Response answer(Parameters& parameters,
                                              const rcl_interfaces::GetParameters_Request& request) {
  rcl_interfaces::GetParameters_Response response;
  for (const std::string& name : request.names) response.values.push_back(to_message(parameters.get(name)));
  return response;
}

rcl_interfaces::GetParameterTypes_Response answer(Parameters& parameters,
                                                  const rcl_interfaces::GetParameterTypes_Request& request) {
  rcl_interfaces::GetParameterTypes_Response response;
  for (const std::string& name : request.names) response.types.push_back(type_of(parameters.get(name)));
  return response;
}

rcl_interfaces::SetParameters_Response answer(Parameters& parameters,
                                              const rcl_interfaces::SetParameters_Request& request) {
  rcl_interfaces::SetParameters_Response response;
  for (const rcl_interfaces::Parameter& parameter : request.parameters)
    response.results.push_back(set(parameters, {parameter}));
  return response;
}

rcl_interfaces::SetParametersAtomically_Response answer(
    Parameters& parameters, const rcl_interfaces::SetParametersAtomically_Request& request) {
  rcl_interfaces::SetParametersAtomically_Response response;
  response.result = set(parameters, request.parameters);
  return response;
}

rcl_interfaces::DescribeParameters_Response answer(
    Parameters& parameters, const rcl_interfaces::DescribeParameters_Request& request) {
  rcl_interfaces::DescribeParameters_Response response;
  for (const std::string& name : request.names) response.descriptors.push_back(parameters.describe(name));
  return response;
}

rcl_interfaces::ListParameters_Response answer(Parameters& parameters,
                                               const rcl_interfaces::ListParameters_Request& request) {
  rcl_interfaces::ListParameters_Response response;
  response.result = parameters.list(request.prefixes, request.depth);
  return response;
}

std::vector<rcl_interfaces::Parameter> to_messages(const std::vector<Parameters::Named>& named) {
  std::vector<rcl_interfaces::Parameter> messages;
  for (const auto& [name, value] : named) {
    rcl_interfaces::Parameter message;
    message.name = name;
    message.value = to_message(value);
    messages.push_back(std::move(message));
  }
  return messages;
}

}  // namespace ros2
