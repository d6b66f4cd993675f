// Every parameter with its default, unit, range and meaning, as rows: for the terminal, docs/parameters.md
// and JSON.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/parameter_text.hpp"
#include "spf/math/parameters.hpp"

namespace spf {

template <>
struct EnumNames<Scale> {
  static constexpr std::array<std::pair<Scale, const char*>, 8> values{
      {{Scale::size, "size"},
       {Scale::stopping_distance, "distance"},
       {Scale::speed, "speed"},
       {Scale::time, "time"},
       {Scale::area, "size^2"},
       {Scale::acceleration, "speed/time"},
       {Scale::velocity_diffusion, "speed^2/time"},
       {Scale::position_diffusion, "distance^2/time"}}};
};

struct ParameterRow {
  std::string key;           ///< "sensing.range"; entries of lists as "robots[].start"
  std::string value;         ///< the default
  std::string unit;          ///< "m", "1" for pure numbers, empty for choices and text
  std::string range;         ///< "[0, 1]", or the names of a choice
  std::string what;          ///< meaning and source
  std::string follows = {};  ///< the property of the robot that the default follows (Scale), empty when none
};

/// Visitor for visit_fields; made by parameter_rows.
class ParameterRowCollector {
 public:
  template <class Value>
  void operator()(const char* name, const Value& value, const char* unit, Range range, const char* what) {
    rows_.push_back({prefix_ + name, to_text(value), unit, to_text(range), what});
  }
  void operator()(const char* name, const double& value, ScaledUnit unit, Range range, const char* what) {
    rows_.push_back({prefix_ + name, to_text(value), unit.name, to_text(range), what, enum_name(unit.scale)});
  }
  template <class Choice>
  void operator()(const char* name, const Choice& value, const char* what) {
    rows_.push_back({prefix_ + name, to_text(value), "", choices_of(value), what});
  }
  template <class Nested>
  void group(const char* name, const Nested& nested) {
    const std::string outer = std::exchange(prefix_, prefix_ + name + ".");
    Nested::visit_fields(nested, *this);
    prefix_ = outer;
  }
  template <class Nested>
  void optional_group(const char* name, const std::optional<Nested>&, const char* what) {
    rows_.push_back({prefix_ + name, "none", "", "map", what});
    const Nested nested;
    group(name, nested);
  }
  template <class Entry>
  void list(const char* name, const std::vector<Entry>&, const char* what) {
    rows_.push_back({prefix_ + name, "[]", "", "list", what});
    const std::string outer = std::exchange(prefix_, prefix_ + name + "[].");
    const Entry entry;
    Entry::visit_fields(entry, *this);
    prefix_ = outer;
  }
  template <class Number>
  void values(const char* name, const std::vector<Number>&, const char* unit, Range range, const char* what) {
    rows_.push_back({prefix_ + name, "[]", unit, "list of " + to_text(range), what});
  }
  void required(const char*) {}
  [[nodiscard]] std::vector<ParameterRow> take() { return std::move(rows_); }

 private:
  std::string prefix_;
  std::vector<ParameterRow> rows_;
};

template <class Parameters>
[[nodiscard]] std::vector<ParameterRow> parameter_rows(const Parameters& parameters) {
  ParameterRowCollector collector;
  Parameters::visit_fields(parameters, collector);
  return collector.take();
}

}  // namespace spf
