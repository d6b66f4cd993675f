// Hides some fields of a parameter struct from a visitor, such as those that another key of a file sets.
#pragma once

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <vector>

namespace spf {

/// Forwards every call but those for hidden names.
template <class Visitor>
class HidingVisitor {
 public:
  HidingVisitor(Visitor& visit, const std::vector<std::string_view>& hidden)
      : visit_{visit}, hidden_{hidden} {}

  template <class... Rest>
  void operator()(const char* name, Rest&&... rest) {
    if (!hides(name)) visit_(name, rest...);
  }
  template <class... Rest>
  void values(const char* name, Rest&&... rest) {
    if (!hides(name)) visit_.values(name, rest...);
  }
  template <class Nested>
  void group(const char* name, Nested& nested) {
    if (!hides(name)) visit_.group(name, nested);
  }

 private:
  [[nodiscard]] bool hides(std::string_view name) const {
    return std::find(hidden_.begin(), hidden_.end(), name) != hidden_.end();
  }

  Visitor& visit_;
  const std::vector<std::string_view>& hidden_;
};

/// A struct seen through a HidingVisitor; usable wherever a struct with visit_fields is.
template <class Parameters>
struct PartlyHidden {
  Parameters& parameters;  ///< const or not
  std::vector<std::string_view> hidden;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    HidingVisitor<std::remove_reference_t<Visitor>> hiding{visit, self.hidden};
    Parameters::visit_fields(self.parameters, hiding);
  }
};

}  // namespace spf
