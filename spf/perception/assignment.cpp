#include "spf/perception/assignment.hpp"

#include <algorithm>
#include <limits>

#include "spf/math/index.hpp"

namespace spf {
namespace {

constexpr double kImpossible = 1e12;

}  // namespace

Assignment::Assignment() {
  constexpr std::size_t kUsual = 64;  // rows, and columns
  for (std::vector<int>* list :
       {&column_of_row_, &row_of_column_, &rows_, &columns_, &local_row_, &local_column_})
    list->reserve(kUsual);
  for (std::vector<int>* list : {&parent_, &matched_row_, &previous_}) list->reserve(2 * kUsual + 1);
  for (std::vector<double>* list : {&row_price_, &column_price_, &slack_}) list->reserve(2 * kUsual + 1);
  visited_.reserve(2 * kUsual + 1);
  pairs_.reserve(4 * kUsual);
  cost_.reserve(16 * kUsual);
}

void Assignment::solve(int rows, int columns, const std::vector<AssignmentPair>& pairs,
                       double unassigned_cost) {
  column_of_row_.assign(as_index(rows), -1);
  row_of_column_.assign(as_index(columns), -1);
  local_row_.assign(as_index(rows), -1);
  local_column_.assign(as_index(columns), -1);
  pairs_.assign(pairs.begin(), pairs.end());
  part(rows, columns, unassigned_cost);
  std::size_t first = 0;
  while (first < pairs_.size()) {
    const int root = root_of(pairs_[first].row);
    std::size_t last = first + 1;
    while (last < pairs_.size() && root_of(pairs_[last].row) == root) ++last;
    solve_exactly(first, last, unassigned_cost);
    first = last;
  }
}

int Assignment::root_of(int node) {
  while (parent_[as_index(node)] != node) {
    parent_[as_index(node)] = parent_[as_index(parent_[as_index(node)])];
    node = parent_[as_index(node)];
  }
  return node;
}

/// Drops pairs that cost too much and sorts the others by component.
void Assignment::part(int rows, int columns, double unassigned_cost) {
  const auto too_costly = [&](const AssignmentPair& pair) { return !(pair.cost < unassigned_cost); };
  pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), too_costly), pairs_.end());
  parent_.resize(as_index(rows + columns));
  for (int node = 0; node < rows + columns; ++node) parent_[as_index(node)] = node;
  for (const AssignmentPair& pair : pairs_)
    parent_[as_index(root_of(rows + pair.column))] = root_of(pair.row);
  for (int node = 0; node < rows + columns; ++node) parent_[as_index(node)] = root_of(node);
  std::sort(pairs_.begin(), pairs_.end(), [this](const AssignmentPair& a, const AssignmentPair& b) {
    const int root_a = parent_[as_index(a.row)];
    const int root_b = parent_[as_index(b.row)];
    if (root_a != root_b) return root_a < root_b;
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
}

void Assignment::match_greedily(std::size_t first, std::size_t last) {
  const auto begin = pairs_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = pairs_.begin() + static_cast<std::ptrdiff_t>(last);
  std::sort(begin, end, [](const AssignmentPair& a, const AssignmentPair& b) {
    if (a.cost != b.cost) return a.cost < b.cost;
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
  for (auto pair = begin; pair != end; ++pair) {
    if (column_of_row_[as_index(pair->row)] >= 0 || row_of_column_[as_index(pair->column)] >= 0) continue;
    column_of_row_[as_index(pair->row)] = pair->column;
    row_of_column_[as_index(pair->column)] = pair->row;
  }
}

void Assignment::solve_exactly(std::size_t first, std::size_t last, double unassigned_cost) {
  rows_.clear();
  columns_.clear();
  for (std::size_t k = first; k < last; ++k) {
    int& row = local_row_[as_index(pairs_[k].row)];
    int& column = local_column_[as_index(pairs_[k].column)];
    if (row < 0) {
      row = static_cast<int>(rows_.size());
      rows_.push_back(pairs_[k].row);
    }
    if (column < 0) {
      column = static_cast<int>(columns_.size());
      columns_.push_back(pairs_[k].column);
    }
  }
  const int row_count = static_cast<int>(rows_.size());
  if (row_count > kLargestComponent || columns_.size() > 4 * as_index(kLargestComponent)) {
    match_greedily(first, last);
    return;
  }

  // Every row also has a dummy column of its own, whose cost is that of staying unassigned.
  const int width = static_cast<int>(columns_.size()) + row_count;
  cost_.assign(as_index(row_count) * as_index(width), kImpossible);
  for (std::size_t k = first; k < last; ++k) {
    const int row = local_row_[as_index(pairs_[k].row)];
    cost_[as_index(row) * as_index(width) + as_index(local_column_[as_index(pairs_[k].column)])] =
        pairs_[k].cost;
  }
  for (int row = 0; row < row_count; ++row)
    cost_[as_index(row) * as_index(width) + columns_.size() + as_index(row)] = unassigned_cost;
  row_price_.assign(as_index(row_count), 0.0);
  column_price_.assign(as_index(width) + 1, 0.0);
  matched_row_.assign(as_index(width) + 1, -1);
  for (int row = 0; row < row_count; ++row) augment(row, width);
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    const int row = matched_row_[column + 1];
    if (row < 0) continue;
    column_of_row_[as_index(rows_[as_index(row)])] = columns_[column];
    row_of_column_[as_index(columns_[column])] = rows_[as_index(row)];
  }
}

/// Assigns one more row along the cheapest augmenting path (Dijkstra on reduced costs).
void Assignment::augment(int row, int width) {
  slack_.assign(as_index(width) + 1, std::numeric_limits<double>::infinity());
  previous_.assign(as_index(width) + 1, 0);
  visited_.assign(as_index(width) + 1, 0);
  matched_row_[0] = row;
  int here = 0;
  do {
    visited_[as_index(here)] = 1;
    const int looking = matched_row_[as_index(here)];
    double step = std::numeric_limits<double>::infinity();
    int next = 0;
    for (int column = 1; column <= width; ++column) {
      if (visited_[as_index(column)] != 0) continue;
      const double reduced = cost_[as_index(looking) * as_index(width) + as_index(column - 1)] -
                             row_price_[as_index(looking)] - column_price_[as_index(column)];
      if (reduced < slack_[as_index(column)]) {
        slack_[as_index(column)] = reduced;
        previous_[as_index(column)] = here;
      }
      if (slack_[as_index(column)] < step) {
        step = slack_[as_index(column)];
        next = column;
      }
    }
    for (int column = 0; column <= width; ++column) {
      if (visited_[as_index(column)] != 0) {
        row_price_[as_index(matched_row_[as_index(column)])] += step;
        column_price_[as_index(column)] -= step;
      } else {
        slack_[as_index(column)] -= step;
      }
    }
    here = next;
  } while (matched_row_[as_index(here)] >= 0);
  while (here != 0) {
    const int before = previous_[as_index(here)];
    matched_row_[as_index(here)] = matched_row_[as_index(before)];
    here = before;
  }
}

}  // namespace spf
