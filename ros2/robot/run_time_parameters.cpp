#include "ros2/robot/run_time_parameters.hpp"

#include <stdexcept>
#include <utility>

namespace spf_ros2 {
namespace {

constexpr const char* kPause = "pause";

ros2::ParameterValue declared(ros2::Parameters& parameters, const spf::RunTimeField& field) {
  ros2::ParameterDescription description;
  const bool number = field.choices.empty();
  description.text = field.what + (number && field.unit != "1" ? " [" + field.unit + "]" : "");
  if (number) {
    description.range = ros2::ParameterRange{field.range.low, field.range.high};
    return parameters.declare(field.name, std::get<double>(field.value), description);
  }
  for (const std::string& choice : field.choices)
    description.constraints += (description.constraints.empty() ? "one of " : ", ") + choice;
  return parameters.declare(field.name, std::get<std::string>(field.value), description);
}

}  // namespace

RunTimeParameters::RunTimeParameters(ros2::Node& node, const spf::RobotFile& file, Apply apply)
    : file_{file}, apply_{std::move(apply)} {
  std::vector<ros2::Parameters::Named> given;
  for (const spf::RunTimeField& field : run_time_fields(file))
    given.emplace_back(field.name, declared(node.parameters(), field));
  given.emplace_back(
      kPause,
      node.parameters().declare(
          kPause, false, {"brakes and holds; goes on with the same goal after it", false, std::nullopt, ""}));
  if (const std::string fault = change(given); !fault.empty()) throw std::invalid_argument{fault};
  node.parameters().accept_by([this](const auto& changes) { return change(changes); });
}

std::string RunTimeParameters::change(const std::vector<ros2::Parameters::Named>& changes) {
  std::map<std::string, spf::RunTimeValue> values = values_;
  bool paused = paused_;
  for (const auto& [name, value] : changes) {
    if (name == kPause)
      paused = std::get<bool>(value);
    else if (const auto* number = std::get_if<double>(&value))
      values[name] = *number;
    else if (const auto* text = std::get_if<std::string>(&value))
      values[name] = *text;
  }
  try {
    apply_({with_run_time_values(file_, values), paused});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  values_ = std::move(values);
  paused_ = paused;
  return {};
}

}  // namespace spf_ros2
