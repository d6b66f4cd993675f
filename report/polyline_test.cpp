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

TEST(Polyline, KeepsTheExtremesOfEveryColumn) {
  const std::vector<ReplayPoint> points{{0.0, 0.0}, {0.2, 5.0}, {0.4, 1.0},  {0.6, -3.0},
                                        {0.9, 0.0}, {1.0, 2.0}, {2.5, -1.0}, {2.6, -1.0}};
  const std::vector<ReplayPoint> kept = column_extremes(points, 1.0);
  std::vector<double> xs;
  for (const ReplayPoint& p : kept) xs.push_back(p.x);
  EXPECT_EQ(xs, (std::vector<double>{0.0, 0.2, 0.6, 0.9, 1.0, 2.5, 2.6}));
  EXPECT_TRUE(column_extremes({}, 1.0).empty());
}

TEST(Polyline, WritesPathsAsWholeStepsFromPointToPoint) {
  EXPECT_EQ(path_data({{{10.4, 20.0}, {12.0, 17.0}, {12.0, 18.6}}, {}, {{5.0, 1.0}}}, ""),
            "m10 20l2-3 0 2m-7-18");
  EXPECT_EQ(path_data({{{10.0, 20.0}, {8.0, 21.0}}}, "h0"), "m10 20h0m-2 1h0");
  EXPECT_EQ(path_data({{}}, ""), "");
}

}  // namespace
}  // namespace spf
