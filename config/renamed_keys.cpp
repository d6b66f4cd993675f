#include "config/renamed_keys.hpp"

#include <algorithm>
#include <string>

namespace spf {
namespace {

/// The map that contains the last key of a path; null when there is none.
YamlNode* group_of(YamlNode& root, std::string_view path) {
  YamlNode* node = &root;
  for (std::size_t dot = path.find('.'); node != nullptr && dot != std::string_view::npos;
       dot = path.find('.')) {
    node = node->find(path.substr(0, dot));
    path.remove_prefix(dot + 1);
  }
  return node;
}

}  // namespace

void rename_old_keys(YamlNode& root, OldKey when_both, InputProblems& problems) {
  for (const RenamedKey& renamed : kRenamedKeys) {
    YamlNode* group = group_of(root, renamed.path);
    if (group == nullptr) continue;
    const std::string_view old_name = renamed.path.substr(renamed.path.rfind('.') + 1);
    const auto old = std::find_if(group->entries.begin(), group->entries.end(),
                                  [&](const YamlEntry& entry) { return entry.key == old_name; });
    if (old == group->entries.end()) continue;
    if (YamlNode* given = group->find(renamed.new_name)) {
      if (when_both == OldKey::conflicts)
        problems.add(old->key_location, std::string{renamed.path} + " is the old name of " +
                                            std::string{renamed.new_name} + ", which is given as well");
      else
        *given = std::move(old->value);
      group->entries.erase(old);
    } else {
      old->key = renamed.new_name;
    }
  }
}

}  // namespace spf
