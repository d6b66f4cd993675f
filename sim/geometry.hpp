// Distances between the simulator's shapes, closed form. Frame: world [m].
#pragma once

#include <Eigen/Core>

#include "sim/scenario.hpp"

namespace spf::sim {

/// From a point to a filled box, 0 inside.
[[nodiscard]] double distance_to_box(const Eigen::Vector2d& point, const Box& box);
/// The smaller of two boxes' Euclidean gap, 0 when they touch or overlap.
[[nodiscard]] double distance_between_boxes(const Box& a, const Box& b);
/// From a segment to a filled box, 0 when it enters.
[[nodiscard]] double distance_between(const Segment& segment, const Box& box);
/// From a point inside the border to its nearest side; negative outside.
[[nodiscard]] double depth_inside(const Eigen::Vector2d& point, const Box& border);
/// A square by centre and side.
[[nodiscard]] Box square(const Eigen::Vector2d& center, double side);

}  // namespace spf::sim
