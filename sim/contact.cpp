#include "sim/contact.hpp"

#include <algorithm>
#include <cmath>

#include "sim/body.hpp"
#include "sim/geometry.hpp"

namespace spf::sim {
namespace {

constexpr double kCell = 4.0;  // [m] of the grid of shapes

/// Share of a step at which a convex function of it first falls below `limit`; `at(share)` must do so
/// somewhere. The least value is found by golden section, the crossing before it by bisection.
template <class Function>
double first_below(const Function& at, double limit) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kIterations = 50;  // 0.618^50 = 4e-11 of a step
  if (at(0.0) < limit) return 0.0;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < kIterations; ++i) {
    const double left = high - kGolden * (high - low);
    const double right = low + kGolden * (high - low);
    if (at(left) <= at(right))
      high = right;
    else
      low = left;
  }
  double outside = 0.0;
  double inside = 0.5 * (low + high);
  if (at(1.0) < at(inside)) inside = 1.0;
  for (int i = 0; i < kIterations; ++i) {
    const double middle = 0.5 * (outside + inside);
    (at(middle) < limit ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

double swept_distance(const Motion& a, const Motion& b) {
  return distance_to_segment(Eigen::Vector2d::Zero(), {a.from - b.from, a.to - b.to});
}

std::optional<double> first_within(const Motion& a, const Motion& b, double distance) {
  // |offset + share * drift| = distance, the smaller root.
  const Eigen::Vector2d offset = a.from - b.from;
  const Eigen::Vector2d drift = (a.to - b.to) - offset;
  const double outside = offset.squaredNorm() - distance * distance;
  if (outside < 0.0) return 0.0;
  const double approach = -offset.dot(drift);
  const double squared_drift = drift.squaredNorm();
  const double discriminant = approach * approach - squared_drift * outside;
  if (approach <= 0.0 || discriminant <= 0.0) return std::nullopt;
  const double share = outside / (approach + std::sqrt(discriminant));  // stable form of the smaller root
  return share < 1.0 ? std::optional<double>{share} : std::nullopt;
}

StaticShapes::StaticShapes(const Scenario& scenario)
    : border_{scenario.border},
      boxes_{scenario.boxes},
      discs_{scenario.discs},
      walls_{scenario.walls},
      grid_{kCell},
      outlines_{scenario} {
  const auto add = [this](ContactWith kind, std::size_t index, const Eigen::Vector2d& center, double reach) {
    shapes_.push_back({kind, static_cast<int>(index)});
    centers_.push_back(center);
    reach_ = std::max(reach_, reach);
  };
  for (std::size_t i = 0; i < boxes_.size(); ++i)
    add(ContactWith::box, i, 0.5 * (boxes_[i].low + boxes_[i].high),
        0.5 * (boxes_[i].high - boxes_[i].low).norm());
  for (std::size_t i = 0; i < discs_.size(); ++i)
    add(ContactWith::disc, i, discs_[i].center, discs_[i].radius);
  for (std::size_t i = 0; i < walls_.size(); ++i)
    add(ContactWith::wall, i, 0.5 * (walls_[i].from + walls_[i].to),
        0.5 * (walls_[i].to - walls_[i].from).norm());
  grid_.assign(centers_);
}

double StaticShapes::distance_to(const Shape& shape, const Eigen::Vector2d& position) const {
  const auto index = static_cast<std::size_t>(shape.index);
  if (shape.kind == ContactWith::box) return distance_to_box(position, boxes_[index]);
  if (shape.kind == ContactWith::disc) return (position - discs_[index].center).norm() - discs_[index].radius;
  return distance_to_segment(position, walls_[index]);
}

double StaticShapes::swept_distance_to(const Shape& shape, const Motion& motion) const {
  const auto index = static_cast<std::size_t>(shape.index);
  const Segment path{motion.from, motion.to};
  if (shape.kind == ContactWith::box) return distance_between(path, boxes_[index]);
  if (shape.kind == ContactWith::disc)
    return distance_to_segment(discs_[index].center, path) - discs_[index].radius;
  return distance_between_segments(path, walls_[index]);
}

double StaticShapes::clearance(const Eigen::Vector2d& position_world, double radius, double far) const {
  double nearest = far + radius;
  if (border_) nearest = std::min(nearest, depth_inside(position_world, *border_));
  grid_.visit(position_world, std::max(nearest, 0.0) + reach_, [&](int shape) {
    nearest = std::min(nearest, distance_to(shapes_[static_cast<std::size_t>(shape)], position_world));
  });
  outlines_.visit(position_world, std::max(nearest, 0.0), [&](const Outlines::Piece& piece) {
    nearest = std::min(nearest, distance_to_segment(position_world, piece.segment));
  });
  return nearest - radius;
}

std::optional<Contact> StaticShapes::first_contact(const Motion& motion, double radius) const {
  std::optional<Contact> first;
  const auto consider = [&](double share, ContactWith kind, int index) {
    if (first && first->time <= share) return;
    first = Contact{};
    first->time = share;
    first->with = kind;
    first->other = index;
    first->position_world = motion.at(share);
  };
  // Depth inside the border is concave along a line, so its least value is at an end.
  if (border_ && std::min(depth_inside(motion.from, *border_), depth_inside(motion.to, *border_)) < radius)
    consider(first_below([&](double share) { return depth_inside(motion.at(share), *border_); }, radius),
             ContactWith::border, -1);
  const Eigen::Vector2d middle = 0.5 * (motion.from + motion.to);
  const double near = radius + 0.5 * (motion.to - motion.from).norm();
  grid_.visit(middle, reach_ + near, [&](int number) {
    const Shape& shape = shapes_[static_cast<std::size_t>(number)];
    if (swept_distance_to(shape, motion) >= radius) return;
    consider(first_below([&](double share) { return distance_to(shape, motion.at(share)); }, radius),
             shape.kind, shape.index);
  });
  const Segment path{motion.from, motion.to};
  outlines_.visit(middle, near, [&](const Outlines::Piece& piece) {
    if (distance_between_segments(path, piece.segment) >= radius) return;
    const auto distance = [&](double share) { return distance_to_segment(motion.at(share), piece.segment); };
    consider(first_below(distance, radius), piece.polygon < 0 ? ContactWith::map : ContactWith::polygon,
             piece.polygon);
  });
  return first;
}

double StaticShapes::distance_to(const Shape& shape, const ConvexPolygon& outline) const {
  const auto index = static_cast<std::size_t>(shape.index);
  if (shape.kind == ContactWith::box) return outline.distance_to(polygon_of(boxes_[index]));
  if (shape.kind == ContactWith::disc)
    return outline.distance_to(discs_[index].center) - discs_[index].radius;
  return outline.distance_to(walls_[index]);
}

double StaticShapes::clearance(const ConvexPolygon& outline, const Eigen::Vector2d& centre, double radius,
                               double far) const {
  double nearest = far;
  if (border_) nearest = std::min(nearest, depth_inside(outline, *border_));
  grid_.visit(centre, std::max(nearest, 0.0) + radius + reach_, [&](int shape) {
    nearest = std::min(nearest, distance_to(shapes_[static_cast<std::size_t>(shape)], outline));
  });
  outlines_.visit(centre, std::max(nearest, 0.0) + radius, [&](const Outlines::Piece& piece) {
    nearest = std::min(nearest, outline.distance_to(piece.segment));
  });
  return nearest;
}

std::optional<Contact> StaticShapes::first_contact(const BodyMotion& motion) const {
  std::optional<Contact> first;
  const double reach = motion.reach();
  const auto consider = [&](ContactWith kind, int index, const auto& distance) {
    const std::optional<double> share =
        first_touch(reach, [&](double at) { return distance(motion.at(at)); });
    if (!share || (first && first->time <= *share)) return;
    first = Contact{};
    first->time = *share;
    first->with = kind;
    first->other = index;
    first->position_world = motion.centre.at(*share);
  };
  if (border_)
    consider(ContactWith::border, -1,
             [&](const ConvexPolygon& body) { return depth_inside(body, *border_); });
  const double near = motion.outline->circumscribed_radius() + reach;
  grid_.visit(motion.centre.from, reach_ + near, [&](int number) {
    const Shape& shape = shapes_[static_cast<std::size_t>(number)];
    consider(shape.kind, shape.index, [&](const ConvexPolygon& body) { return distance_to(shape, body); });
  });
  outlines_.visit(motion.centre.from, near, [&](const Outlines::Piece& piece) {
    consider(piece.polygon < 0 ? ContactWith::map : ContactWith::polygon, piece.polygon,
             [&](const ConvexPolygon& body) { return body.distance_to(piece.segment); });
  });
  return first;
}

}  // namespace spf::sim
