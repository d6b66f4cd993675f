// The parameters of a node: declared once, changed by whoever is allowed to.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <ros2_messages/rcl_interfaces/ListParametersResult.hpp>
#include <ros2_messages/rcl_interfaces/ParameterDescriptor.hpp>
#include <string>
#include <utility>
#include <vector>

#include "ros2/node/parameter_value.hpp"

namespace ros2 {

struct ParameterRange {
  double low = 0.0;
  double high = 0.0;
};

struct ParameterDescription {
  std::string text;                     ///< what it is, with its unit
  bool read_only = false;               ///< it keeps what it was given at the start
  std::optional<ParameterRange> range;  ///< of numbers
  std::string constraints;              ///< others, in words
};

class Parameters {
 public:
  using Named = std::pair<std::string, ParameterValue>;
  /// Says why changes are refused, all of them; empty when they are not. What it accepts holds from then on.
  using Accept = std::function<std::string(const std::vector<Named>& changes)>;
  /// Told of declarations (first) and changes (second).
  using OnEvent = std::function<void(const std::vector<Named>&, const std::vector<Named>&)>;

  /// `given` are the values of files and of the command line, for parameters that may be declared later.
  explicit Parameters(std::vector<Named> given) : given_{std::move(given)} {}

  void on_event(OnEvent on_event) { on_event_ = std::move(on_event); }
  /// Asked before every change, after those before it.
  void accept_by(Accept accept) { accept_.push_back(std::move(accept)); }

  /// The value that was given, or else this one, whose type it keeps for ever. Throws std::invalid_argument
  /// with name, value and limit when what was given does not fit.
  ParameterValue declare(const std::string& name, const ParameterValue& value,
                         ParameterDescription description);
  template <class Value>
  Value declare_as(const std::string& name, Value value, ParameterDescription description) {
    return std::get<Value>(declare(name, ParameterValue{std::move(value)}, std::move(description)));
  }

  /// Not set when it is not declared.
  [[nodiscard]] ParameterValue get(const std::string& name) const;
  [[nodiscard]] bool has(const std::string& name) const { return entries_.count(name) > 0; }
  /// All or none; why not, or empty.
  std::string set(const std::vector<Named>& changes);
  [[nodiscard]] rcl_interfaces::ParameterDescriptor describe(const std::string& name) const;
  /// Names that are, or lie below, one of the prefixes (none: all), at most `depth` parts below it (0: any).
  [[nodiscard]] rcl_interfaces::ListParametersResult list(const std::vector<std::string>& prefixes,
                                                          std::uint64_t depth) const;
  /// Names that were given and never declared: misspelt ones, mostly.
  [[nodiscard]] std::vector<std::string> unknown_given() const;

 private:
  struct Entry {
    ParameterValue value;
    ParameterDescription description;
  };
  std::vector<Named> given_;
  std::map<std::string, Entry> entries_;
  std::vector<Accept> accept_;
  OnEvent on_event_;
};

}  // namespace ros2
