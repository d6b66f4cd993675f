#include "config/closest_name.hpp"

#include <gtest/gtest.h>

namespace spf {
namespace {

TEST(EditDistance, CountsEdits) {
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("level", "levle"), 1u);  // one swap of neighbours
  EXPECT_EQ(edit_distance("range", "range"), 0u);
}

TEST(ClosestName, FindsWhatWasMeant) {
  const std::vector<std::string> known{"level", "model", "speed_limit", "scale"};
  EXPECT_EQ(closest_name("levl", known), "level");
  EXPECT_EQ(closest_name("sped_limits", known), "speed_limit");
  EXPECT_EQ(closest_name("speed", known), "speed_limit");  // the one that begins so
}

TEST(ClosestName, DoesNotGuessWildly) {
  const std::vector<std::string> known{"level", "model", "speed_limit", "speed_low"};
  EXPECT_EQ(closest_name("banana", known), std::nullopt);
  EXPECT_EQ(closest_name("speed", known), std::nullopt);  // two begin so
  EXPECT_EQ(closest_name("", known), std::nullopt);
  EXPECT_EQ(closest_name(std::string(100000, 'x'), known), std::nullopt);
}

}  // namespace
}  // namespace spf
