#include "report/polyline.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spf {
namespace {

/// Where linear interpolation of the kept points puts the robot at this time.
ReplayPoint interpolated(const std::vector<ReplayTimedPoint>& points, double time) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (time > points[i].time) continue;
    const double share = (time - points[i - 1].time) / (points[i].time - points[i - 1].time);
    return {points[i - 1].x + share * (points[i].x - points[i - 1].x),
            points[i - 1].y + share * (points[i].y - points[i - 1].y)};
  }
  return {points.back().x, points.back().y};
}

TEST(Polyline, ThinnedTimedLineStaysWithinTheToleranceAtEveryTime) {
  std::vector<ReplayTimedPoint> points;
  for (int i = 0; i <= 400; ++i) {
    const double t = 0.01 * i;
    points.push_back({t, t * t * 0.25, std::sin(2.0 * t)});
  }
  const std::vector<ReplayTimedPoint> kept = thinned(points, 0.01);
  EXPECT_LT(kept.size(), 40U);
  for (const ReplayTimedPoint& p : points) {
    const ReplayPoint there = interpolated(kept, p.time);
    EXPECT_LE(std::hypot(there.x - p.x, there.y - p.y), 0.01 + 1e-12);  // rounding of the interpolation
  }
}

TEST(Polyline, KeepsAStopThatTheShapeAloneWouldLose) {
  // A straight line, but the robot stands for a second in the middle.
  const std::vector<ReplayTimedPoint> points{
      {0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {1.5, 1.0, 0.0}, {2.0, 1.0, 0.0}, {3.0, 2.0, 0.0}};
  EXPECT_EQ(thinned(points, 0.01).size(), 4U);
  std::vector<ReplayPoint> shape;
  for (const ReplayTimedPoint& p : points) shape.push_back({p.x, p.y});
  EXPECT_EQ(thinned(shape, 0.01).size(), 2U);
}

TEST(Polyline, KeepsTheEndsOfAClosedLineAndShortLines) {
  const std::vector<ReplayPoint> loop{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 0.0}};
  EXPECT_EQ(thinned(loop, 0.01).size(), 4U);
  EXPECT_EQ(thinned(std::vector<ReplayPoint>{}, 0.01).size(), 0U);
  EXPECT_EQ(thinned(std::vector<ReplayPoint>{{1.0, 1.0}}, 0.01).size(), 1U);
}

}  // namespace
}  // namespace spf
