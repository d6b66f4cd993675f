// CostToGo's update, in slices of bounded work.
#include <algorithm>
#include <limits>

#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

constexpr std::size_t kMuchMore = 16;  // [1] memory for so many times more nodes than needed is given back

}  // namespace

CostToGoOutcome CostToGo::update(const OccupancyMap& map, const Eigen::Vector2d& goal_world,
                                 const Eigen::Vector2d& robot_world) {
  begin(map, goal_world, robot_world);
  advance(map, std::numeric_limits<std::int64_t>::max());
  return outcome_;
}

void CostToGo::begin(const OccupancyMap& map, const Eigen::Vector2d& goal_world,
                     const Eigen::Vector2d& robot_world) {
  progress_ = {};
  parents_.clear();
  goal_asked_ = goal_world;
  goal_used_ = goal_world;
  map_revision_ = map.revision();
  outcome_ = CostToGoOutcome::no_free_goal;
  if (!goal_world.allFinite() || !robot_world.allFinite()) return;
  const std::optional<Eigen::Vector2d> goal = nearest_free_position(map, goal_world);
  if (!goal) return;
  goal_used_ = *goal;
  progress_.robot_world = robot_world;
  if (!far_field_holds(map)) far_field_.reset();
  // A path that was found beyond the box around robot and goal is not looked for in the box again.
  progress_.everywhere = far_field_ && far_field_->whole_map_;
  open_window(map);
}

bool CostToGo::advance(const OccupancyMap& map, std::int64_t work) {
  work_ = 0;
  progress_.limit = work;
  while (under_way())
    if (!run_stage(map)) return false;
  return true;
}

void CostToGo::enter(Stage stage) {
  progress_.stage = stage;
  progress_.next = 0;
}

/// False when the work of this slice is done before the stage is.
bool CostToGo::run_stage(const OccupancyMap& map) {
  switch (progress_.stage) {
    case Stage::far_field:
      return advance_far_field(map);
    case Stage::mark_free_nodes:
      if (!for_nodes(window_count(), [&](std::int32_t index) { mark_free_node(map, index); })) return false;
      if (window_covers(goal_used_)) seed(map);
      enter(!far_field_ ? Stage::propagate : Stage::seed);
      return true;
    case Stage::seed:
      if (!for_nodes(2 * (window_.width + window_.height - 2),
                     [&](std::int32_t along) { seed_from_far_field(map, edge_node(along)); }))
        return false;
      enter(Stage::propagate);
      return true;
    case Stage::propagate:
      if (!propagate(map)) return false;
      end_propagation(map);
      return true;
    case Stage::find_reached:
      if (!for_nodes(window_count(), [&](std::int32_t index) { enter_reached(index); })) return false;
      enter(Stage::find_nearest);
      return true;
    case Stage::find_nearest:
      if (!find_nearest()) return false;
      enter(Stage::extend);
      return true;
    case Stage::extend:
      if (!for_nodes(window_count(), [&](std::int32_t index) { extend(index); })) return false;
      enter(Stage::keep_parents);
      return true;
    case Stage::keep_parents:
      if (!keep_parents()) return false;
      enter(Stage::keep_positions);
      return true;
    case Stage::keep_positions:
      if (!map.sensed() && !for_nodes(static_cast<std::int32_t>(wavefront_.position.size()),
                                      [&](std::int32_t index) { keep_position(index); }))
        return false;
      free_memory(map);
      enter(Stage::done);
      return true;
    case Stage::done:
      return true;
  }
  return true;
}

/// The window is the box around goal and robot with some room or, where no path was found in that, all of the
/// map. Where that is too large, the box around the robot, after a coarse field over all.
void CostToGo::open_window(const OccupancyMap& map) {
  const Eigen::Vector2d room =
      Eigen::Vector2d::Constant(progress_.everywhere ? 1e9 : parameters_.window_margin);
  const Eigen::Vector2d low = goal_used_.cwiseMin(progress_.robot_world) - room;
  const Eigen::Vector2d high = goal_used_.cwiseMax(progress_.robot_world) + room;
  if (splits(map, low, high)) {
    enter(Stage::far_field);
    return;
  }
  far_field_.reset();
  if (is_far_field_) coarsen(map, low, high);
  set_window(map, low, high);
  clear_nodes();
}

void CostToGo::clear_nodes() {
  const std::size_t count = static_cast<std::size_t>(window_count());
  if (wavefront_.nodes.capacity() > kMuchMore * count) wavefront_ = {};
  wavefront_.state.resize(count);
  wavefront_.surcharge.assign(count, 0.0F);
  wavefront_.nodes.assign(count, {0.0F, 0.0F, std::numeric_limits<float>::infinity(), kUnseen});
  wavefront_.position.resize(narrow() ? count : 0);
  wavefront_.costly.assign(narrow() ? count : 0, 0);
  wavefront_.heap.clear();
  enter(Stage::mark_free_nodes);
}

void CostToGo::end_propagation(const OccupancyMap& map) {
  const bool reached = wavefront_reached(progress_.robot_world);
  if (!reached && far_field_) {  // it may be too old, or too coarse
    progress_.fine = far_field_->map_revision_ >= map_revision_;
    far_field_.reset();
    open_window(map);
    return;
  }
  if (!reached && !whole_map_ && !progress_.everywhere) {
    progress_.everywhere = true;
    open_window(map);
    return;
  }
  const bool at_goal = goal_used_ == goal_asked_;
  outcome_ = !reached  ? CostToGoOutcome::unreachable
             : at_goal ? CostToGoOutcome::reachable
                       : CostToGoOutcome::goal_moved;
  wavefront_.queue.clear();
  wavefront_.nearest_reached.assign(wavefront_.nodes.size(), kUnseen);
  parent_of_.clear();
  parent_of_.reserve(wavefront_.nodes.size());
  moved_.clear();
  bends_.clear();
  enter(Stage::find_reached);
}

/// Two free nodes must not be neighbours across a wall, however thin, so their distance stays below 2
/// clearance, diagonally and where either moves by half a spacing; but for a far field, which looks.
double CostToGo::spacing_on(const OccupancyMap& map) const {
  if (is_far_field_) return parameters_.resolution;
  const double safe_spacing =
      least_clearance_ > 0.0 ? (narrow() ? 0.9 : 1.4) * least_clearance_ : parameters_.resolution;
  return std::max(std::min(parameters_.resolution, safe_spacing), map.frame().resolution);
}

// Coarse nodes on the part of the map that the rectangle covers.
void CostToGo::set_window(const OccupancyMap& map, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  const GridFrame& frame = map.frame();
  const Eigen::Vector2d map_low = frame.origin_world;
  const Eigen::Vector2d map_high = frame.node_position(frame.width - 1, frame.height - 1);
  const double spacing = spacing_on(map);
  // Nodes lie on multiples of the spacing from the map's corner, so that they do not move with the window.
  const auto snapped = [&](const Eigen::Vector2d& corner) {
    const Eigen::Vector2d inside = corner.cwiseMax(map_low).cwiseMin(map_high);
    return Eigen::Vector2d{map_low + spacing * ((inside - map_low) / spacing).array().floor().matrix()};
  };
  whole_map_ = (low.array() <= map_low.array()).all() && (high.array() >= map_high.array()).all();
  const Eigen::Vector2d top = high.cwiseMin(map_high).cwiseMax(map_low);
  window_ = GridFrame::covering(snapped(low), top.cwiseMax(snapped(low)), spacing);
  window_.width = std::max(window_.width, 2);
  window_.height = std::max(window_.height, 2);
}

}  // namespace spf
