// Values of parameters as text that the reader reads back to the same value; ranges as people write them.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

#include "spf/math/parameters.hpp"

namespace spf {

/// Shortest decimal text that reads back to the same number; .inf, -.inf, .nan.
[[nodiscard]] std::string to_text(double value);
[[nodiscard]] std::string to_text(int value);
[[nodiscard]] std::string to_text(std::uint64_t value);
[[nodiscard]] std::string to_text(bool value);
/// [x, y]
[[nodiscard]] std::string to_text(const Eigen::Vector2d& value);
/// The number, or "none".
[[nodiscard]] std::string to_text(const std::optional<double>& value);
[[nodiscard]] std::string to_text(const std::optional<Eigen::Vector2d>& value);
/// In quotation marks, escaped.
[[nodiscard]] std::string to_text(const std::string& value);
/// The name of an enumerator.
template <class E, class = decltype(EnumNames<E>::values)>
[[nodiscard]] std::string to_text(E value) {
  return enum_name(value);
}

/// The possible values: "true, false", "text", or the names of an enumeration.
[[nodiscard]] std::string choices_of(bool);
[[nodiscard]] std::string choices_of(const std::string&);
template <class E, class = decltype(EnumNames<E>::values)>
[[nodiscard]] std::string choices_of(E) {
  std::string names;
  for (const auto& entry : EnumNames<E>::values)
    names += (names.empty() ? "" : ", ") + std::string{entry.second};
  return names;
}

/// "[0, 100]", ">= 0", "<= 5", "any"
[[nodiscard]] std::string to_text(Range range);
/// "must lie in [0, 100] m", "must be at least 0 m", ...
[[nodiscard]] std::string limit_sentence(Range range, const char* unit);

}  // namespace spf
