#include "spf/world/occupancy_map.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "spf/world/polygon_distances.hpp"

namespace spf {
namespace {

/// Distance to an axis-aligned box, negative inside [m].
double box_distance(const Eigen::Vector2d& position, const Eigen::Vector2d& low,
                    const Eigen::Vector2d& high) {
  const Eigen::Array2d outward = (low - position).array().max((position - high).array());
  const double outside = outward.max(0.0).matrix().norm();
  return outside > 0.0 ? outside : outward.maxCoeff();
}

void check_rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const char* what) {
  if (low.allFinite() && high.allFinite() && (high.array() > low.array()).all()) return;
  throw std::invalid_argument(std::string{what} + ": needs finite corners with low < high");
}

/// Checks every beam's direction too: the sum of angles may overflow.
bool finite(const RangeScan& scan, const Pose2& pose_world) {
  const double last = scan.angle_min + static_cast<double>(scan.ranges.size()) * scan.angle_increment;
  return pose_world.position_world.allFinite() && std::isfinite(pose_world.heading) &&
         std::isfinite(pose_world.heading + scan.angle_min) && std::isfinite(pose_world.heading + last) &&
         std::isfinite(scan.angle_increment) && std::isfinite(scan.max_range) && scan.max_range > 0.0;
}

}  // namespace

/// The four nodes around a position, and where it lies between them.
struct OccupancyMap::Patch {
  double value[2][2];       // [along x][along y]
  double x, y;              // position between the nodes, in [0, 1]
  bool inside_x, inside_y;  // false: clamped to the grid's edge
  int node_i[2], node_j[2];

  [[nodiscard]] double interpolated() const {
    const double low_y = value[0][0] + x * (value[1][0] - value[0][0]);
    const double high_y = value[0][1] + x * (value[1][1] - value[0][1]);
    return low_y + y * (high_y - low_y);
  }
  /// Per cell.
  [[nodiscard]] Eigen::Vector2d slope() const {
    const double low_y = value[1][0] - value[0][0];
    const double high_y = value[1][1] - value[0][1];
    const double low_x = value[0][1] - value[0][0];
    const double high_x = value[1][1] - value[1][0];
    return {inside_x ? low_y + y * (high_y - low_y) : 0.0, inside_y ? low_x + x * (high_x - low_x) : 0.0};
  }
};

OccupancyMap::OccupancyMap(const GridFrame& frame, double max_distance)
    : frame_{frame}, max_distance_{max_distance} {
  check_frame(frame);
  if (!(std::isfinite(max_distance) && max_distance > 0.0)) {
    throw std::invalid_argument("occupancy map: max_distance must be positive and finite");
  }
}

/// Copy on write: the layer may be changed while only this map holds it.
std::shared_ptr<std::vector<float>> OccupancyMap::writable_layer() const {
  if (known_ && known_.use_count() == 1)
    return std::const_pointer_cast<std::vector<float>>(known_);  // created non-const, right here
  if (known_) return std::make_shared<std::vector<float>>(*known_);
  const std::size_t nodes = static_cast<std::size_t>(frame_.width) * static_cast<std::size_t>(frame_.height);
  return std::make_shared<std::vector<float>>(nodes, static_cast<float>(max_distance_));
}

template <class SignedDistance>
void OccupancyMap::add_shape(const Eigen::Vector2i& low, const Eigen::Vector2i& high,
                             const SignedDistance& signed_distance) {
  std::shared_ptr<std::vector<float>> layer = writable_layer();
  for (int j = low.y(); j <= high.y(); ++j) {
    float* row = layer->data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(frame_.width);
    for (int i = low.x(); i <= high.x(); ++i) {
      row[i] = std::min(row[i], static_cast<float>(signed_distance(frame_.node_position(i, j))));
    }
  }
  known_ = std::move(layer);
  ++revision_;
}

void OccupancyMap::add_box(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  check_rectangle(low, high, "box");
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(max_distance_ + frame_.resolution);
  add_shape(nearest_node(low - reach), nearest_node(high + reach),
            [&](const Eigen::Vector2d& node) { return box_distance(node, low, high); });
}

void OccupancyMap::add_disc(const Eigen::Vector2d& centre, double radius) {
  if (!(centre.allFinite() && std::isfinite(radius) && radius >= 0.0)) {
    throw std::invalid_argument("disc: needs a finite centre and a radius >= 0");
  }
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(radius + max_distance_ + frame_.resolution);
  add_shape(nearest_node(centre - reach), nearest_node(centre + reach),
            [&](const Eigen::Vector2d& node) { return (node - centre).norm() - radius; });
}

void OccupancyMap::add_polygon(const std::vector<Eigen::Vector2d>& corners) {
  const auto finite = [](const Eigen::Vector2d& corner) { return corner.allFinite(); };
  if (corners.size() < 3 || !std::all_of(corners.begin(), corners.end(), finite)) {
    throw std::invalid_argument("polygon: needs three finite corners or more");
  }
  const PolygonDistances distances{frame_, corners, max_distance_};
  std::shared_ptr<std::vector<float>> layer = writable_layer();
  for (int j = distances.low().y(); j <= distances.high().y(); ++j) {
    float* row = layer->data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(frame_.width);
    for (int i = distances.low().x(); i <= distances.high().x(); ++i)
      row[i] = std::min(row[i], distances.at(i, j));
  }
  known_ = std::move(layer);
  ++revision_;
}

void OccupancyMap::add_border(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  check_rectangle(low, high, "border");
  add_shape({0, 0}, {frame_.width - 1, frame_.height - 1},
            [&](const Eigen::Vector2d& node) { return -box_distance(node, low, high); });
}

void OccupancyMap::add_box(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                           const Pose2& frame_world) {
  check_rectangle(low, high, "box");
  const Eigen::Rotation2Dd turn{frame_world.heading};
  const Eigen::Vector2d centre = frame_world.position_world + turn * (0.5 * (low + high));
  const Eigen::Vector2d half = turn.toRotationMatrix().cwiseAbs() * (0.5 * (high - low));
  const Eigen::Vector2d reach = half + Eigen::Vector2d::Constant(max_distance_ + frame_.resolution);
  const Eigen::Rotation2Dd back = turn.inverse();
  add_shape(nearest_node(centre - reach), nearest_node(centre + reach), [&](const Eigen::Vector2d& node) {
    return box_distance(back * (node - frame_world.position_world), low, high);
  });
}

void OccupancyMap::add_border(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                              const Pose2& frame_world) {
  check_rectangle(low, high, "border");
  const Eigen::Rotation2Dd back{-frame_world.heading};
  add_shape({0, 0}, {frame_.width - 1, frame_.height - 1}, [&](const Eigen::Vector2d& node) {
    return -box_distance(back * (node - frame_world.position_world), low, high);
  });
}

void OccupancyMap::take_over_sensed(const OccupancyMap& before, const Pose2& moved) {
  revision_ = std::max(revision_, before.revision_) + 1;
  sensed_.reset();
  if (!before.sensed_) return;
  const bool same_grid = frame_.origin_world == before.frame_.origin_world &&
                         frame_.resolution == before.frame_.resolution &&
                         frame_.width == before.frame_.width && frame_.height == before.frame_.height &&
                         max_distance_ == before.max_distance_;
  if (same_grid && moved.heading == 0.0 && moved.position_world.isZero(0.0)) {
    sensed_ = before.sensed_;
    return;
  }
  const Eigen::Rotation2Dd turn{moved.heading};
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector2d& point : before.occupied_points()) {
    const Eigen::Vector2d here = turn * point + moved.position_world;
    if (!on_known_surface(here)) points.push_back(here);
  }
  sensed_.emplace(frame_, max_distance_);
  sensed_->enter_surfaces(points);
}

template <class NodeValue>
OccupancyMap::Patch OccupancyMap::patch_of(const Eigen::Vector2d& position_world,
                                           const NodeValue& node_value) const {
  const double u = (position_world.x() - frame_.origin_world.x()) / frame_.resolution;
  const double v = (position_world.y() - frame_.origin_world.y()) / frame_.resolution;
  const double last_u = frame_.width - 1;
  const double last_v = frame_.height - 1;
  Patch patch;
  patch.inside_x = u > 0.0 && u < last_u;
  patch.inside_y = v > 0.0 && v < last_v;
  const double held_u = patch.inside_x ? u : (u >= last_u ? last_u : 0.0);
  const double held_v = patch.inside_y ? v : (v >= last_v ? last_v : 0.0);
  const int i = std::max(std::min(static_cast<int>(held_u), frame_.width - 2), 0);
  const int j = std::max(std::min(static_cast<int>(held_v), frame_.height - 2), 0);
  const int next_i = std::min(i + 1, frame_.width - 1);
  const int next_j = std::min(j + 1, frame_.height - 1);
  patch.node_i[0] = i;
  patch.node_i[1] = next_i;
  patch.node_j[0] = j;
  patch.node_j[1] = next_j;
  patch.x = held_u - i;
  patch.y = held_v - j;
  patch.value[0][0] = node_value(i, j);
  patch.value[1][0] = node_value(next_i, j);
  patch.value[0][1] = node_value(i, next_j);
  patch.value[1][1] = node_value(next_i, next_j);
  return patch;
}

double OccupancyMap::distance(const Eigen::Vector2d& position_world) const {
  return patch_of(position_world, [this](int i, int j) { return node_distance(i, j); }).interpolated();
}

/// Distances at the nodes of a cell and at those around them, and what they say of slopes.
struct OccupancyMap::Surroundings {
  double value[4][4];  // [along x][along y], the cell's own nodes at 1 and 2
  double resolution;   // [m]

  /// Gradient at a node [1] of the distance to the surface that is nearest to it. Between two surfaces the
  /// distance has a ridge, where a difference over both sides says nothing: there it is that of the side on
  /// which the distance falls more.
  [[nodiscard]] Eigen::Vector2d slope(int i, int j) const {
    constexpr double kKink = 0.05;  // [1] of a cell: more is a ridge
    const double here = value[i][j];
    const auto along = [&](double before, double after) {
      const bool ridge = before + after - 2.0 * here < -kKink * resolution;
      const double rise = before < after ? here - before : after - here;
      return (ridge ? rise : 0.5 * (after - before)) / resolution;
    };
    return {along(value[i - 1][j], value[i + 1][j]), along(value[i][j - 1], value[i][j + 1])};
  }
};

OccupancyMap::Surroundings OccupancyMap::surroundings_of(const Patch& patch) const {
  Surroundings around;
  around.resolution = frame_.resolution;
  const int first = patch.node_i[0] - 1;
  const bool inside = first >= 0 && first + 3 < frame_.width;
  for (int b = 0; b < 4; ++b) {
    const int j = std::clamp(patch.node_j[0] - 1 + b, 0, frame_.height - 1);
    if (!inside) {
      for (int a = 0; a < 4; ++a)
        around.value[a][b] = node_distance(std::clamp(first + a, 0, frame_.width - 1), j);
      continue;
    }
    float row[4];
    for (int a = 0; a < 4; ++a) row[a] = known_node_distance(first + a, j);
    if (sensed_) sensed_->lower(first, j, row);
    for (int a = 0; a < 4; ++a) around.value[a][b] = row[a];
  }
  return around;
}

double OccupancyMap::exact_distance(const Eigen::Vector2d& position_world) const {
  Patch patch = patch_of(position_world, [](int, int) { return 0.0; });  // read with its surroundings
  const Surroundings around = surroundings_of(patch);
  const int across[2] = {1, 1 + patch.node_i[1] - patch.node_i[0]};
  const int up[2] = {1, 1 + patch.node_j[1] - patch.node_j[0]};
  Eigen::Vector2d slope[4];
  int widest = 0;
  double weight[4];
  for (int k = 0; k < 4; ++k) {
    patch.value[k & 1][k >> 1] = around.value[across[k & 1]][up[k >> 1]];
    slope[k] = around.slope(across[k & 1], up[k >> 1]);
    weight[k] = ((k & 1) != 0 ? patch.x : 1.0 - patch.x) * (k > 1 ? patch.y : 1.0 - patch.y);
    if (weight[k] > weight[widest]) widest = k;
  }
  const double interpolated = patch.interpolated();
  // The nodes of either side of the ridge vouch for the surface on their side.
  double sum[2] = {0.0, 0.0};
  double weights[2] = {0.0, 0.0};
  for (int k = 0; k < 4; ++k) {
    const std::size_t side = slope[k].dot(slope[widest]) > 0.0 ? 0 : 1;
    const Eigen::Vector2d offset{patch.x - (k & 1), patch.y - (k >> 1)};
    sum[side] += weight[k] * (patch.value[k & 1][k >> 1] + frame_.resolution * offset.dot(slope[k]));
    weights[side] += weight[k];
  }
  if (!(weights[1] > 0.0)) return interpolated;
  return std::max(interpolated, std::min(sum[0] / weights[0], sum[1] / weights[1]));
}

double OccupancyMap::known_distance(const Eigen::Vector2d& position_world) const {
  return patch_of(position_world, [this](int i, int j) { return known_node_distance(i, j); }).interpolated();
}

Eigen::Vector2d OccupancyMap::distance_gradient(const Eigen::Vector2d& position_world) const {
  const Patch patch = patch_of(position_world, [this](int i, int j) { return node_distance(i, j); });
  return patch.slope() / frame_.resolution;
}

// Distance falls by at most one metre a metre, so a position at distance d vouches for d - clearance around
// it; a quarter of a cell is kept back for the interpolation, and is the smallest step.
bool OccupancyMap::segment_clear(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double clearance) const {
  double here = distance(a);
  if (!(std::min(here, distance(b)) >= clearance)) return false;
  const Eigen::Vector2d along = b - a;
  const double length = along.norm();
  if (!(length > 0.0)) return true;
  if (!std::isfinite(length)) return false;
  const double smallest_step = 0.25 * frame_.resolution;
  const Eigen::Vector2d direction = along / length;
  double travelled = 0.0;
  while (here >= clearance) {
    travelled += std::max(here - clearance - smallest_step, smallest_step);
    if (travelled >= length) return true;
    here = distance(a + travelled * direction);
  }
  return false;
}

void OccupancyMap::integrate(const RangeScan& scan, const Pose2& sensor_pose_world,
                             const std::vector<MaskedDisc>& masked,
                             const std::vector<std::uint8_t>* kept_out) {
  if (scan.ranges.size() > kMostBeams || !finite(scan, sensor_pose_world)) return;
  const Eigen::Vector2d sensor = sensor_pose_world.position_world;
  const Eigen::Vector2d extent = frame_.resolution * Eigen::Vector2d{frame_.width - 1, frame_.height - 1};
  const double reach = reach_of(scan);
  if (box_distance(sensor, frame_.origin_world, frame_.origin_world + extent) > reach) return;
  collect_beams(scan, sensor_pose_world, reach, masked, kept_out);
  if (beams_.empty()) return;
  if (!sensed_) sensed_.emplace(frame_, max_distance_);
  if (sensed_->integrate(sensor, beams_)) ++revision_;
}

/// How far beams are followed [m]: a sensor may report any large number as its range.
double OccupancyMap::reach_of(const RangeScan& scan) const {
  constexpr double kMostCrossings = 2e7;  // cells; no real sweep on a grid of real size comes near
  const double diagonal = std::hypot(frame_.width, frame_.height);
  const double cells = kMostCrossings / static_cast<double>(std::max<std::size_t>(scan.ranges.size(), 1));
  return std::min(scan.max_range, frame_.resolution * std::min(diagonal, cells));
}

void OccupancyMap::collect_beams(const RangeScan& scan, const Pose2& sensor_pose_world, double reach,
                                 const std::vector<MaskedDisc>& masked,
                                 const std::vector<std::uint8_t>* kept_out) {
  beams_.clear();
  for (std::size_t k = 0; k < scan.ranges.size(); ++k) {
    const double range = scan.ranges[k];
    if (!(range > 0.0)) continue;
    const double angle =
        sensor_pose_world.heading + scan.angle_min + static_cast<double>(k) * scan.angle_increment;
    SensedBeam beam;
    beam.direction_world = {std::cos(angle), std::sin(angle)};
    beam.returned = range <= reach;
    beam.length = std::min(range, reach);
    if (beam.returned) {
      const Eigen::Vector2d end = sensor_pose_world.position_world + range * beam.direction_world;
      beam.marks =
          !on_known_surface(end) && (kept_out == nullptr || k >= kept_out->size() || (*kept_out)[k] == 0);
      for (const MaskedDisc& disc : masked) {
        beam.marks = beam.marks && (end - disc.position_world).squaredNorm() > disc.radius * disc.radius;
      }
    }
    beams_.push_back(beam);
  }
}

bool OccupancyMap::explored_free(const Eigen::Vector2d& position_world, double reach) const {
  if (!unexplored_) return true;
  if (!sensed_) return false;
  const Eigen::Vector2i node = nearest_node(position_world);
  return sensed_->crossed_near(node.x(), node.y(), static_cast<int>(std::ceil(reach / frame_.resolution)));
}

bool OccupancyMap::on_known_surface(const Eigen::Vector2d& position_world) const {
  if (!known_) return false;
  const auto known_distance = [this](int i, int j) {
    return (*known_)[static_cast<std::size_t>(j) * static_cast<std::size_t>(frame_.width) +
                     static_cast<std::size_t>(i)];
  };
  return patch_of(position_world, known_distance).interpolated() < 0.5 * frame_.resolution;
}

std::vector<Eigen::Vector2d> OccupancyMap::occupied_points() const {
  return sensed_ ? sensed_->occupied_points() : std::vector<Eigen::Vector2d>{};
}

}  // namespace spf
