// Parameters: every parameter is declared once, in a plain struct with one `visit_fields` list, which drives
// files, command line, printed table and range check alike.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace spf {

/// Closed interval. Written as "inside", so that NaN is always refused.
struct Range {
  double low;
  double high;
  [[nodiscard]] bool contains(double value) const { return low <= value && value <= high; }
};

/// What a default scales with from robot to robot (spf/robot/robot_scale.hpp). A value that is set explicitly
/// is taken as written.
enum class Scale {
  size,                ///< radius of the robot; half the width of one with corners
  stopping_distance,   ///< distance within which it can turn or stop
  speed,               ///< its speed
  acceleration,        ///< speed / time
  time,                ///< time in which it can stop or clear its own footprint
  area,                ///< size squared
  velocity_diffusion,  ///< speed^2 / time
  position_diffusion,  ///< stopping_distance^2 / time
};

/// A unit whose defaults follow the robot; used in a field list in place of a unit's name.
struct ScaledUnit {
  const char* name;
  Scale scale;
  constexpr operator const char*() const { return name; }  // NOLINT: most visitors only want the name
};
inline constexpr ScaledUnit kMetresBySize{"m", Scale::size};
inline constexpr ScaledUnit kMetresByStopping{"m", Scale::stopping_distance};
inline constexpr ScaledUnit kSpeedByRobot{"m/s", Scale::speed};
inline constexpr ScaledUnit kSecondsByRobot{"s", Scale::time};

/// Names of an enumeration: specialise with `static constexpr std::array<std::pair<E, const char*>, N>
/// values`.
template <class E>
struct EnumNames;

/// The name of an enumerator, as written in files.
template <class E>
[[nodiscard]] const char* enum_name(E value) {
  for (const auto& [candidate, name] : EnumNames<E>::values)
    if (candidate == value) return name;
  return "?";
}

/// A visitor handed to `visit_fields` is called as
///   visit(name, number, unit, range, what)   for double and int; a ScaledUnit as unit says that the default
///                                            follows the robot
///   visit(name, value, what)                 for bool and for enumerations with EnumNames
///   visit.values(name, vector, unit, range, what)   for lists of numbers and of points
///   visit.group(name, nested_parameters)     for nested structs with a visit_fields of their own
/// `what` says in one sentence what the field is and where it comes from (equation, paper, our choice).
class ProblemCollector {
 public:
  template <class Number>
  void operator()(const char* name, const Number& value, const char* unit, Range range,
                  const char* /*what*/) {
    if (range.contains(static_cast<double>(value))) return;
    std::ostringstream sentence;
    sentence << prefix_ << name << " = " << value << " [" << unit << "] must lie in [" << range.low << ", "
             << range.high << "]";
    found_.push_back(sentence.str());
  }
  template <class Choice>
  void operator()(const char* /*name*/, const Choice& /*value*/, const char* /*what*/) {}
  void values(const char* name, const std::vector<Eigen::Vector2d>& points, const char* unit, Range range,
              const char* what) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::string entry = std::string{name} + "[" + std::to_string(i) + "]";
      for (const double coordinate : {points[i].x(), points[i].y()})
        operator()(entry.c_str(), coordinate, unit, range, what);
    }
  }
  template <class Parameters>
  void group(const char* name, const Parameters& nested) {
    const std::string outer = prefix_;
    prefix_ += std::string{name} + ".";
    Parameters::visit_fields(nested, *this);
    prefix_ = outer;
  }
  [[nodiscard]] std::vector<std::string> take() { return std::move(found_); }

 private:
  std::string prefix_;
  std::vector<std::string> found_;
};

/// Every violation as one sentence; empty when the parameters are usable.
template <class Parameters>
[[nodiscard]] std::vector<std::string> problems(const Parameters& parameters) {
  ProblemCollector collector;
  Parameters::visit_fields(parameters, collector);
  return collector.take();
}

/// Passes good parameters through; throws std::invalid_argument with all reasons at once.
template <class Parameters>
[[nodiscard]] Parameters validated(const Parameters& parameters) {
  std::string reasons;
  for (const std::string& problem : problems(parameters)) reasons += (reasons.empty() ? "" : "; ") + problem;
  if (!reasons.empty()) throw std::invalid_argument(reasons);
  return parameters;
}

}  // namespace spf
