#include "sim/uniform_grid.hpp"

namespace spf::sim {

UniformGrid::Cell UniformGrid::cell_of(const Eigen::Vector2d& point) const {
  // Clamped so that a far or infinite position still has a cell (2^31 cells from the origin).
  const auto coordinate = [this](double value) {
    return static_cast<std::int64_t>(std::clamp(std::floor(value * inverse_size_), -0x1p31, 0x1p31));
  };
  return {coordinate(point.x()), coordinate(point.y())};
}

std::size_t UniformGrid::bucket_of(const Cell& cell) const {
  const std::uint64_t x = static_cast<std::uint64_t>(cell.x) * 0x9E3779B97F4A7C15ULL;
  const std::uint64_t y = static_cast<std::uint64_t>(cell.y) * 0xC2B2AE3D27D4EB4FULL;
  const std::uint64_t hash = x ^ (y << 1U);
  return static_cast<std::size_t>(hash ^ (hash >> 29U)) & bucket_mask_;
}

void UniformGrid::assign(const std::vector<Eigen::Vector2d>& points) {
  std::size_t buckets = 16;
  while (buckets < 2 * points.size()) buckets *= 2;
  bucket_mask_ = buckets - 1;
  cells_.clear();
  bucket_begin_.assign(buckets + 1, 0);
  for (const Eigen::Vector2d& point : points) {
    cells_.push_back(cell_of(point));
    ++bucket_begin_[bucket_of(cells_.back()) + 1];
  }
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) bucket_begin_[bucket + 1] += bucket_begin_[bucket];
  order_.resize(points.size());
  // Filled from the back, which leaves bucket_begin_ where it was after the second pass.
  for (std::size_t i = points.size(); i-- > 0;) order_[--bucket_begin_[bucket_of(cells_[i]) + 1]] = i;
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) bucket_begin_[bucket] = bucket_begin_[bucket + 1];
  bucket_begin_[buckets] = points.size();
}

}  // namespace spf::sim
