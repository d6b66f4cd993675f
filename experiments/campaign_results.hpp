// The trials of a campaign condensed: one row for each cell, and a comparison of every two methods on the
// same trials.
#pragma once

#include <vector>

#include "experiments/result_row.hpp"

namespace spf {

/// The trials of one cell and seed, in the order of their numbers.
using CellTrials = std::vector<TrialRecord>;

/// Groups records by cell and seed; cells are in the order of their first trial.
[[nodiscard]] std::vector<CellTrials> by_cell(std::vector<TrialRecord> records);

[[nodiscard]] std::vector<ResultRow> rows_of(const std::vector<CellTrials>& cells);

/// Compares every two cells that differ in their method alone, in the order of the cells; pairs without a
/// common trial are left out.
[[nodiscard]] std::vector<PairedRow> pairs_of(const std::vector<CellTrials>& cells);

}  // namespace spf
