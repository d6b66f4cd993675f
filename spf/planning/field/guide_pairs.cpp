#include "spf/planning/field/guide_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spf {
namespace {

constexpr double kStep = 0.1;     // [radii of the robot] between dense samples where needed
constexpr int kMaxSubsteps = 40;  // of one interval
// [radii] a pair covers a collision unless the node is this far on its safe side
constexpr double kCovered = 0.05 / 0.3;
constexpr double kOutOfSurface = 0.01 / 0.3;  // [radii] clearance of a search's endpoints beyond the margin

/// Cubic through two neighbouring nodes with their velocities, u in [0, 1].
Eigen::Vector2d between(const NodeSet& nodes, int k, double u) {
  const NodeSample& a = nodes[k];
  const NodeSample& b = nodes[k + 1];
  const double dt = b.time - a.time;
  const double v = 1.0 - u;
  return v * v * (1.0 + 2.0 * u) * a.position + u * u * (3.0 - 2.0 * u) * b.position +
         u * v * dt * (v * a.velocity - u * b.velocity);
}

/// The position moved out of the static margin along the distance gradient; unchanged when it is free.
Eigen::Vector2d moved_out(const ClearanceModel& model, Eigen::Vector2d position) {
  const double wanted = kOutOfSurface * model.robot_radius();
  for (int i = 0; i < 10; ++i) {
    const double clearance = model.static_clearance(position);
    if (clearance >= wanted) break;
    const Eigen::Vector2d gradient = model.map().distance_gradient(position);
    const double norm = gradient.norm();
    if (norm < 1e-6) break;
    position += (wanted * 1.5 - clearance) / norm * gradient;
  }
  return position;
}

}  // namespace

GuidePairFinder::GuidePairFinder(int max_nodes) {
  stretches_.reserve(static_cast<std::size_t>(max_nodes));
  path_.reserve(1024);
}

GuidePairFinder::Outcome GuidePairFinder::find(const ClearanceModel& model, const NodeSet& nodes,
                                               PathSearchRef search, std::vector<GuidePair>& pairs) {
  const bool tail_free = collect_stretches(model, nodes);
  if (!tail_free) return Outcome::blocked;
  bool added = false;
  for (const Stretch& stretch : stretches_) {
    const Eigen::Vector2d from = moved_out(model, nodes[stretch.first].position);
    const Eigen::Vector2d to = moved_out(model, nodes[stretch.last].position);
    ++searches_;
    path_.clear();
    if (!search(from, to, path_) || path_.size() < 2) return Outcome::blocked;
    added = add_pairs(model, nodes, stretch, pairs) || added;
  }
  if (stretches_.empty()) return Outcome::clear;
  return added ? Outcome::added : Outcome::blocked;
}

/// Fills stretches_; false when the curve ends in collision.
bool GuidePairFinder::collect_stretches(const ClearanceModel& model, const NodeSet& nodes) {
  stretches_.clear();
  bool inside = model.static_clearance(nodes[0].position) < 0.0;
  int first = 0;
  const auto close = [&](int last) {
    if (!stretches_.empty() && first < stretches_.back().last)
      stretches_.back().last = last;  // left and entered again between the same two nodes
    else
      stretches_.push_back({first, last});
  };
  double here = model.static_clearance(nodes[0].position);
  for (int k = 0; k + 1 < nodes.size(); ++k) {
    const double gap = (nodes[k + 1].position - nodes[k].position).norm();
    const double next = model.static_clearance(nodes[k + 1].position);
    // The curve between two nodes stays within their gap of the nearer one, with allowance for its curvature.
    const bool surely_free = !inside && std::min(here, next) > 0.75 * gap;
    if (!surely_free) {
      const int steps =
          std::clamp(static_cast<int>(std::ceil(gap / (kStep * model.robot_radius()))), 2, kMaxSubsteps);
      for (int s = 1; s <= steps; ++s) {
        const double clearance =
            s == steps ? next : model.static_clearance(between(nodes, k, static_cast<double>(s) / steps));
        const bool occupied = clearance < 0.0;
        if (occupied && !inside) first = k;
        if (!occupied && inside) close(k + 1);
        inside = occupied;
      }
    }
    here = next;
  }
  return !inside;
}

/// Half planes for the nodes strictly inside a stretch, or for both ends when there are none.
bool GuidePairFinder::add_pairs(const ClearanceModel& model, const NodeSet& nodes, const Stretch& stretch,
                                std::vector<GuidePair>& pairs) {
  const std::size_t before = pairs.size();
  if (stretch.last == stretch.first + 1) {
    GuidePair pair;
    const Eigen::Vector2d tangent = nodes[stretch.last].position - nodes[stretch.first].position;
    if (pair_at(model, between(nodes, stretch.first, 0.5), tangent, pair)) {
      for (const int node : {stretch.first, stretch.last}) {
        if (node == 0 || node == nodes.size() - 1) continue;
        pair.node = node;
        pairs.push_back(pair);
      }
    }
    return pairs.size() > before;
  }
  for (int k = stretch.first + 1; k < stretch.last; ++k) {
    GuidePair pair;
    const Eigen::Vector2d tangent = nodes[k + 1].position - nodes[k - 1].position;
    if (!pair_at(model, nodes[k].position, tangent, pair)) continue;
    pair.node = k;
    pairs.push_back(pair);
  }
  if (pairs.size() == before) return false;
  // Nodes in the obstacle without a crossing of their own share their nearest neighbour's half plane.
  const std::size_t found = pairs.size();
  for (int k = stretch.first + 1; k < stretch.last; ++k) {
    if (model.static_clearance(nodes[k].position) >= 0.0) continue;
    int least = std::numeric_limits<int>::max();
    GuidePair nearest;
    for (std::size_t i = before; i < found; ++i) {
      const int apart = std::abs(pairs[i].node - k);
      if (apart < least) {
        least = apart;
        nearest = pairs[i];
      }
    }
    if (least == 0) continue;
    nearest.node = k;
    pairs.push_back(nearest);
  }
  return true;
}

/// The half plane of one position: from where the path crosses the plane through it, back to the surface.
bool GuidePairFinder::pair_at(const ClearanceModel& model, const Eigen::Vector2d& position,
                              const Eigen::Vector2d& tangent, GuidePair& pair) const {
  // 1. Nearest point where the path crosses the plane through `position` perpendicular to the tangent.
  Eigen::Vector2d crossing = Eigen::Vector2d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
    const double a = (path_[i] - position).dot(tangent);
    const double b = (path_[i + 1] - position).dot(tangent);
    if ((a < 0.0) == (b < 0.0)) continue;
    const Eigen::Vector2d candidate = path_[i] + a / (a - b) * (path_[i + 1] - path_[i]);
    const double distance = (candidate - position).norm();
    if (distance < least) {
      least = distance;
      crossing = candidate;
    }
  }
  if (!(least < std::numeric_limits<double>::infinity()) || least < 1e-3) return false;

  // 2. From there back towards `position` to the last free point. The clearance is a distance, so steps may
  //    be as large as it.
  pair.normal = (crossing - position) / least;
  const double smallest_step = model.robot_radius() / 60.0;
  double travelled = 0.0;
  double free_until = 0.0;
  while (travelled < least) {
    const double clearance = model.static_clearance(crossing - travelled * pair.normal);
    if (clearance < 0.0) {
      pair.base = crossing - free_until * pair.normal;
      return true;
    }
    free_until = travelled;
    travelled += std::max(clearance, smallest_step);
  }
  return false;  // no surface between the path and the position
}

bool GuidePairFinder::new_collision(const ClearanceModel& model, const NodeSet& nodes,
                                    const std::vector<GuidePair>& pairs) {
  for (int k = 1; k + 1 < nodes.size(); ++k) {
    const Eigen::Vector2d& position = nodes[k].position;
    if (model.static_clearance(position) >= 0.0) continue;
    bool covered = false;
    for (const GuidePair& pair : pairs)
      covered =
          covered || (pair.node == k && signed_distance(pair, position) < kCovered * model.robot_radius());
    if (!covered) return true;
  }
  return false;
}

}  // namespace spf
