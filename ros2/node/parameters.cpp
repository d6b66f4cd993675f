#include "ros2/node/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ros2 {
namespace {

using Type = rcl_interfaces::ParameterType;

/// Whole numbers are numbers too.
ParameterValue as_type(const ParameterValue& value, std::uint8_t type) {
  if (type == Type::PARAMETER_DOUBLE)
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (type == Type::PARAMETER_DOUBLE_ARRAY)
    if (const auto* whole = std::get_if<std::vector<std::int64_t>>(&value))
      return std::vector<double>(whole->begin(), whole->end());
  return value;
}

std::optional<double> number_of(const ParameterValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  return std::nullopt;
}

std::string limit_text(double limit, std::uint8_t type) {
  return type == Type::PARAMETER_INTEGER ? std::to_string(std::llround(limit)) : to_text(limit);
}

/// Why a value of the right kind of type is none for this parameter; empty when it is.
std::string fault_of(const std::string& name, const ParameterValue& value, std::uint8_t type,
                     const ParameterDescription& description) {
  if (type_of(value) != type)
    return name + " = " + to_text(value) + " is of type " + type_name(type_of(value)) + ", must be " +
           type_name(type);
  const std::optional<double> number = number_of(value);
  if (description.range && number &&
      !(description.range->low <= *number && *number <= description.range->high))
    return name + " = " + to_text(value) + " must lie in [" + limit_text(description.range->low, type) +
           ", " + limit_text(description.range->high, type) + "]";
  return {};
}

std::uint64_t parts_below(const std::string& name, std::size_t from) {
  return static_cast<std::uint64_t>(
      std::count(name.begin() + static_cast<std::ptrdiff_t>(from), name.end(), '.'));
}

bool lies_in(const std::string& name, const std::string& prefix, std::uint64_t depth) {
  if (name == prefix) return true;
  if (name.rfind(prefix + ".", 0) != 0) return false;
  return depth == 0 || parts_below(name, prefix.size() + 1) < depth;
}

}  // namespace

ParameterValue Parameters::declare(const std::string& name, const ParameterValue& value,
                                   ParameterDescription description) {
  if (name.empty() || has(name))
    throw std::logic_error{"parameter '" + name + "' is declared already, or has no name"};
  ParameterValue starts = value;
  for (const Named& given : given_)
    if (given.first == name) starts = as_type(given.second, type_of(value));
  if (const std::string fault = fault_of(name, starts, type_of(value), description); !fault.empty())
    throw std::invalid_argument{fault};
  entries_.emplace(name, Entry{starts, std::move(description)});
  if (on_event_) on_event_({{name, starts}}, {});
  return starts;
}

ParameterValue Parameters::get(const std::string& name) const {
  const auto entry = entries_.find(name);
  return entry == entries_.end() ? ParameterValue{} : entry->second.value;
}

std::string Parameters::set(const std::vector<Named>& changes) {
  std::vector<Named> fitting;
  for (const auto& [name, value] : changes) {
    const auto entry = entries_.find(name);
    if (entry == entries_.end()) return "there is no parameter '" + name + "'";
    const ParameterDescription& description = entry->second.description;
    if (description.read_only) return name + " cannot be changed while the node runs";
    const std::uint8_t type = type_of(entry->second.value);
    const ParameterValue fits = as_type(value, type);
    if (std::string fault = fault_of(name, fits, type, description); !fault.empty()) return fault;
    fitting.emplace_back(name, fits);
  }
  for (const Accept& accept : accept_)
    if (std::string fault = accept(fitting); !fault.empty()) return fault;
  for (const auto& [name, value] : fitting) entries_[name].value = value;
  if (on_event_ && !fitting.empty()) on_event_({}, fitting);
  return {};
}

rcl_interfaces::ParameterDescriptor Parameters::describe(const std::string& name) const {
  rcl_interfaces::ParameterDescriptor descriptor;
  descriptor.name = name;
  const auto entry = entries_.find(name);
  if (entry == entries_.end()) return descriptor;
  const ParameterDescription& description = entry->second.description;
  descriptor.type = type_of(entry->second.value);
  descriptor.description = description.text;
  descriptor.additional_constraints = description.constraints;
  descriptor.read_only = description.read_only;
  if (!description.range) return descriptor;
  if (descriptor.type == Type::PARAMETER_INTEGER) {
    rcl_interfaces::IntegerRange range;
    range.from_value = std::llround(description.range->low);
    range.to_value = std::llround(description.range->high);
    descriptor.integer_range.push_back(range);
  } else {
    rcl_interfaces::FloatingPointRange range;
    range.from_value = description.range->low;
    range.to_value = description.range->high;
    descriptor.floating_point_range.push_back(range);
  }
  return descriptor;
}

rcl_interfaces::ListParametersResult Parameters::list(const std::vector<std::string>& prefixes,
                                                      std::uint64_t depth) const {
  rcl_interfaces::ListParametersResult result;
  for (const auto& [name, entry] : entries_) {
    const bool wanted =
        prefixes.empty()
            ? depth == 0 || parts_below(name, 0) < depth
            : std::any_of(prefixes.begin(), prefixes.end(),
                          [&, &key = name](const auto& prefix) { return lies_in(key, prefix, depth); });
    if (!wanted) continue;
    result.names.push_back(name);
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos) continue;
    const std::string prefix = name.substr(0, dot);
    if (std::find(result.prefixes.begin(), result.prefixes.end(), prefix) == result.prefixes.end())
      result.prefixes.push_back(prefix);
  }
  return result;
}

std::vector<std::string> Parameters::unknown_given() const {
  std::vector<std::string> unknown;
  for (const Named& given : given_)
    if (!has(given.first)) unknown.push_back(given.first);
  return unknown;
}

}  // namespace ros2
