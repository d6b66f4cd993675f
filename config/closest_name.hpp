// "Did you mean ...?" for names that somebody mistyped.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spf {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn one text into the other (each
/// place is edited once: optimal string alignment).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name that is nearest to `name`, when it is near enough to be meant: at most a third of its
/// letters (and at least one) apart, or the one known name that begins with it.
[[nodiscard]] std::optional<std::string> closest_name(std::string_view name,
                                                      const std::vector<std::string>& known);

}  // namespace spf
