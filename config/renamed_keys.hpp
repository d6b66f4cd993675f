// Parameters whose names have changed since earlier releases. A file or --set with the old name still works:
// the key is read as the new one.
#pragma once

#include <array>
#include <string_view>

#include "config/input_problem.hpp"
#include "config/yaml_tree.hpp"

namespace spf {

struct RenamedKey {
  std::string_view path;      ///< of the old key, from the root of the document
  std::string_view new_name;  ///< of its last part
};

/// All renamed keys, for scenario files and robot files alike.
inline constexpr std::array kRenamedKeys{
    RenamedKey{"agent.planner.least_sideways", "least_lateral_share"},
    RenamedKey{"agent.space_time.risk_price", "collision_cost"},
    RenamedKey{"agent.space_time.risk_fading", "discount_time"},
    RenamedKey{"agent.space_time.accepted_risk", "cost_threshold"},
};

enum class OldKey {
  conflicts,  ///< both given: a problem that names both
  replaces,   ///< both given: the old key's value counts, as that of a later setting does
};

/// Gives every old key of the document its new name.
void rename_old_keys(YamlNode& root, OldKey when_both, InputProblems& problems);

}  // namespace spf
