#include "spf/world/sensed_layer.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/plane.hpp"

namespace spf {
namespace {

// Beliefs about a cell, as in the base planner ES2 [1].
constexpr double kHitProbability = 0.65;      // a return in a cell argues for "occupied" with this weight
constexpr double kMissProbability = 0.35;     // a beam through a cell argues for "free"
constexpr double kLowestProbability = 0.12;   // belief is kept above, so that new obstacles are believed soon
constexpr double kHighestProbability = 0.90;  // and below, so that vanished obstacles are let go soon
constexpr double kOccupiedProbability = 0.80;  // from here on a cell is an obstacle
constexpr double kLogOddsUnit = 4096.0;        // steps per unit of log odds; |log odds| <= 4.6 fits 16 bits

std::int16_t quantised_log_odds(double probability) {
  return static_cast<std::int16_t>(std::lround(kLogOddsUnit * std::log(probability / (1.0 - probability))));
}

/// Whether the surface that beams `index` and `other` have met runs through a point: within `tolerance` of
/// the line through both returns, and along it not farther than twice their distance from each other.
bool interpolated_by_pair(const Eigen::Vector2d& from_sensor, const std::vector<SensedBeam>& beams,
                          std::size_t index, std::size_t other, double tolerance) {
  if (other >= beams.size() || !beams[index].returned || !beams[other].returned) return false;
  const Eigen::Vector2d end = beams[index].length * beams[index].direction_world;
  const Eigen::Vector2d along = beams[other].length * beams[other].direction_world - end;
  const Eigen::Vector2d to_point = from_sensor - end;
  const double beside = cross(to_point, along);
  return std::fabs(beside) < tolerance * along.norm() && to_point.norm() < 2.0 * along.norm();
}

/// A beam contradicts a hit point when it passes close by it and hits another surface farther on: otherwise
/// beams that graze a wall would wear away its cells.
bool contradicts(const Eigen::Vector2d& hit_from_sensor, const std::vector<SensedBeam>& beams,
                 std::size_t index, double resolution) {
  const SensedBeam& beam = beams[index];
  const double along = hit_from_sensor.dot(beam.direction_world);
  const double beside = cross(hit_from_sensor, beam.direction_world);
  if (std::fabs(beside) > 0.125 * resolution || beam.length < along + resolution) return false;
  // index - 1 of the first beam wraps to a number past the end.
  return !interpolated_by_pair(hit_from_sensor, beams, index, index + 1, 0.5 * resolution) &&
         !interpolated_by_pair(hit_from_sensor, beams, index, index - 1, 0.5 * resolution);
}

}  // namespace

SensedLayer::SensedLayer(const GridFrame& frame, double max_distance)
    : frame_{frame},
      max_distance_{static_cast<float>(max_distance)},
      reach_{static_cast<int>(std::ceil(max_distance / frame.resolution + 0.5))},
      hit_step_{quantised_log_odds(kHitProbability)},
      miss_step_{quantised_log_odds(kMissProbability)},
      lowest_{quantised_log_odds(kLowestProbability)},
      highest_{quantised_log_odds(kHighestProbability)},
      occupied_from_{quantised_log_odds(kOccupiedProbability)},
      tiles_across_{(frame.width + kTileSide - 1) >> kTileBits} {
  const int tiles_up = (frame.height + kTileSide - 1) >> kTileBits;
  tile_of_.assign(static_cast<std::size_t>(tiles_across_) * static_cast<std::size_t>(tiles_up), -1);
}

bool SensedLayer::integrate(const Eigen::Vector2d& sensor_world, const std::vector<SensedBeam>& beams) {
  begin_sweep();
  for (const SensedBeam& beam : beams) {
    if (beam.marks) enter_return(sensor_world + beam.length * beam.direction_world);
  }
  for (std::size_t k = 0; k < beams.size(); ++k) cross_cells(sensor_world, beams, k);
  forget(vanished_);
  for (const Hit& hit : appeared_) stamp(hit);
  return !vanished_.empty() || !appeared_.empty();
}

void SensedLayer::enter_surfaces(const std::vector<Eigen::Vector2d>& points_world) {
  int log_odds = 0;
  do {
    begin_sweep();
    for (const Eigen::Vector2d& point : points_world) enter_return(point);
    for (const Hit& hit : appeared_) stamp(hit);
    log_odds += hit_step_;
  } while (log_odds < occupied_from_);
}

void SensedLayer::begin_sweep() {
  appeared_.clear();
  vanished_.clear();
  if (++sweep_ != 0) return;
  for (Tile& tile : tiles_) tile.sweep.fill(0);
  sweep_ = 1;
}

SensedLayer::Tile& SensedLayer::tile_at(int i, int j) {
  std::int32_t& index = tile_of_[tile_slot(i, j)];
  if (index < 0) {
    index = static_cast<std::int32_t>(tiles_.size());
    Tile& fresh = tiles_.emplace_back();
    fresh.first_i = i & ~(kTileSide - 1);
    fresh.first_j = j & ~(kTileSide - 1);
    fresh.distance.fill(max_distance_);
    fresh.log_odds.fill(0);
    fresh.hits.fill(0);
    fresh.sweep.fill(0);
  }
  return tiles_[static_cast<std::size_t>(index)];
}

SensedLayer::NodeWindow SensedLayer::window_around(int i, int j, int reach) const {
  return {std::max(i - reach, 0), std::min(i + reach, frame_.width - 1), std::max(j - reach, 0),
          std::min(j + reach, frame_.height - 1)};
}

SensedLayer::Hit SensedLayer::hit_at(int i, int j, int part) const {
  const auto middle = [this](int along) {
    return static_cast<float>((along + 0.5) / kParts - 0.5) * static_cast<float>(frame_.resolution);
  };
  return {i, j, Eigen::Vector2f{middle(part % kParts), middle(part / kParts)}};
}

/// Calls visit(hit) for some parts of a cell until it returns false.
template <class Visit>
void SensedLayer::for_hits(const Tile& tile, std::size_t slot, std::uint16_t parts,
                           const Visit& visit) const {
  const int i = tile.first_i + static_cast<int>(slot & (kTileSide - 1));
  const int j = tile.first_j + static_cast<int>(slot >> kTileBits);
  for (int part = 0; part < kParts * kParts; ++part)
    if ((parts >> part & 1) != 0 && !visit(hit_at(i, j, part))) return;
}

void SensedLayer::enter_return(const Eigen::Vector2d& end_world) {
  const Eigen::Vector2d scaled = (end_world - frame_.origin_world) / frame_.resolution;
  const int i = static_cast<int>(std::floor(scaled.x() + 0.5));
  const int j = static_cast<int>(std::floor(scaled.y() + 0.5));
  if (!frame_.contains(i, j)) return;
  const auto along = [](double offset) {
    return std::clamp(static_cast<int>((offset + 0.5) * kParts), 0, kParts - 1);
  };
  const int part = along(scaled.x() - i) + kParts * along(scaled.y() - j);
  Tile& tile = tile_at(i, j);
  const std::size_t slot = cell_slot(i, j);
  std::int16_t& log_odds = tile.log_odds[slot];
  std::uint16_t& hits = tile.hits[slot];
  const std::uint16_t before = log_odds > 0 ? hits : std::uint16_t{0};
  const bool was_occupied = log_odds >= occupied_from_;
  // One return of a sweep counts, and all of them say where the surface is.
  if (tile.sweep[slot] != sweep_) {
    tile.sweep[slot] = sweep_;
    log_odds = static_cast<std::int16_t>(std::min<int>(log_odds + hit_step_, highest_));
  }
  hits = static_cast<std::uint16_t>(before | 1U << part);
  if (log_odds < occupied_from_) return;
  if (!was_occupied) ++tile.occupied_cells;
  const auto fresh = static_cast<std::uint16_t>(was_occupied ? hits & ~before : hits);
  for_hits(tile, slot, fresh, [this](const Hit& hit) {
    appeared_.push_back(hit);
    return true;
  });
}

// Visits the cells along the beam in order (Amanatides and Woo); the cell of a return is left out.
void SensedLayer::cross_cells(const Eigen::Vector2d& sensor_world, const std::vector<SensedBeam>& beams,
                              std::size_t index) {
  const SensedBeam& beam = beams[index];
  const Eigen::Vector2d start =
      (sensor_world - frame_.origin_world) / frame_.resolution + Eigen::Vector2d{0.5, 0.5};
  const Eigen::Vector2d end = start + beam.length / frame_.resolution * beam.direction_world;
  Eigen::Vector2i cell{static_cast<int>(std::floor(start.x())), static_cast<int>(std::floor(start.y()))};
  const Eigen::Vector2i last{static_cast<int>(std::floor(end.x())), static_cast<int>(std::floor(end.y()))};
  Eigen::Vector2i step;
  Eigen::Vector2d next;   // beam length in cells at which the next column or row begins
  Eigen::Vector2d pitch;  // beam length in cells from one column or row to the next
  for (int axis = 0; axis < 2; ++axis) {
    const double slope = beam.direction_world[axis];
    step[axis] = slope < 0.0 ? -1 : 1;
    pitch[axis] = std::fabs(1.0 / slope);  // infinite along the other axis
    const double to_border = slope < 0.0 ? start[axis] - cell[axis] : cell[axis] + 1.0 - start[axis];
    next[axis] = slope == 0.0 ? pitch[axis] : to_border * pitch[axis];
  }
  int remaining = std::abs(last.x() - cell.x()) + std::abs(last.y() - cell.y());
  if (beam.returned) --remaining;
  Tile* tile = nullptr;  // of the cell before
  for (; remaining >= 0; --remaining) {
    if (frame_.contains(cell.x(), cell.y())) {
      if (tile == nullptr || tile->first_i != (cell.x() & ~(kTileSide - 1)) ||
          tile->first_j != (cell.y() & ~(kTileSide - 1)))
        tile = &tile_at(cell.x(), cell.y());
      enter_crossing(*tile, cell, sensor_world, beams, index);
    }
    const int axis = next.x() < next.y() ? 0 : 1;
    cell[axis] += step[axis];
    next[axis] += pitch[axis];
  }
}

void SensedLayer::enter_crossing(Tile& tile, const Eigen::Vector2i& cell, const Eigen::Vector2d& sensor_world,
                                 const std::vector<SensedBeam>& beams, std::size_t index) {
  const std::size_t slot = cell_slot(cell.x(), cell.y());
  if (tile.sweep[slot] == sweep_) return;
  std::int16_t& log_odds = tile.log_odds[slot];
  if (log_odds > 0) {
    bool contradicted = false;
    for_hits(tile, slot, tile.hits[slot], [&](const Hit& hit) {
      const Eigen::Vector2d position = frame_.node_position(hit.i, hit.j) + hit.offset.cast<double>();
      contradicted = contradicts(position - sensor_world, beams, index, frame_.resolution);
      return !contradicted;
    });
    if (!contradicted) return;
  }
  tile.sweep[slot] = sweep_;
  const bool was_occupied = log_odds >= occupied_from_;
  const int lowered = std::max<int>(log_odds + miss_step_, lowest_);
  log_odds = static_cast<std::int16_t>(lowered);
  if (!was_occupied || lowered >= occupied_from_) return;
  --tile.occupied_cells;
  for_hits(tile, slot, tile.hits[slot], [this](const Hit& hit) {
    vanished_.push_back(hit);
    return true;
  });
}

void SensedLayer::stamp(const Hit& hit) {
  const NodeWindow window = window_around(hit.i, hit.j, reach_);
  const float resolution = static_cast<float>(frame_.resolution);
  for (int tile_j = window.low_j & ~(kTileSide - 1); tile_j <= window.high_j; tile_j += kTileSide) {
    for (int tile_i = window.low_i & ~(kTileSide - 1); tile_i <= window.high_i; tile_i += kTileSide) {
      Tile& tile = tile_at(tile_i, tile_j);
      const int low_i = std::max(window.low_i, tile_i);
      const int count = std::min(window.high_i, tile_i + kTileSide - 1) - low_i + 1;
      const int high_j = std::min(window.high_j, tile_j + kTileSide - 1);
      for (int j = std::max(window.low_j, tile_j); j <= high_j; ++j) {
        const float dy = static_cast<float>(j - hit.j) * resolution - hit.offset.y();
        float* row = tile.distance.data() + cell_slot(low_i, j);
        for (int k = 0; k < count; ++k) {
          const float dx = static_cast<float>(low_i + k - hit.i) * resolution - hit.offset.x();
          row[k] = std::min(row[k], std::sqrt(dx * dx + dy * dy));
        }
      }
    }
  }
}

// Only nodes whose nearest hit point has vanished need a new distance; first all of them are cleared, then
// each is compared with the remaining hit points.
void SensedLayer::forget(const std::vector<Hit>& vanished) {
  if (vanished.empty()) return;
  const float resolution = static_cast<float>(frame_.resolution);
  orphans_.clear();
  std::vector<std::size_t> ends;
  for (const Hit& hit : vanished) {
    const NodeWindow window = window_around(hit.i, hit.j, reach_);
    for (int j = window.low_j; j <= window.high_j; ++j) {
      for (int i = window.low_i; i <= window.high_i; ++i) {
        const float dx = static_cast<float>(i - hit.i) * resolution - hit.offset.x();
        const float dy = static_cast<float>(j - hit.j) * resolution - hit.offset.y();
        const float own = std::sqrt(dx * dx + dy * dy);
        float& stored = tile_at(i, j).distance[cell_slot(i, j)];
        if (own >= max_distance_ || stored < own * (1.0F - 1e-6F)) continue;
        stored = max_distance_;
        orphans_.emplace_back(i, j);
      }
    }
    ends.push_back(orphans_.size());
  }
  for (std::size_t k = 0; k < vanished.size(); ++k) restore(vanished[k], k == 0 ? 0 : ends[k - 1], ends[k]);
}

void SensedLayer::restore(const Hit& vanished, std::size_t first_node, std::size_t last_node) {
  const NodeWindow window = window_around(vanished.i, vanished.j, 2 * reach_);
  nearby_.clear();
  for (const Tile& tile : tiles_) {
    if (tile.occupied_cells == 0 || tile.first_i > window.high_i ||
        tile.first_i + kTileSide <= window.low_i || tile.first_j > window.high_j ||
        tile.first_j + kTileSide <= window.low_j)
      continue;
    for (std::size_t slot = 0; slot < kTileCells; ++slot) {
      if (tile.log_odds[slot] < occupied_from_) continue;
      for_hits(tile, slot, tile.hits[slot], [this](const Hit& hit) {
        nearby_.push_back(hit);
        return true;
      });
    }
  }
  const float resolution = static_cast<float>(frame_.resolution);
  for (std::size_t n = first_node; n < last_node; ++n) {
    const Eigen::Vector2i node = orphans_[n];
    float nearest = max_distance_ * max_distance_;
    for (const Hit& hit : nearby_) {
      const float dx = static_cast<float>(node.x() - hit.i) * resolution - hit.offset.x();
      const float dy = static_cast<float>(node.y() - hit.j) * resolution - hit.offset.y();
      nearest = std::min(nearest, dx * dx + dy * dy);
    }
    float& stored = tile_at(node.x(), node.y()).distance[cell_slot(node.x(), node.y())];
    stored = std::min(stored, std::sqrt(nearest));
  }
}

bool SensedLayer::free_around(int i, int j) const {
  const NodeWindow window = window_around(i, j, 1);
  for (int y = window.low_j; y <= window.high_j; ++y) {
    for (int x = window.low_i; x <= window.high_i; ++x) {
      const int tile = tile_of_[tile_slot(x, y)];
      if (tile < 0 || tiles_[static_cast<std::size_t>(tile)].log_odds[cell_slot(x, y)] > 2 * miss_step_)
        return false;
    }
  }
  return true;
}

bool SensedLayer::crossed_near(int i, int j, int reach) const {
  const NodeWindow window = window_around(i, j, reach);
  bool crossed = false;
  for (int y = window.low_j; y <= window.high_j; ++y) {
    for (int x = window.low_i; x <= window.high_i; ++x) {
      const int tile = tile_of_[tile_slot(x, y)];
      if (tile < 0) continue;
      const std::int16_t log_odds = tiles_[static_cast<std::size_t>(tile)].log_odds[cell_slot(x, y)];
      if (log_odds > 0) return false;
      crossed = crossed || log_odds < 0;
    }
  }
  return crossed;
}

std::vector<Eigen::Vector2d> SensedLayer::occupied_points() const {
  std::vector<Eigen::Vector2d> points;
  for (const Tile& tile : tiles_) {
    if (tile.occupied_cells == 0) continue;
    for (std::size_t slot = 0; slot < kTileCells; ++slot) {
      if (tile.log_odds[slot] < occupied_from_) continue;
      for_hits(tile, slot, tile.hits[slot], [&](const Hit& hit) {
        points.push_back(frame_.node_position(hit.i, hit.j) + hit.offset.cast<double>());
        return true;
      });
    }
  }
  return points;
}

}  // namespace spf
