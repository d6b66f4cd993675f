// The trials of a campaign condensed: one row for each cell, and every two methods compared on the same
// trials.
#pragma once

#include <vector>

#include "experiments/result_row.hpp"

namespace spf {

/// The trials of one cell and seed, in the order of their numbers.
using CellTrials = std::vector<TrialRecord>;

/// Groups records by cell and seed; cells come in the order in which they are first met.
[[nodiscard]] std::vector<CellTrials> by_cell(std::vector<TrialRecord> records);

[[nodiscard]] std::vector<ResultRow> rows_of(const std::vector<CellTrials>& cells);

/// Of every two cells that differ in their method alone, in the order of the cells; those without a common
/// trial are left out.
[[nodiscard]] std::vector<PairedRow> pairs_of(const std::vector<CellTrials>& cells);

}  // namespace spf
