// What CostToGo knows of clearances: lines of sight, and paths through narrow gaps.
#include <algorithm>
#include <array>
#include <cmath>

#include "spf/math/segment.hpp"
#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

/// Lines of sight may pass this much nearer than the clearance, in cells of the map: the error of bilinear
/// interpolation and of the steps between nodes.
constexpr double kSightSlack = 0.25;
constexpr double kRounding = 1e-9;
/// [1] of the room between least and wanted: what has no more than this beyond the least may turn out to be
/// too narrow, so a metre of it costs many: another path is taken as long as there is one.
constexpr double kTightShare = 0.33;
constexpr double kTightCost = 20.0;
/// [1] Room gained per metre by a move that counts: across a passage it is about 1, along it little. Nodes
/// that moved along it would lie behind positions that they are to lead on.
constexpr double kAcross = 0.5;
constexpr double kNextToNothing = 0.02;     // [m]
constexpr std::int64_t kLookWork = 2;       // of distance()
constexpr std::int64_t kExactLookWork = 6;  // of exact_distance()
constexpr int kBendRounds = 3;              // a path between neighbours bends 7 times at most

/// [1] Of a metre where there is so much room [m], beyond its length. With less than `turning` a robot with
/// corners cannot turn, so that it may not get through what bends.
double narrow_price(double room, double least, double wanted, double turning) {
  const double lack = std::max(wanted - room, 0.0) / std::max(wanted - least, 1e-9);
  const double tight =
      1.0 - (room - least) / std::max({kTightShare * (wanted - least), turning - least, 1e-9});
  return kNarrowCost * lack * lack + kTightCost * std::max(tight, 0.0);
}

}  // namespace

/// What the straight line between two positions costs beyond its length [m]; none = it is blocked.
std::optional<double> CostToGo::view(const OccupancyMap& map, const Eigen::Vector2d& from,
                                     const Eigen::Vector2d& to) const {
  if (narrow()) return narrow_view(map, from, to);
  work_ += kLookWork * (2 + static_cast<std::int64_t>((to - from).norm() / map.max_distance()));
  if (!map.segment_clear(window_.origin_world + from, window_.origin_world + to,
                         clearance_ - kSightSlack * map.frame().resolution))
    return std::nullopt;
  return 0.0;
}

std::optional<double> CostToGo::narrow_view(const OccupancyMap& map, const Eigen::Vector2d& from,
                                            const Eigen::Vector2d& to) const {
  const double cell = map.frame().resolution;
  const double least = least_clearance_;
  const double wanted = clearance_ - kSightSlack * cell;
  const double length = (to - from).norm();
  if (!std::isfinite(length)) return std::nullopt;
  const Eigen::Vector2d start = window_.origin_world + from;
  const Eigen::Vector2d direction =
      length > 0.0 ? Eigen::Vector2d{(to - from) / length} : Eigen::Vector2d{0, 0};
  // By the trapezoid rule: were each step priced at its beginning, paths would gain by where they begin.
  double cost = 0.0;
  double step = 0.0;
  double price_before = 0.0;
  for (double travelled = 0.0;;) {
    const Eigen::Vector2d here = start + travelled * direction;
    double room = map.distance(here);
    work_ += kLookWork;
    // It reads up to half a cell too little, or a little too much beside a corner.
    if (room < least + 0.1 * cell) {
      room = map.exact_distance(here);
      work_ += kExactLookWork;
    }
    if (!(room >= least)) return std::nullopt;
    const double price = narrow_price(room, least, wanted, clearance_ - parameters_.clearance);
    cost += 0.5 * step * (price_before + price);
    price_before = price;
    // What costs next to nothing shares its parent with its neighbours, which saves memory.
    if (travelled >= length)
      return (cost > kNextToNothing ? cost : 0.0) + standing_cost(start, start + length * direction);
    step = std::min(std::max(room - wanted, 0.5 * cell), length - travelled);
    travelled = step < length - travelled ? travelled + step : length;
  }
}

/// Whether a step from here to a neighbour may touch what stands.
bool CostToGo::standing_near(const Eigen::Vector2d& position_world) const {
  return std::any_of(standing_.begin(), standing_.end(), [&](const StandingDisc& disc) {
    return (disc.position_world - position_world).norm() <
           least_clearance_ + disc.radius + 1.5 * window_.resolution;
  });
}

/// What a straight line costs [m] for what stands on it: all of the wait, wherever it enters, since beside
/// the middle is no better; nothing on the way out, which does not lead deeper into it, so that what stands
/// near a goal does not make the ground around it costly.
double CostToGo::standing_cost(const Eigen::Vector2d& from_world, const Eigen::Vector2d& to_world) const {
  double cost = 0.0;
  for (const StandingDisc& disc : standing_) {
    const double outset = (disc.position_world - from_world).norm();
    const double reach = std::min(least_clearance_ + disc.radius, (1.0 - kRounding) * outset);
    if (distance_to_segment(disc.position_world, {from_world, to_world}) < reach)
      cost += standing_speed_ * disc.wait;
  }
  return cost;
}

bool CostToGo::passable(const OccupancyMap& map, const Eigen::Vector2d& from_world,
                        const Eigen::Vector2d& to_world) const {
  if (narrow())
    return narrow_view(map, from_world - window_.origin_world, to_world - window_.origin_world).has_value();
  return map.segment_clear(from_world, to_world, clearance_ - 0.5 * map.frame().resolution);
}

/// The position within half a cell of a node with the largest clearance, or the first that keeps the wanted
/// one; and how much room is there [m].
Eigen::Vector2d CostToGo::roomiest(const OccupancyMap& map, const Eigen::Vector2d& node_world,
                                   double& room) const {
  const double reach = 0.5 * window_.resolution;
  // Distances grow by a metre a metre at most.
  room = map.exact_distance(node_world);
  if (room + std::sqrt(2.0) * reach < least_clearance_) return node_world;
  Eigen::Vector2d best = node_world;
  for (double step = 0.5 * reach; step > 0.05 * reach;) {
    Eigen::Vector2d better = best;
    for (const auto& [x, y] : std::array<std::pair<int, int>, 4>{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}}) {
      const Eigen::Vector2d trial = best + step * Eigen::Vector2d{x, y};
      if ((trial - node_world).lpNorm<Eigen::Infinity>() > reach) continue;
      work_ += kExactLookWork;
      const double there = map.exact_distance(trial);
      if (there <= room + kAcross * step) continue;
      room = there;
      better = trial;
    }
    if (room >= clearance_) return better;
    if (better == best) step *= 0.5;
    best = better;
  }
  return best;
}

/// Where the straight line between two positions is narrowest, moved aside to the middle of the gap there;
/// none when the gap is too narrow.
std::optional<Eigen::Vector2d> CostToGo::middle_of_gap(const OccupancyMap& map, const Eigen::Vector2d& from,
                                                       const Eigen::Vector2d& to) const {
  constexpr int kLooks = 8;
  const Eigen::Vector2d along = to - from;
  const double length = along.norm();
  if (!(length > 0.0)) return std::nullopt;
  const auto room_at = [&](const Eigen::Vector2d& local) {
    work_ += kExactLookWork;
    return map.exact_distance(window_.origin_world + local);
  };
  Eigen::Vector2d narrowest = from;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 1; k < kLooks; ++k) {
    const Eigen::Vector2d local = from + along * (static_cast<double>(k) / kLooks);
    const double room = room_at(local);
    if (room >= least) continue;
    least = room;
    narrowest = local;
  }
  const double reach = window_.resolution;
  if (least + reach < least_clearance_) return std::nullopt;
  const Eigen::Vector2d aside{-along.y() / length, along.x() / length};
  Eigen::Vector2d best = narrowest;
  double most = least;
  for (double step = reach / kLooks; step > 0.01 * reach; step *= 0.25) {
    const Eigen::Vector2d middle = best;
    for (int k = -kLooks; k <= kLooks; ++k) {
      const Eigen::Vector2d local = middle + k * step * aside;
      const double room = room_at(local);
      if (room <= most) continue;
      most = room;
      best = local;
    }
  }
  if (most < least_clearance_ || best == narrowest) return std::nullopt;
  return best;
}

/// Finds a path between two neighbours that do not see each other; its bends from `from` on are left in the
/// wavefront.
bool CostToGo::bend_between(const OccupancyMap& map, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  std::vector<Eigen::Vector2d>& path = wavefront_.bend;
  path.assign({from, to});
  for (int round = 0; round <= kBendRounds; ++round) {
    bool clear = true;
    for (std::size_t leg = 0; leg + 1 < path.size(); ++leg) {
      if (narrow_view(map, path[leg], path[leg + 1])) continue;
      if (round == kBendRounds) return false;
      clear = false;
      const std::optional<Eigen::Vector2d> bend = middle_of_gap(map, path[leg], path[leg + 1]);
      if (!bend) return false;
      path.insert(path.begin() + static_cast<std::ptrdiff_t>(leg) + 1, *bend);
      ++leg;
    }
    if (clear) return true;
  }
  return false;
}

/// The first bend of the path that bend_between() has found, which leads to a settled node, as a parent. The
/// others become nodes of their own, each the parent of the one before.
CostToGo::Node CostToGo::parent_around_bend(const OccupancyMap& map, std::int32_t index) {
  const std::vector<Eigen::Vector2d>& path = wavefront_.bend;
  std::int32_t parent_node = index;
  double cost = static_cast<double>(own_cost(wavefront_.nodes[static_cast<std::size_t>(index)], index));
  for (std::size_t k = path.size() - 2; k >= 1; --k) {
    const Eigen::Vector2d& parent = path[k + 1];
    const double extra = narrow_view(map, path[k], parent).value_or(0.0);
    const auto base = static_cast<float>(cost + extra);
    wavefront_.nodes.push_back(
        {static_cast<float>(parent.x()), static_cast<float>(parent.y()), base, parent_node});
    wavefront_.surcharge.push_back(static_cast<float>(extra));
    wavefront_.position.push_back(path[k].cast<float>());
    parent_node = static_cast<std::int32_t>(wavefront_.nodes.size()) - 1;
    cost += (path[k] - parent).norm() + extra;
  }
  return {static_cast<float>(path[1].x()), static_cast<float>(path[1].y()), static_cast<float>(cost),
          parent_node};
}

/// The nearby position that just keeps the clearance.
Eigen::Vector2d CostToGo::at_clearance(const OccupancyMap& map, const Eigen::Vector2d& local) const {
  Eigen::Vector2d position = window_.origin_world + local;
  for (int step = 0; step < 2; ++step) {
    const double excess = map.distance(position) - clearance_;
    position -= std::clamp(excess, -window_.resolution, window_.resolution) * map.distance_gradient(position);
  }
  return position - window_.origin_world;
}

}  // namespace spf
