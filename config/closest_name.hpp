// "Did you mean ...?" for mistyped names.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spf {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn one text into the other (no
/// part is edited twice: optimal string alignment).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name nearest to `name`, if it is within a third of its letters (and at least one), or else the
/// only known name that begins with it.
[[nodiscard]] std::optional<std::string> closest_name(std::string_view name,
                                                      const std::vector<std::string>& known);

}  // namespace spf
