// docs/parameters.md: every key of a scenario file, and the defaults that methods and families change.
#pragma once

#include <string>
#include <vector>

#include "config/parameter_table.hpp"
#include "study/scenario_file.hpp"

namespace spf {

/// Every key that a scenario file may have, keys of explicit scenes included, with the defaults of family t2
/// and the default method.
[[nodiscard]] std::vector<ParameterRow> all_parameters();

/// Rows of `changed` whose value differs from that in `base`, or that `base` lacks.
[[nodiscard]] std::vector<ParameterRow> differences(const RunConfiguration& base,
                                                    const RunConfiguration& changed);

/// The whole page as Markdown.
[[nodiscard]] std::string parameter_page();

}  // namespace spf
