#include "spf/world/polygon_distances.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "spf/math/polygon.hpp"
#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

/// A star with spikes of any length about a point: it never crosses itself.
std::vector<Eigen::Vector2d> draw_star(RandomStream& random, double size) {
  const int spikes = 3 + static_cast<int>(12.0 * random.uniform());
  const Eigen::Vector2d middle{random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0)};
  std::vector<Eigen::Vector2d> corners;
  for (int k = 0; k < spikes; ++k) {
    const double angle = 6.283185307179586 * k / spikes;
    corners.push_back(middle + random.uniform(0.2, size) * Eigen::Vector2d{std::cos(angle), std::sin(angle)});
  }
  return corners;
}

TEST(PolygonDistances, AreThoseOfThePolygonUpToTheirReach) {
  RandomStream random{31};
  const GridFrame frame = GridFrame::covering({-5.0, -3.0}, {5.0, 3.0}, 0.13);
  constexpr double kReach = 0.8;
  int inside = 0;
  for (int k = 0; k < 60; ++k) {
    const std::vector<Eigen::Vector2d> corners = draw_star(random, k % 3 == 0 ? 500.0 : 4.0);
    const PolygonDistances distances{frame, corners, kReach};
    for (int j = 0; j < frame.height; ++j)
      for (int i = 0; i < frame.width; ++i) {
        const double exact = signed_distance_to_polygon(frame.node_position(i, j), corners);
        const bool covered = i >= distances.low().x() && i <= distances.high().x() &&
                             j >= distances.low().y() && j <= distances.high().y();
        if (!covered) {
          ASSERT_GT(exact, kReach) << k;
          continue;
        }
        ASSERT_NEAR(distances.at(i, j), std::clamp(exact, -kReach, kReach), 1e-5)
            << k << ": " << i << ", " << j;
        inside += exact < 0.0 ? 1 : 0;
      }
  }
  EXPECT_GT(inside, 1000);
}

}  // namespace
}  // namespace spf
