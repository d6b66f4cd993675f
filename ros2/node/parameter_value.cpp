#include "ros2/node/parameter_value.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <type_traits>

namespace ros2 {
namespace {

constexpr std::array<const char*, 10> kTypeNames{"not set",      "bool",        "integer",    "double",
                                                 "string",       "byte array",  "bool array", "integer array",
                                                 "double array", "string array"};
static_assert(std::variant_size_v<ParameterValue> == kTypeNames.size());
static_assert(rcl_interfaces::ParameterType::PARAMETER_STRING_ARRAY + 1 == kTypeNames.size());

std::string text_of(std::monostate) {
  return "not set";
}
std::string text_of(bool value) {
  return value ? "true" : "false";
}
std::string text_of(std::int64_t value) {
  return std::to_string(value);
}
std::string text_of(std::uint8_t value) {
  return std::to_string(value);
}
/// Short, reads back as the same number, and as no integer.
std::string text_of(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
  char text[32];
  for (int digits = 6; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) break;
  }
  std::string result = text;
  return result.find_first_of(".en") == std::string::npos ? result + ".0" : result;
}
std::string text_of(const std::string& value) {
  return value;
}
template <class Value>
std::string text_of(const std::vector<Value>& values) {
  std::string text;
  for (const auto& value : values) text += (text.empty() ? "" : ", ") + text_of(Value{value});
  return "[" + text + "]";
}

}  // namespace

const char* type_name(std::uint8_t type) {
  return type < kTypeNames.size() ? kTypeNames[type] : "unknown type";
}

std::string to_text(const ParameterValue& value) {
  return std::visit([](const auto& held) { return text_of(held); }, value);
}

rcl_interfaces::ParameterValue to_message(const ParameterValue& value) {
  rcl_interfaces::ParameterValue message;
  message.type = type_of(value);
  if (const auto* held = std::get_if<bool>(&value)) message.bool_value = *held;
  if (const auto* held = std::get_if<std::int64_t>(&value)) message.integer_value = *held;
  if (const auto* held = std::get_if<double>(&value)) message.double_value = *held;
  if (const auto* held = std::get_if<std::string>(&value)) message.string_value = *held;
  if (const auto* held = std::get_if<std::vector<std::uint8_t>>(&value)) message.byte_array_value = *held;
  if (const auto* held = std::get_if<std::vector<bool>>(&value)) message.bool_array_value = *held;
  if (const auto* held = std::get_if<std::vector<std::int64_t>>(&value)) message.integer_array_value = *held;
  if (const auto* held = std::get_if<std::vector<double>>(&value)) message.double_array_value = *held;
  if (const auto* held = std::get_if<std::vector<std::string>>(&value)) message.string_array_value = *held;
  return message;
}

std::optional<ParameterValue> from_message(const rcl_interfaces::ParameterValue& message) {
  using Type = rcl_interfaces::ParameterType;
  switch (message.type) {
    case Type::PARAMETER_NOT_SET:
      return ParameterValue{};
    case Type::PARAMETER_BOOL:
      return ParameterValue{message.bool_value};
    case Type::PARAMETER_INTEGER:
      return ParameterValue{message.integer_value};
    case Type::PARAMETER_DOUBLE:
      return ParameterValue{message.double_value};
    case Type::PARAMETER_STRING:
      return ParameterValue{message.string_value};
    case Type::PARAMETER_BYTE_ARRAY:
      return ParameterValue{message.byte_array_value};
    case Type::PARAMETER_BOOL_ARRAY:
      return ParameterValue{message.bool_array_value};
    case Type::PARAMETER_INTEGER_ARRAY:
      return ParameterValue{message.integer_array_value};
    case Type::PARAMETER_DOUBLE_ARRAY:
      return ParameterValue{message.double_array_value};
    case Type::PARAMETER_STRING_ARRAY:
      return ParameterValue{message.string_array_value};
    default:
      return std::nullopt;
  }
}

}  // namespace ros2
