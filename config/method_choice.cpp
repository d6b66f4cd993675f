#include "config/method_choice.hpp"

namespace spf {

MethodChoice::MethodChoice(std::string_view name, MethodTable table)
    : table_{std::move(table)}, method_{table_.at(name)} {}

std::vector<std::string> method_names(const MethodTable& table) {
  std::vector<std::string> names;
  for (const Method& method : table.all()) names.push_back(method.name);
  return names;
}

std::string choices_of(const MethodChoice& choice) {
  std::string names;
  for (const std::string& name : method_names(choice.table())) names += (names.empty() ? "" : ", ") + name;
  return names;
}

void read_choice(const ReadTarget& target, MethodChoice& choice) {
  const std::vector<std::string> names = method_names(choice.table());
  if (const std::optional<std::size_t> index = read_name(target, names)) choice.choose(names[*index]);
}

}  // namespace spf
