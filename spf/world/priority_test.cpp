#include "spf/world/priority.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace spf {
namespace {

TEST(Priority, TheSmallerNumberGoesFirstAndAmongEqualsTheSmallerRobot) {
  EXPECT_TRUE(goes_first({0, 3}, {0, 4}));
  EXPECT_FALSE(goes_first({0, 4}, {0, 3}));
  EXPECT_TRUE(goes_first({1, 9}, {2, 3}));
  EXPECT_FALSE(goes_first({2, 3}, {1, 9}));
}

TEST(Priority, OfTwoRobotsOneGoesFirst) {
  std::vector<Rank> ranks;
  for (const int priority : {-1, 0, 0, 7})
    for (const int robot : {0, 1, 2}) ranks.push_back({priority, robot});
  for (const Rank& a : ranks) {
    for (const Rank& b : ranks) {
      const bool same = a.priority == b.priority && a.robot_id == b.robot_id;
      EXPECT_EQ(goes_first(a, b) + goes_first(b, a), same ? 0 : 1);
      for (const Rank& c : ranks) EXPECT_TRUE(goes_first(a, c) || !goes_first(a, b) || !goes_first(b, c));
    }
  }
}

}  // namespace
}  // namespace spf
