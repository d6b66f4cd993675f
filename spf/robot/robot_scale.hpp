// Size, speed and agility of a robot relative to the standard one, RobotParameters{} (radius 0.3 m, 1 m/s, 1
// m/s^2), for which the defaults of all parameters are written down. A toy car and a fork lift then start
// from the same behaviour at their own scale.
#pragma once

#include <algorithm>

#include "spf/math/parameters.hpp"
#include "spf/robot/robot_parameters.hpp"

namespace spf {

class RobotScale {
 public:
  explicit RobotScale(const RobotParameters& robot, const RobotParameters& standard = {});

  /// What a default with this scale is multiplied with [1].
  [[nodiscard]] double factor(Scale scale) const;

  // As a visitor of visit_fields: scales every field that has a ScaledUnit, within its range.
  void operator()(const char* /*name*/, double& value, ScaledUnit unit, Range range,
                  const char* /*what*/) const {
    const double one = factor(unit.scale);
    if (one != 1.0) value = std::clamp(value * one, range.low, range.high);
  }
  template <class... Rest>
  void operator()(const char* /*name*/, Rest&&... /*rest*/) const {}
  template <class... Rest>
  void values(const char* /*name*/, Rest&&... /*rest*/) const {}
  template <class Nested>
  void group(const char* /*name*/, Nested& nested) const {
    apply(nested, 0);
  }
  // ---- and of visit_constants, a list of what follows the robot but is no setting: visit(value, scale,
  // range).
  void operator()(double& value, Scale scale, Range range) const {
    operator()("", value, ScaledUnit{"", scale}, range, "");
  }

 private:
  template <class Parameters>
  friend Parameters scaled(Parameters parameters, const RobotScale& scale);

  template <class Parameters>
  auto apply(Parameters& parameters, int) const -> decltype(Parameters::visit_constants(parameters, *this)) {
    Parameters::visit_fields(parameters, *this);
    Parameters::visit_constants(parameters, *this);
  }
  template <class Parameters>
  void apply(Parameters& parameters, long) const {
    Parameters::visit_fields(parameters, *this);
  }

  double size_;      // [1]
  double distance_;  // [1]
  double speed_;     // [1]
  double time_;      // [1]
};

/// Parameters made for the standard robot, scaled to another.
template <class Parameters>
[[nodiscard]] Parameters scaled(Parameters parameters, const RobotScale& scale) {
  scale.apply(parameters, 0);
  return parameters;
}

}  // namespace spf
