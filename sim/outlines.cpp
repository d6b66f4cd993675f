#include "sim/outlines.hpp"

#include <algorithm>
#include <cmath>

#include "sim/geometry.hpp"

namespace spf::sim {
namespace {

constexpr double kGridCell = 4.0;    // [m]
constexpr double kMostPieces = 1e5;  // of all polygons' sides, but for one more each

double perimeter_of(const Polygon& polygon) {
  double length = 0.0;
  for (std::size_t i = 0, last = polygon.corners.size() - 1; i < polygon.corners.size(); last = i++)
    length += (polygon.corners[i] - polygon.corners[last]).norm();
  return length;
}

/// The sides of a polygon, cut into pieces of at most `longest` [m].
void append_sides(const Polygon& polygon, int index, double longest, std::vector<Outlines::Piece>& pieces) {
  const std::vector<Eigen::Vector2d>& corners = polygon.corners;
  for (std::size_t i = 0, last = corners.size() - 1; i < corners.size(); last = i++) {
    const Eigen::Vector2d along = corners[i] - corners[last];
    const double wanted = std::ceil(along.norm() / longest);
    const int count = wanted >= 1.0 && wanted <= kMostPieces ? static_cast<int>(wanted) : 1;
    for (int k = 0; k < count; ++k) {
      const auto at = [&](int step) -> Eigen::Vector2d {
        if (step == count) return corners[i];
        return corners[last] + along * (static_cast<double>(step) / count);
      };
      pieces.push_back({{at(k), at(k + 1)}, index});
    }
  }
}

}  // namespace

Outlines::Outlines(const Scenario& scenario) : grid_{kGridCell} {
  double perimeter = 0.0;
  for (const Polygon& polygon : scenario.polygons) perimeter += perimeter_of(polygon);
  const double longest = std::max(StaticMap::kLongestFace, perimeter / kMostPieces);
  for (std::size_t i = 0; i < scenario.polygons.size(); ++i)
    append_sides(scenario.polygons[i], static_cast<int>(i), longest, pieces_);
  if (scenario.map)
    for (const Segment& face : scenario.map->faces()) pieces_.push_back({face, -1});
  std::vector<Eigen::Vector2d> middles;
  middles.reserve(pieces_.size());
  for (const Piece& piece : pieces_) {
    middles.push_back(0.5 * (piece.segment.from + piece.segment.to));
    reach_ = std::max(reach_, 0.5 * (piece.segment.to - piece.segment.from).norm());
  }
  grid_.assign(middles);
}

std::optional<Eigen::Vector2d> Outlines::nearest(const Eigen::Vector2d& position_world, double radius) const {
  std::optional<Eigen::Vector2d> found;
  double distance = radius;
  visit(position_world, radius, [&](const Piece& piece) {
    const Eigen::Vector2d point = nearest_on_segment(position_world, piece.segment);
    const double here = (point - position_world).norm();
    if (here >= distance) return;
    distance = here;
    found = point;
  });
  return found;
}

}  // namespace spf::sim
