#include "spf/math/shared.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace spf {
namespace {

struct Whole {
  std::vector<int> part{1, 2, 3};
  std::string name = "whole";
};

TEST(Shared, CopiesStandForTheSameValueInMemory) {
  const Shared<std::string> one = std::string{"said"};
  const Shared<std::string> other = one;
  EXPECT_EQ(&*one, &*other);
  EXPECT_EQ(*other, "said");
  EXPECT_EQ(other->size(), 4U);
  const std::string& plain = other;
  EXPECT_EQ(&plain, &*one);
}

TEST(Shared, AssigningToOneLeavesTheOthersAsTheyWere) {
  Shared<int> one = 1;
  const Shared<int> other = one;
  one = 2;
  EXPECT_EQ(*one, 2);
  EXPECT_EQ(*other, 1);
}

TEST(Shared, APartKeepsTheWholeAlive) {
  std::optional<Shared<Whole>> whole{Whole{}};
  const Shared<std::vector<int>> part{*whole, (*whole)->part};
  EXPECT_EQ(&*part, &(*whole)->part);
  whole.reset();
  EXPECT_EQ(*part, (std::vector<int>{1, 2, 3}));
}

}  // namespace
}  // namespace spf
