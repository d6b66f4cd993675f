// Sparse linear assignment: the cheapest matching of rows (tracks) and columns (detections) of which only
// some pairs are possible.
#pragma once

#include <vector>

namespace spf {

/// A possible pair and what it costs.
struct AssignmentPair {
  int row = 0;
  int column = 0;
  double cost = 0.0;
};

/// Finds the matching whose sum of costs, with `unassigned_cost` for every row left over, is least: pairs are
/// split into connected components, each solved by shortest augmenting paths (Jonker and Volgenant
/// 1987). Components of more than kLargestComponent rows are matched greedily, so that the time is bounded
/// for any input. Memory is reused.
class Assignment {
 public:
  static constexpr int kLargestComponent = 48;

  Assignment();

  /// Rows and columns are numbered from 0; pairs whose cost is not below `unassigned_cost` are never made.
  void solve(int rows, int columns, const std::vector<AssignmentPair>& pairs, double unassigned_cost);

  /// -1 = none.
  [[nodiscard]] const std::vector<int>& column_of_row() const { return column_of_row_; }
  [[nodiscard]] const std::vector<int>& row_of_column() const { return row_of_column_; }

 private:
  [[nodiscard]] int root_of(int node);
  void part(int rows, int columns, double unassigned_cost);
  void solve_exactly(std::size_t first, std::size_t last, double unassigned_cost);
  void match_greedily(std::size_t first, std::size_t last);
  void augment(int row, int width);

  std::vector<AssignmentPair> pairs_;  // by component
  std::vector<int> parent_;            // of rows, then columns
  std::vector<int> column_of_row_, row_of_column_;

  // Of one component, numbered anew; columns from 1, 0 is the row being assigned.
  std::vector<int> rows_, columns_, local_row_, local_column_;
  std::vector<double> cost_;  // rows x width
  std::vector<double> row_price_, column_price_, slack_;
  std::vector<int> matched_row_, previous_;
  std::vector<char> visited_;
};

}  // namespace spf
