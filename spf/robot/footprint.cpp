#include "spf/robot/footprint.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "spf/math/plane.hpp"
#include "spf/math/polygon.hpp"

namespace spf {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

constexpr double kCoverError = 0.02;  // [1] of the largest disc within
constexpr double kFlat = 1e-9;        // [1] sine: corners that turn less do not turn

/// The corners as they are given, counterclockwise.
Corners corners_of(const RobotParameters& robot) {
  if (robot.footprint.empty()) {
    if (!has_corners(robot)) return {};
    const double x = 0.5 * robot.length;
    const double y = 0.5 * robot.width;
    return {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
  }
  Corners corners = robot.footprint;
  if (signed_area(corners) < 0.0) std::reverse(corners.begin(), corners.end());
  return corners;
}

const Eigen::Vector2d& next_of(const Corners& corners, std::size_t i) {
  return corners[i + 1 < corners.size() ? i + 1 : 0];
}

/// From the centre to the nearest of the lines along the edges of a convex polygon, negative outside.
double depth_of_centre(const Corners& corners) {
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d along = (next_of(corners, i) - corners[i]).normalized();
    depth = std::min(depth, cross(along, Eigen::Vector2d{-corners[i]}));
  }
  return depth;
}

/// The largest disc within a convex polygon that touches its edge `i` at a point of it.
double radius_at(const Corners& corners, std::size_t i, const Eigen::Vector2d& point) {
  const auto inwards = [&](std::size_t edge) {
    const Eigen::Vector2d along = (next_of(corners, edge) - corners[edge]).normalized();
    return Eigen::Vector2d{-along.y(), along.x()};
  };
  const Eigen::Vector2d normal = inwards(i);
  double radius = std::numeric_limits<double>::infinity();
  for (std::size_t other = 0; other < corners.size(); ++other) {
    if (other == i) continue;
    const Eigen::Vector2d across = inwards(other);
    const double depth = std::max(0.0, across.dot(point - corners[other]));
    radius = std::min(radius, depth / (1.0 - normal.dot(across)));
  }
  return radius;
}

std::string text_of(const Eigen::Vector2d& point) {
  std::ostringstream text;
  text << "[" << point.x() << ", " << point.y() << "]";
  return text.str();
}

}  // namespace

std::string footprint_problem(const RobotParameters& robot) {
  if (!robot.footprint.empty() && (robot.length > 0.0 || robot.width > 0.0))
    return "footprint: a robot with corners has no length and width besides; leave out either";
  if (robot.footprint.empty()) {
    if (robot.length > 0.0 && !(robot.width > 0.0)) return "width = 0 [m] must be above 0 where length is";
    if (robot.width > 0.0 && !(robot.length > 0.0)) return "length = 0 [m] must be above 0 where width is";
    return {};
  }
  const std::size_t count = robot.footprint.size();
  if (count < 3 || count > Footprint::kMostCorners)
    return "footprint has " + std::to_string(count) + " corners; it needs 3 to " +
           std::to_string(Footprint::kMostCorners);
  const Corners corners = corners_of(robot);
  double turned = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d& corner = next_of(corners, i);
    const Eigen::Vector2d before = corner - corners[i];
    const Eigen::Vector2d after = next_of(corners, i + 1 < count ? i + 1 : 0) - corner;
    const double turn = std::atan2(cross(before, after), before.dot(after));
    if (!(turn > kFlat)) return "footprint is not convex, or does not turn, at its corner " + text_of(corner);
    turned += turn;
  }
  constexpr double kOnce = 7.0;  // [rad] a little more than a full turn
  if (turned > kOnce) return "footprint crosses itself";
  if (!(depth_of_centre(corners) > 0.0)) return "footprint does not hold the robot's centre, [0, 0]";
  return {};
}

RobotParameters with_radius_of_footprint(RobotParameters robot) {
  if (has_corners(robot)) robot.radius = Footprint{robot}.circumscribed_radius();
  return robot;
}

Footprint::Footprint(const RobotParameters& robot)
    : inscribed_{robot.radius}, circumscribed_{robot.radius}, half_width_{robot.radius} {
  if (const std::string problem = footprint_problem(robot); !problem.empty())
    throw std::invalid_argument(problem);
  corners_ = corners_of(robot);
  if (corners_.empty()) return;
  inscribed_ = depth_of_centre(corners_);
  circumscribed_ = half_width_ = 0.0;
  for (const Eigen::Vector2d& corner : corners_) {
    circumscribed_ = std::max(circumscribed_, corner.norm());
    half_width_ = std::max(half_width_, std::fabs(corner.y()));
  }
  cover();
}

/// One disc after the other, each the largest that touches the outline where it is covered worst.
void Footprint::cover() {
  constexpr int kSamples = 64;  // of an edge
  constexpr std::size_t kMostDiscs = 80;
  struct Sample {
    Eigen::Vector2d point;
    Eigen::Vector2d centre;  // of the largest disc that touches there
    double radius;
    double uncovered;
  };
  std::vector<Sample> samples;
  double largest = 0.0;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Eigen::Vector2d edge = next_of(corners_, i) - corners_[i];
    const Eigen::Vector2d inwards = Eigen::Vector2d{-edge.y(), edge.x()}.normalized();
    for (int k = 0; k < kSamples; ++k) {
      const Eigen::Vector2d point = corners_[i] + edge * k / kSamples;
      const double radius = radius_at(corners_, i, point);
      samples.push_back({point, point + radius * inwards, radius, std::numeric_limits<double>::infinity()});
      largest = std::max(largest, radius);
    }
  }
  // The largest disc first: at the beginning all points are covered equally badly.
  const auto larger = [](const Sample& a, const Sample& b) { return a.radius < b.radius; };
  const auto worse = [](const Sample& a, const Sample& b) { return a.uncovered < b.uncovered; };
  auto worst = std::max_element(samples.begin(), samples.end(), larger);
  while (cover_.size() < kMostDiscs && worst->uncovered > kCoverError * largest) {
    const Disc disc{worst->centre, worst->radius, worst->centre.norm() + worst->radius};
    cover_.push_back(disc);
    for (Sample& sample : samples)
      sample.uncovered = std::min(sample.uncovered, (sample.point - disc.centre).norm() - disc.radius);
    worst = std::max_element(samples.begin(), samples.end(), worse);
  }
  cover_error_ = std::max(0.0, worst->uncovered);
  for (Disc& disc : cover_) {
    disc.radius += cover_error_;
    disc.reach += cover_error_;
  }
  std::sort(cover_.begin(), cover_.end(), [](const Disc& a, const Disc& b) { return a.reach > b.reach; });
}

ConvexPolygon Footprint::placed(const Eigen::Vector2d& position, double heading) const {
  const Eigen::Vector2d ahead{std::cos(heading), std::sin(heading)};
  const Eigen::Vector2d left{-ahead.y(), ahead.x()};
  ConvexPolygon polygon;
  for (const Eigen::Vector2d& corner : corners_)
    polygon.add(position + corner.x() * ahead + corner.y() * left);
  return polygon;
}

double Footprint::distance_to(const Eigen::Vector2d& point_body) const {
  return is_disc() ? point_body.norm() - circumscribed_ : signed_distance_to_polygon(point_body, corners_);
}

}  // namespace spf
