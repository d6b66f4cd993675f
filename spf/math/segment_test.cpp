#include "spf/math/segment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

Eigen::Vector2d at(const LineSegment& segment, double share) {
  return segment.from + share * (segment.to - segment.from);
}

LineSegment drawn(RandomStream& random) {
  return {{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)},
          {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)}};
}

TEST(LineSegment, NearestPointIsThatOfAFineWalk) {
  RandomStream random{3};
  for (int k = 0; k < 200; ++k) {
    const LineSegment segment = drawn(random);
    const Eigen::Vector2d point{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 1000; ++i) nearest = std::min(nearest, (point - at(segment, i / 1000.0)).norm());
    EXPECT_NEAR(distance_to_segment(point, segment), nearest, 2e-3);
    EXPECT_LE(distance_to_segment(point, segment), nearest + 1e-12);
    const double share = share_along(point, segment);
    EXPECT_TRUE(nearest_on_segment(point, segment).isApprox(at(segment, share), 1e-12));
  }
}

TEST(LineSegment, OfNoLengthIsAPoint) {
  const LineSegment segment{{1.0, 2.0}, {1.0, 2.0}};
  EXPECT_EQ(share_along({4.0, 6.0}, segment), 0.0);
  EXPECT_DOUBLE_EQ(distance_to_segment({4.0, 6.0}, segment), 5.0);
  EXPECT_FALSE(segments_cross(segment, {{0.0, 0.0}, {3.0, 0.0}}));
  EXPECT_TRUE(segments_cross(segment, {{0.0, 2.0}, {3.0, 2.0}}));
}

TEST(LineSegment, DistanceBetweenTwoIsThatOfAWalkAlongOne) {
  RandomStream random{4};
  int crossings = 0;
  for (int k = 0; k < 300; ++k) {
    const LineSegment a = drawn(random);
    const LineSegment b = drawn(random);
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 2000; ++i) nearest = std::min(nearest, distance_to_segment(at(a, i / 2000.0), b));
    EXPECT_NEAR(distance_between_segments(a, b), nearest, 2e-3);
    EXPECT_EQ(distance_between_segments(a, b), distance_between_segments(b, a));
    if (segments_cross(a, b)) ++crossings;
  }
  EXPECT_GT(crossings, 30);
  EXPECT_LT(crossings, 270);
}

TEST(LineSegment, CrossesWhereItTouches) {
  const LineSegment level{{0.0, 0.0}, {2.0, 0.0}};
  EXPECT_TRUE(segments_cross(level, {{1.0, 0.0}, {1.0, 1.0}}));   // an end on it
  EXPECT_TRUE(segments_cross(level, {{2.0, 0.0}, {3.0, 0.0}}));   // end to end
  EXPECT_FALSE(segments_cross(level, {{2.1, 0.0}, {3.0, 0.0}}));  // on one line, apart
  EXPECT_FALSE(segments_cross(level, {{1.0, 0.1}, {1.0, 1.0}}));
  EXPECT_DOUBLE_EQ(distance_between_segments(level, {{0.0, 0.5}, {2.0, 0.5}}), 0.5);
}

}  // namespace
}  // namespace spf
