// The method that a file names, out of a table. Read, written and listed like an enumeration, but open: the
// table may contain methods defined elsewhere.
#pragma once

#include <string>
#include <string_view>

#include "config/yaml_reader.hpp"
#include "spf/team/method_table.hpp"

namespace spf {

class MethodChoice {
 public:
  /// Throws std::invalid_argument when the table has no such method.
  MethodChoice(std::string_view name = kDefaultMethod, MethodTable table = {});  // NOLINT: implicit by design
  MethodChoice(const char* name) : MethodChoice{std::string_view{name}} {}       // NOLINT

  [[nodiscard]] const std::string& name() const { return method_.name; }
  [[nodiscard]] const Method& method() const { return method_; }
  [[nodiscard]] const MethodTable& table() const { return table_; }
  void choose(std::string_view name) { method_ = table_.at(name); }
  [[nodiscard]] bool operator==(const MethodChoice& other) const { return name() == other.name(); }

 private:
  MethodTable table_;
  Method method_;
};

[[nodiscard]] std::vector<std::string> method_names(const MethodTable& table);
/// For parameter lists and files.
[[nodiscard]] inline std::string to_text(const MethodChoice& choice) {
  return choice.name();
}
[[nodiscard]] std::string choices_of(const MethodChoice& choice);
void read_choice(const ReadTarget& target, MethodChoice& choice);

}  // namespace spf
