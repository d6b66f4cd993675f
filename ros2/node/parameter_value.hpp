// The value of a parameter: one of the types that ROS 2 knows.
#pragma once

#include <cstdint>
#include <optional>
#include <ros2_messages/rcl_interfaces/ParameterType.hpp>
#include <ros2_messages/rcl_interfaces/ParameterValue.hpp>
#include <string>
#include <variant>
#include <vector>

namespace ros2 {

using ParameterValue =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<std::uint8_t>,
                 std::vector<bool>, std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>>;

/// As in rcl_interfaces/ParameterType; the order of the variant is that of its numbers.
[[nodiscard]] inline std::uint8_t type_of(const ParameterValue& value) {
  return static_cast<std::uint8_t>(value.index());
}
/// "double", "string array", ...
[[nodiscard]] const char* type_name(std::uint8_t type);
/// As it is written in YAML.
[[nodiscard]] std::string to_text(const ParameterValue& value);

[[nodiscard]] rcl_interfaces::ParameterValue to_message(const ParameterValue& value);
/// Nothing when its type is none.
[[nodiscard]] std::optional<ParameterValue> from_message(const rcl_interfaces::ParameterValue& message);

}  // namespace ros2
