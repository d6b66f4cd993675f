#include "sim/range_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/body.hpp"
#include "sim/geometry.hpp"
#include "spf/math/angles.hpp"
#include "spf/math/plane.hpp"

namespace spf::sim {
namespace {

constexpr double kNoReturn = std::numeric_limits<double>::infinity();

void append_sides(const Box& box, std::vector<Segment>& segments) {
  const Eigen::Vector2d upper_left{box.low.x(), box.high.y()};
  const Eigen::Vector2d lower_right{box.high.x(), box.low.y()};
  segments.push_back({box.low, lower_right});
  segments.push_back({lower_right, box.high});
  segments.push_back({box.high, upper_left});
  segments.push_back({upper_left, box.low});
}

}  // namespace

/// The sweep in progress; angles of beams in world.
struct RangeSensor::Sweep {
  Eigen::Vector2d origin;
  double first_angle;  // [rad] of beam 0, in world
  double increment;    // [rad]
  std::vector<double>& ranges;

  /// Calls visit(range, direction) for every beam in the arc [from, from + span], span >= 0, and for one more
  /// on either side, so that rounding loses none: the exact test follows.
  template <class Visit>
  void visit_arc(double from, double span, Visit&& visit) {
    const auto count = static_cast<long>(ranges.size());
    const double turn = 2.0 * kPi;
    const double start = from - first_angle - turn * std::floor((from - first_angle) / turn);  // in [0, turn)
    long next = 0;
    // The arc may begin before the first beam, a turn earlier; no beam twice.
    for (const double begin : {start - turn, start}) {
      const long low = static_cast<long>(std::floor(begin / increment)) - 1;
      const long high = static_cast<long>(std::ceil((begin + span) / increment)) + 1;
      for (long beam = std::max(low, next); beam <= std::min(high, count - 1); ++beam) {
        const double angle = first_angle + static_cast<double>(beam) * increment;
        visit(ranges[static_cast<std::size_t>(beam)], Eigen::Vector2d{std::cos(angle), std::sin(angle)});
        next = beam + 1;
      }
    }
  }
};

RangeSensor::RangeSensor(const Scenario& scenario)
    : beams_{scenario.simulation.sensing.beams},
      field_of_view_{scenario.simulation.sensing.field_of_view / 360.0 * (2.0 * kPi)},
      range_{scenario.simulation.sensing.range},
      segments_{scenario.walls},
      discs_{scenario.discs},
      outlines_{scenario} {
  for (const Box& box : scenario.boxes) append_sides(box, segments_);
  if (scenario.border) append_sides(*scenario.border, segments_);
}

void RangeSensor::sweep(const Pose2& pose_world, const std::vector<SeenDisc>& discs, RangeScan& scan) const {
  scan.angle_min = -0.5 * field_of_view_;
  scan.angle_increment = field_of_view_ / beams_;
  scan.max_range = range_;
  scan.ranges.assign(static_cast<std::size_t>(beams_), kNoReturn);
  Sweep sweep{pose_world.position_world, pose_world.heading + scan.angle_min, scan.angle_increment,
              scan.ranges};
  for (const Segment& segment : segments_) cast_segment(segment, sweep);
  outlines_.visit(pose_world.position_world, range_,
                  [&](const Outlines::Piece& piece) { cast_segment(piece.segment, sweep); });
  for (const Disc& disc : discs_) cast_disc(disc.center, disc.radius, sweep);
  for (const SeenDisc& disc : discs) {
    if (disc.outline == nullptr) {
      cast_disc(disc.position_world, disc.radius, sweep);
      continue;
    }
    const ConvexPolygon body = disc.outline->placed(disc.position_world, disc.heading);
    for (std::size_t i = 0; i < body.size(); ++i) cast_segment(body.edge(i), sweep);
  }
}

bool RangeSensor::sees(const Eigen::Vector2d& from_world, const SeenDisc& target,
                       const std::vector<SeenDisc>& discs) const {
  constexpr double kWithin = 0.99;  // of the radius: a line to the outline itself would only touch the disc
  const Eigen::Vector2d offset = from_world - target.position_world;
  const double distance = offset.norm();
  if (distance <= target.radius) return true;
  const Eigen::Vector2d towards = offset / distance;
  const Eigen::Vector2d beside{-towards.y(), towards.x()};
  const double cosine = target.radius / distance;  // of the angle between the nearest and a tangent point
  const double sine = std::sqrt(1.0 - cosine * cosine);
  for (const Eigen::Vector2d& outward :
       {Eigen::Vector2d{towards}, Eigen::Vector2d{cosine * towards + sine * beside},
        Eigen::Vector2d{cosine * towards - sine * beside}})
    if (line_clear({from_world, target.position_world + kWithin * target.radius * outward}, target, discs))
      return true;
  return false;
}

bool RangeSensor::line_clear(const Segment& line, const SeenDisc& target,
                             const std::vector<SeenDisc>& discs) const {
  for (const Segment& segment : segments_)
    if (segments_cross(line, segment)) return false;
  bool blocked = false;
  outlines_.visit(
      0.5 * (line.from + line.to), 0.5 * (line.to - line.from).norm(),
      [&](const Outlines::Piece& piece) { blocked = blocked || segments_cross(line, piece.segment); });
  if (blocked) return false;
  for (const Disc& disc : discs_)
    if (distance_to_segment(disc.center, line) < disc.radius) return false;
  for (const SeenDisc& disc : discs) {
    const bool itself = disc.position_world == target.position_world && disc.radius == target.radius;
    if (itself || distance_to_segment(disc.position_world, line) >= disc.radius) continue;
    if (disc.outline == nullptr) return false;
    const ConvexPolygon body = disc.outline->placed(disc.position_world, disc.heading);
    if (!(body.distance_to(line) > 0.0)) return false;
  }
  return true;
}

void RangeSensor::cast_segment(const Segment& segment, Sweep& sweep) const {
  if (distance_to_segment(sweep.origin, segment) > range_) return;
  const Eigen::Vector2d from = segment.from - sweep.origin;
  const Eigen::Vector2d to = segment.to - sweep.origin;
  const double turn = std::atan2(cross(from, to), from.dot(to));  // less than half a turn
  const Eigen::Vector2d& first = turn >= 0.0 ? from : to;
  const Eigen::Vector2d along = segment.to - segment.from;
  sweep.visit_arc(std::atan2(first.y(), first.x()), std::abs(turn),
                  [&](double& range, const Eigen::Vector2d& beam) {
                    // origin + s beam = segment.from + share * along
                    const double denominator = cross(beam, along);
                    if (denominator == 0.0) return;  // parallel: the neighbouring sides or beams see it
                    const double distance = cross(from, along) / denominator;
                    const double share = cross(from, beam) / denominator;
                    if (distance >= 0.0 && distance <= range_ && share >= 0.0 && share <= 1.0)
                      range = std::min(range, distance);
                  });
}

void RangeSensor::cast_disc(const Eigen::Vector2d& center, double radius, Sweep& sweep) const {
  const Eigen::Vector2d offset = center - sweep.origin;
  const double distance = offset.norm();
  if (distance - radius > range_) return;
  const bool inside = distance <= radius;
  const double half_span = inside ? kPi : std::asin(radius / distance);
  const double middle = distance > 0.0 ? std::atan2(offset.y(), offset.x()) : 0.0;
  sweep.visit_arc(middle - half_span, 2.0 * half_span, [&](double& range, const Eigen::Vector2d& beam) {
    const double along = offset.dot(beam);
    const double aside = cross(beam, offset);
    const double squared_half_chord = radius * radius - aside * aside;
    if (squared_half_chord < 0.0) return;
    const double half_chord = std::sqrt(squared_half_chord);
    const double hit = inside ? along + half_chord : along - half_chord;
    if (hit >= 0.0 && hit <= range_) range = std::min(range, hit);
  });
}

}  // namespace spf::sim
