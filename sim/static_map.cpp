#include "sim/static_map.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace spf::sim {

StaticMap::StaticMap(const Pose2& origin_world, double resolution, std::size_t width, std::size_t height,
                     std::vector<std::int8_t> values)
    : origin_{origin_world},
      resolution_{resolution},
      width_{width},
      height_{height},
      values_{std::move(values)} {
  host::check_cells(cells());
  add_faces(true);
  add_faces(false);
}

Eigen::Vector2d StaticMap::to_world(double column, double row) const {
  const Eigen::Vector2d local = resolution_ * Eigen::Vector2d{column, row};
  if (origin_.heading == 0.0) return origin_.position_world + local;
  return origin_.position_world + Eigen::Rotation2Dd{origin_.heading} * local;
}

bool StaticMap::wall_at(std::ptrdiff_t column, std::ptrdiff_t row) const {
  const bool inside = column >= 0 && row >= 0 && column < static_cast<std::ptrdiff_t>(width_) &&
                      row < static_cast<std::ptrdiff_t>(height_);
  return !inside || host::is_occupied(
                        values_[static_cast<std::size_t>(row) * width_ + static_cast<std::size_t>(column)]);
}

/// Faces between two rows (or columns): straight runs of cells where a wall is on one side alone, always the
/// same one.
void StaticMap::add_faces(bool along_rows) {
  const auto length = static_cast<std::ptrdiff_t>(along_rows ? width_ : height_);
  const auto lines = static_cast<std::ptrdiff_t>(along_rows ? height_ : width_);
  const auto longest = std::max<std::ptrdiff_t>(1, std::lround(kLongestFace / resolution_));
  // 0: no face; 1: a wall before the line; 2: behind it
  const auto side = [&](std::ptrdiff_t along, std::ptrdiff_t line) {
    const bool before = along_rows ? wall_at(along, line - 1) : wall_at(line - 1, along);
    const bool behind = along_rows ? wall_at(along, line) : wall_at(line, along);
    return before == behind ? 0 : (before ? 1 : 2);
  };
  for (std::ptrdiff_t line = 0; line <= lines; ++line) {
    for (std::ptrdiff_t first = 0; first < length;) {
      const int kind = side(first, line);
      std::ptrdiff_t end = first + 1;
      while (end < length && (kind == 0 || end - first < longest) && side(end, line) == kind) ++end;
      if (kind != 0) {
        if (faces_.size() == kMostFaces)
          throw std::invalid_argument("its walls have more than " + std::to_string(kMostFaces) +
                                      " faces: that is noise, to be filtered first");
        const auto from = static_cast<double>(first);
        const auto to = static_cast<double>(end);
        const auto at = static_cast<double>(line);
        faces_.push_back(along_rows ? Segment{to_world(from, at), to_world(to, at)}
                                    : Segment{to_world(at, from), to_world(at, to)});
      }
      first = end;
    }
  }
}

bool StaticMap::occupied(const Eigen::Vector2d& position_world) const {
  const Eigen::Vector2d cell =
      (Eigen::Rotation2Dd{-origin_.heading} * (position_world - origin_.position_world)) / resolution_;
  const Eigen::Vector2d last{static_cast<double>(width_), static_cast<double>(height_)};
  if (!((cell.array() >= 0.0).all() && (cell.array() < last.array()).all())) return true;  // NaN too
  return wall_at(static_cast<std::ptrdiff_t>(cell.x()), static_cast<std::ptrdiff_t>(cell.y()));
}

std::array<Eigen::Vector2d, 4> StaticMap::corners() const {
  const auto columns = static_cast<double>(width_);
  const auto rows = static_cast<double>(height_);
  return {to_world(0.0, 0.0), to_world(columns, 0.0), to_world(columns, rows), to_world(0.0, rows)};
}

}  // namespace spf::sim
