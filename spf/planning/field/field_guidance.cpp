#include "spf/planning/field/field_guidance.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/plane.hpp"

namespace spf {
namespace {

// The paper's "engineering setting" against oscillation: side changes widen the threshold.
constexpr double kSideChangeWindow = 4.0;   // [s] those younger than this
constexpr double kWideningPerChange = 0.1;  // [1] by this for each after the first
constexpr double kMaxWidening = 0.5;        // [1] and by this at most
constexpr std::size_t kMemorySize = 64;

Eigen::Vector2d mirrored_direction(const Eigen::Vector2d& direction, const Eigen::Vector2d& along) {
  return 2.0 * direction.dot(along) * along - direction;
}

Eigen::Vector2d mirrored_point(const Eigen::Vector2d& point, const Eigen::Vector2d& on_line,
                               const Eigen::Vector2d& along) {
  return on_line + mirrored_direction(point - on_line, along);
}

/// First and last node of 1 .. last_node in a region; first is 0 when there is none.
struct NodeSpan {
  int first = 0;
  int last = 0;
};
NodeSpan dangerous_nodes(const DangerRegion& region, const NodeSet& nodes, int last_node) {
  NodeSpan span;
  for (int k = 1; k <= last_node; ++k) {
    if (region.field.mahalanobis(nodes[k].position) >= region.threshold) continue;
    if (span.first == 0) span.first = k;
    span.last = k;
  }
  return span;
}

/// A newer pair of the same node and obstacle replaces the older one.
void put(const GuidePair& pair, std::vector<GuidePair>& pairs) {
  const auto old = std::find_if(pairs.begin(), pairs.end(), [&](const GuidePair& other) {
    return other.node == pair.node && other.source == pair.source;
  });
  if (old != pairs.end())
    *old = pair;
  else
    pairs.push_back(pair);
}

}  // namespace

FieldGuidance::FieldGuidance(double safety_distance, double least_lateral_share)
    : safety_distance_{safety_distance}, least_lateral_share_{least_lateral_share} {
  memory_.reserve(kMemorySize);
}

void FieldGuidance::find_conflicts(const std::vector<DangerRegion>& regions, const NodeSet& nodes,
                                   int last_node, const FlatState& head,
                                   std::vector<FieldConflict>& conflicts) const {
  conflicts.clear();
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const NodeSpan span = dangerous_nodes(regions[r], nodes, last_node);
    if (span.first > 0)
      conflicts.push_back(conflict_of(regions[r], static_cast<int>(r), nodes, span.first, span.last, head));
  }
  std::sort(conflicts.begin(), conflicts.end(), [](const FieldConflict& a, const FieldConflict& b) {
    return a.first != b.first ? a.first < b.first : a.region < b.region;
  });
}

FieldConflict FieldGuidance::conflict_of(const DangerRegion& region, int index, const NodeSet& nodes,
                                         int first, int last, const FlatState& head) const {
  FieldConflict conflict;
  conflict.region = index;
  conflict.first = first;
  conflict.last = last;
  // The line of symmetry runs through the last point before and the first point after the dangerous ones.
  conflict.entry_world = nodes[first - 1].position;
  const Eigen::Vector2d exit = nodes[std::min(last + 1, nodes.size() - 1)].position;
  Eigen::Vector2d chord = exit - conflict.entry_world;
  if (chord.norm() < 1e-6) chord = head.velocity_world;
  if (chord.norm() < 1e-6) chord = left_of(region.field.axis_world());
  conflict.along = chord.normalized();

  // The natural side is the one to which most of the gradients point; if they are neutral, behind the moving
  // obstacle.
  const Eigen::Vector2d left = left_of(conflict.along);
  double lean = 0.0;
  for (int k = first; k <= last; ++k) {
    const Eigen::Vector2d escape = region.field.escape_direction(nodes[k].position, left);
    lean += escape.dot(left) * std::max(0.0, region.threshold - region.field.mahalanobis(nodes[k].position));
  }
  constexpr double kNeutral = 1e-6;
  if (std::abs(lean) < kNeutral) lean = -region.field.axis_world().dot(left);
  conflict.natural = lean >= 0.0 ? PassingSide::left : PassingSide::right;
  return conflict;
}

void FieldGuidance::add_pairs(const std::vector<DangerRegion>& regions, const NodeSet& nodes, int last_node,
                              const FlatState& head, std::vector<SideChoice>& sides,
                              std::vector<GuidePair>& pairs) const {
  sides.resize(regions.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const DangerRegion& region = regions[r];
    SideChoice& choice = sides[r];
    const NodeSpan span = dangerous_nodes(region, nodes, last_node);
    if (span.first > 0 && !choice.decided) {
      const FieldConflict conflict =
          conflict_of(region, static_cast<int>(r), nodes, span.first, span.last, head);
      choice = {true, conflict.natural, conflict.along, conflict.entry_world};
    }
    for (int k = 1; k <= last_node; ++k) {
      const Eigen::Vector2d& position = nodes[k].position;
      const double clearance = region.field.clearance(position, region.threshold);
      if (clearance >= safety_distance_) continue;
      GuidePair pair =
          clearance < 0.0 ? inner_pair(region, position, choice) : rim_pair(region, position, clearance);
      // A node on the rim of the wrong side gets no pair: other nodes have to pull first.
      if (clearance >= 0.0 && choice.decided && pair.normal.dot(side_of(choice)) < 0.0) continue;
      pair.node = k;
      put(pair, pairs);
    }
  }
}

Eigen::Vector2d FieldGuidance::side_of(const SideChoice& choice) {
  return static_cast<double>(choice.side) * left_of(choice.along);
}

/// Pair of a node outside the ellipse, but nearer than d_saf, where eq. 10 is positive too. The guide point
/// is the foot on the ellipse along the gradient (to first order).
GuidePair FieldGuidance::rim_pair(const DangerRegion& region, const Eigen::Vector2d& position,
                                  double clearance) const {
  GuidePair pair;
  pair.source = region.id;
  pair.normal = region.field.escape_direction(position, Eigen::Vector2d::Zero());
  pair.base = position - clearance * pair.normal;
  return pair;
}

GuidePair FieldGuidance::inner_pair(const DangerRegion& region, const Eigen::Vector2d& position,
                                    const SideChoice& choice) const {
  const Eigen::Vector2d side = side_of(choice);
  Eigen::Vector2d direction = region.field.escape_direction(position, side);  // eq. 11
  const bool mirror = direction.dot(side) < 0.0;
  Eigen::Vector2d mirrored_guide = position;
  if (mirror) {
    const Eigen::Vector2d natural = region.field.guide_point(position, direction, region.threshold);
    mirrored_guide = mirrored_point(natural, choice.entry_world, choice.along);
    direction = mirrored_direction(direction, choice.along);
  }
  const double lateral = direction.dot(side);
  if (lateral < least_lateral_share_) {
    const double forward = direction.dot(choice.along) < 0.0 ? -1.0 : 1.0;
    const double rest = std::sqrt(1.0 - least_lateral_share_ * least_lateral_share_);
    direction = forward * rest * choice.along + least_lateral_share_ * side;
  }
  GuidePair pair;
  pair.source = region.id;
  pair.normal = direction;
  pair.base = region.field.guide_point(position, direction, region.threshold);
  // Fig. 4's mirrored point, where it lies farther out than the ellipse (which is not symmetric to that
  // line).
  if (mirror && signed_distance(pair, mirrored_guide) > 0.0) pair.base = mirrored_guide;
  return pair;
}

const FieldGuidance::Memory* FieldGuidance::find(int track_id) const {
  for (const Memory& memory : memory_)
    if (memory.track_id == track_id) return &memory;
  return nullptr;
}

int FieldGuidance::remembered_side(int track_id, double time) const {
  const Memory* memory = find(track_id);
  if (memory == nullptr || time - memory->time > kSideChangeWindow) return 0;
  return static_cast<int>(memory->side);
}

void FieldGuidance::remember(int track_id, PassingSide side, double time) {
  const auto found = std::find_if(memory_.begin(), memory_.end(),
                                  [track_id](const Memory& one) { return one.track_id == track_id; });
  Memory* memory = found == memory_.end() ? nullptr : &*found;
  if (memory == nullptr) {
    if (memory_.size() < kMemorySize) {
      memory_.emplace_back();
      memory = &memory_.back();
    } else {
      memory = &*std::min_element(memory_.begin(), memory_.end(),
                                  [](const Memory& a, const Memory& b) { return a.time < b.time; });
    }
    *memory = Memory{};
    memory->track_id = track_id;
    memory->side = side;
  }
  const bool fresh = time - memory->time <= kSideChangeWindow;
  if (memory->side != side && fresh) {
    memory->changes[memory->change_count % kMaxChanges] = time;
    ++memory->change_count;
  }
  memory->side = side;
  memory->time = time;
}

int FieldGuidance::side_changes(int track_id, double time) const {
  const Memory* memory = find(track_id);
  if (memory == nullptr) return 0;
  int recent = 0;
  for (int i = 0; i < std::min(memory->change_count, kMaxChanges); ++i)
    if (time - memory->changes[i] <= kSideChangeWindow) ++recent;
  return recent;
}

double FieldGuidance::widening(int track_id, double time) const {
  const int beyond_first = std::max(0, side_changes(track_id, time) - 1);
  return 1.0 + std::min(kMaxWidening, kWideningPerChange * beyond_first);
}

}  // namespace spf
