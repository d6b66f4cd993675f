#include "config/parameter_text.hpp"

#include <cmath>
#include <string_view>

#include "config/number_text.hpp"

namespace spf {

std::string to_text(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
  return shortest_text(value);
}

std::string to_text(int value) {
  return std::to_string(value);
}
std::string to_text(std::uint64_t value) {
  return std::to_string(value);
}
std::string to_text(bool value) {
  return value ? "true" : "false";
}
std::string to_text(const Eigen::Vector2d& value) {
  return "[" + to_text(value.x()) + ", " + to_text(value.y()) + "]";
}
std::string to_text(const std::optional<double>& value) {
  return value ? to_text(*value) : "none";
}

std::string to_text(const std::optional<Eigen::Vector2d>& value) {
  return value ? to_text(*value) : "none";
}

std::string to_text(const std::string& value) {
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    if (c == '\n') {
      text += "\\n";
      continue;
    }
    text += c;
  }
  return text + "\"";
}

std::string choices_of(bool) {
  return "true, false";
}
std::string choices_of(const std::string&) {
  return "text";
}

std::string to_text(Range range) {
  if (std::isinf(range.low) && std::isinf(range.high)) return "any";
  if (std::isinf(range.high)) return ">= " + to_text(range.low);
  if (std::isinf(range.low)) return "<= " + to_text(range.high);
  return "[" + to_text(range.low) + ", " + to_text(range.high) + "]";
}

std::string limit_sentence(Range range, const char* unit) {
  const std::string suffix = std::string_view{unit} == "1" ? "" : std::string{" "} + unit;
  if (std::isinf(range.low) && std::isinf(range.high)) return "must be a finite number" + suffix;
  if (std::isinf(range.high)) return "must be at least " + to_text(range.low) + suffix;
  if (std::isinf(range.low)) return "must be at most " + to_text(range.high) + suffix;
  return "must lie in " + to_text(range) + suffix;
}

}  // namespace spf
