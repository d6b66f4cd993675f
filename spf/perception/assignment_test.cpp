#include "spf/perception/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

constexpr double kUnassigned = 10.0;

/// Tries every matching, row by row.
double cheapest(int row, int rows, std::vector<char>& taken, const std::vector<AssignmentPair>& pairs) {
  if (row == rows) return 0.0;
  double best = kUnassigned + cheapest(row + 1, rows, taken, pairs);
  for (const AssignmentPair& pair : pairs) {
    char& column = taken[static_cast<std::size_t>(pair.column)];
    if (pair.row != row || column != 0) continue;
    column = 1;
    best = std::min(best, pair.cost + cheapest(row + 1, rows, taken, pairs));
    column = 0;
  }
  return best;
}

/// What a solution costs; checks that both directions agree.
double cost_of(const Assignment& solved, const std::vector<AssignmentPair>& pairs) {
  double cost = 0.0;
  for (std::size_t row = 0; row < solved.column_of_row().size(); ++row) {
    const int column = solved.column_of_row()[row];
    if (column < 0) {
      cost += kUnassigned;
      continue;
    }
    EXPECT_EQ(solved.row_of_column()[static_cast<std::size_t>(column)], static_cast<int>(row));
    const auto pair = std::find_if(pairs.begin(), pairs.end(), [&](const AssignmentPair& one) {
      return one.row == static_cast<int>(row) && one.column == column;
    });
    if (pair == pairs.end()) {
      ADD_FAILURE() << "a pair that was not offered";
      continue;
    }
    cost += pair->cost;
  }
  return cost;
}

TEST(Assignment, IsAsCheapAsTheBestOfAllMatchings) {
  RandomStream random{11};
  Assignment assignment;
  for (int round = 0; round < 2000; ++round) {
    const int rows = 1 + static_cast<int>(random.uniform(0.0, 6.0));
    const int columns = 1 + static_cast<int>(random.uniform(0.0, 6.0));
    const double density = random.uniform();
    std::vector<AssignmentPair> pairs;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        if (random.uniform() < density) pairs.push_back({row, column, random.uniform(-5.0, 14.0)});
    assignment.solve(rows, columns, pairs, kUnassigned);
    std::vector<char> taken(static_cast<std::size_t>(columns), 0);
    ASSERT_NEAR(cost_of(assignment, pairs), cheapest(0, rows, taken, pairs), 1e-9) << "round " << round;
  }
}

TEST(Assignment, StaysWithinItsTimeWhenEverythingMayBelongToEverything) {
  std::vector<AssignmentPair> pairs;
  RandomStream random{3};
  for (int row = 0; row < 300; ++row)
    for (int column = 0; column < 300; ++column) pairs.push_back({row, column, random.uniform(0.0, 9.0)});
  Assignment assignment;
  assignment.solve(300, 300, pairs, kUnassigned);
  for (const int column : assignment.column_of_row()) EXPECT_GE(column, 0);
  static_cast<void>(cost_of(assignment, pairs));
}

TEST(Assignment, HandlesNothing) {
  Assignment assignment;
  assignment.solve(0, 0, {}, kUnassigned);
  EXPECT_TRUE(assignment.column_of_row().empty());
  assignment.solve(2, 1, {}, kUnassigned);
  EXPECT_EQ(assignment.column_of_row(), (std::vector<int>{-1, -1}));
}

}  // namespace
}  // namespace spf
