#include "config/removed_keys.hpp"

#include <algorithm>
#include <string>

namespace spf {
namespace {

/// Takes out what lies at a path below `node`, and the groups that are empty without it.
void refuse(YamlNode& node, const RemovedKey& removed, std::string_view rest, InputProblems& problems) {
  const std::size_t dot = rest.find('.');
  const auto entry = std::find_if(node.entries.begin(), node.entries.end(), [&](const YamlEntry& candidate) {
    return candidate.key == rest.substr(0, dot);
  });
  if (entry == node.entries.end()) return;
  if (dot == std::string_view::npos) {
    problems.add(entry->key_location,
                 std::string{removed.path} + " = " + shown(entry->value) +
                     " is no parameter any more: " + std::string{removed.instead},
                 std::string{removed.path});
    node.entries.erase(entry);
    return;
  }
  const std::size_t before = entry->value.entries.size();
  refuse(entry->value, removed, rest.substr(dot + 1), problems);
  if (before > 0 && entry->value.entries.empty()) node.entries.erase(entry);
}

}  // namespace

void refuse_removed_keys(YamlNode& root, InputProblems& problems) {
  for (const RemovedKey& removed : kRemovedKeys) refuse(root, removed, removed.path, problems);
}

}  // namespace spf
