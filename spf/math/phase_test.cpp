#include "spf/math/phase.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace spf {
namespace {

TEST(Phase, IsAShareOfThePeriod) {
  EXPECT_EQ(phase_of(0), 0.0);
  for (const int number : {1, 2, 77, 1000003, std::numeric_limits<int>::max(), -1}) {
    SCOPED_TRACE(number);
    EXPECT_GE(phase_of(number), 0.0);
    EXPECT_LT(phase_of(number), 1.0);
  }
}

TEST(Phase, NumbersInARowAreFarApart) {
  for (const std::size_t count : {2U, 5U, 12U, 100U}) {
    for (const int first : {0, 1, 7, 1000, 1000000}) {
      SCOPED_TRACE(first);
      std::vector<double> phases;
      for (std::size_t i = 0; i < count; ++i) phases.push_back(phase_of(first + static_cast<int>(i)));
      std::sort(phases.begin(), phases.end());
      phases.push_back(phases.front() + 1.0);
      for (std::size_t i = 0; i < count; ++i)
        EXPECT_GT(phases[i + 1] - phases[i], 0.38 / static_cast<double>(count));
    }
  }
}

}  // namespace
}  // namespace spf
