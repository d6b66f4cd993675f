#include "spf/team/guide_policy.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "spf/math/segment.hpp"
#include "spf/robot/footprint.hpp"
#include "spf/team/schedule.hpp"

namespace spf {
namespace {

/// How much less room [m] to either side a robot needs that drives along its heading than the disc around it.
double saved_by_heading(const RobotParameters& robot) {
  return robot.radius - Footprint{robot}.half_width();
}

constexpr double kBeside = 0.4;  // [1] of the radius: what stands so near to the path slows the robot down

}  // namespace

CostToGo make_guide(const AgentParameters& parameters, const GuideNeeds& needs) {
  if (!needs.passes_narrow_gaps) return CostToGo{parameters.guide, parameters.robot.radius};
  // Where there is room it keeps its corners away from everything; it fits through where its width does.
  return CostToGo{parameters.guide, parameters.robot.radius,
                  parameters.space_time.static_margin - saved_by_heading(parameters.robot)};
}

GuidePolicy::GuidePolicy(const AgentParameters& parameters, const GuideNeeds& needs, double time)
    : needs_{needs},
      goal_tolerance_{parameters.team.goal_tolerance},
      cost_to_go_{make_guide(parameters, needs)},
      next_{cost_to_go_},
      max_speed_{parameters.robot.max_speed},
      saved_{saved_by_heading(parameters.robot)},
      beside_{kBeside * parameters.robot.radius},
      next_time_{time} {}

void GuidePolicy::reconfigure(const AgentParameters& parameters, const GuideNeeds& needs) {
  needs_ = needs;
  goal_tolerance_ = parameters.team.goal_tolerance;
  if (max_speed_ != parameters.robot.max_speed && !cost_to_go_.standing().empty()) goal_.reset();
  max_speed_ = parameters.robot.max_speed;
  beside_ = kBeside * parameters.robot.radius;
  saved_ = saved_by_heading(parameters.robot);
  CostToGo wanted = make_guide(parameters, needs);
  if (wanted.clearance() == cost_to_go_.clearance() &&
      wanted.least_clearance() == cost_to_go_.least_clearance() &&
      wanted.resolution() == cost_to_go_.resolution())
    return;
  cost_to_go_ = std::move(wanted);
  next_ = cost_to_go_;
  goal_.reset();
}

void GuidePolicy::refresh(double time, const WorldSnapshot& world, const Eigen::Vector2d& goal_world,
                          const Eigen::Vector2d& here) {
  const OccupancyMap& map = *world.map;
  if (!cost_to_go_.ready() || goal_ != goal_world) {
    start(world, goal_world, here);
    update_time_ = time;
    next_time_ = time + kPeriod;
    return;
  }
  if (!next_.under_way()) {
    if (!is_due(next_time_, time) || !wants_update(time, world, here)) return;
    next_.set_standing(standing_, max_speed_);
    next_.share_far_field(cost_to_go_);
    next_.begin(map, goal_world, here);
    approaching_ = false;
    update_time_ = time;
    next_time_ = time + kPeriod;
  } else if (!urgent_) {
    urgent_ = hurries(map, here);
  }
  go_on(map, here);
}

bool GuidePolicy::goes_round() const {
  return cost_to_go_.least_clearance() < cost_to_go_.clearance();
}

/// For the present goal.
bool GuidePolicy::wants_update(double time, const WorldSnapshot& world, const Eigen::Vector2d& here) {
  if (goes_round()) choose_standing(world, here, true);
  urgent_ = differ(cost_to_go_.standing(), standing_);
  if (urgent_) return true;
  // What was newly sensed off the path makes no other path shorter: only one that is blocked cannot wait.
  urgent_ = hurries(*world.map, here);
  if (!urgent_ && !is_due(update_time_ + kIdlePeriod, time)) return false;
  return cut_off_ || cost_to_go_.outdated(*world.map, *goal_, here);
}

/// Whether the robot cannot go on as before for long.
bool GuidePolicy::hurries(const OccupancyMap& map, const Eigen::Vector2d& here) {
  return !cut_off_ && (cost_to_go_.leaves_near_field(here) || !path_clear(map, here));
}

/// A new goal: the robot needs the guide at once.
void GuidePolicy::start(const WorldSnapshot& world, const Eigen::Vector2d& goal_world,
                        const Eigen::Vector2d& here) {
  const OccupancyMap& map = *world.map;
  next_ = cost_to_go_.anew();
  if (goes_round()) choose_standing(world, here, false);
  cost_to_go_.set_standing(standing_, max_speed_);
  cost_to_go_.update(map, goal_world, here);
  if (goes_round()) {  // what stands on the new path
    choose_standing(world, here, cost_to_go_.ready());
    if (differ(cost_to_go_.standing(), standing_)) {
      cost_to_go_.set_standing(standing_, max_speed_);
      cost_to_go_.update(map, goal_world, here);
    }
  }
  // Without a path to the goal the robot goes as near as the shortest path through the walls leads, and waits
  // there.
  cut_off_ = cost_to_go_.outcome() == CostToGoOutcome::unreachable && needs_.approaches_cut_off_goal;
  if (cut_off_) cost_to_go_.update(map, last_free_position(cost_to_go_, map, here), here);
  goal_ = goal_world;
}

/// A slice of the update under way.
void GuidePolicy::go_on(const OccupancyMap& map, const Eigen::Vector2d& here) {
  std::int64_t slice =
      urgent_ ? kMostSlice : std::clamp(kSliceOfNode * next_.size(), kLeastSlice, kMostSlice);
  // It has outrun its near field, and the far one is no guide beside walls.
  if (cost_to_go_.beyond_near_field(here) && !next_.looks_everywhere())
    slice = std::numeric_limits<std::int64_t>::max();
  if (!next_.advance(map, slice)) return;
  const bool unreachable = next_.outcome() == CostToGoOutcome::unreachable && !approaching_;
  if (unreachable && needs_.approaches_cut_off_goal) {
    next_.begin(map, last_free_position(next_, map, here), here);
    approaching_ = true;
    return;
  }
  cut_off_ = approaching_;
  std::swap(cost_to_go_, next_);
  if (!map.sensed()) next_ = cost_to_go_.anew();  // frees its memory
}

/// The last position on the guide's path that keeps its clearance up to there; no nearer to the end of it
/// than the robot keeps where there is room.
Eigen::Vector2d GuidePolicy::last_free_position(const CostToGo& guide, const OccupancyMap& map,
                                                const Eigen::Vector2d& here) {
  guide.shortest_path(here, corners_);
  Eigen::Vector2d last = here;
  Eigen::Vector2d roomy = here;
  const auto end = [&] {
    const double nearer = (last - roomy).norm();
    return nearer < 2.0 * (guide.clearance() - guide.least_clearance()) ? roomy : last;
  };
  const double step = map.frame().resolution;
  for (std::size_t i = 1; i < corners_.size(); ++i) {
    const Eigen::Vector2d leg = corners_[i] - corners_[i - 1];
    const int steps = std::max(1, static_cast<int>(leg.norm() / step));
    for (int k = 1; k <= steps; ++k) {
      const Eigen::Vector2d position = corners_[i - 1] + leg * (static_cast<double>(k) / steps);
      const double room = needs_.passes_narrow_gaps ? map.exact_distance(position) : map.distance(position);
      if (room < guide.least_clearance()) return end();
      last = position;
      if (room >= guide.clearance()) roomy = position;
    }
  }
  return last;
}

bool GuidePolicy::path_clear(const OccupancyMap& map, const Eigen::Vector2d& here) {
  if (!cost_to_go_.ready() || cost_to_go_.outcome() == CostToGoOutcome::unreachable) return false;
  cost_to_go_.shortest_path(here, corners_);
  for (std::size_t i = 1; i < corners_.size(); ++i)
    if (!cost_to_go_.passable(map, corners_[i - 1], corners_[i])) return false;
  return true;
}

/// What stands on the path, or so near beside it that the robot slows down there, or stood on it when the
/// guide led round: all else changes no path.
void GuidePolicy::choose_standing(const WorldSnapshot& world, const Eigen::Vector2d& here, bool same_goal) {
  find_standing(world, standing_);
  for (StandingDisc& disc : standing_) disc.radius += saved_;  // they may turn, or go: the disc keeps away
  corners_.clear();
  if (same_goal) cost_to_go_.shortest_path(here, corners_);
  const auto matters = [&](const StandingDisc& disc) {
    return stands_on(corners_, disc) || known(cost_to_go_.standing(), disc);
  };
  standing_.erase(std::remove_if(standing_.begin(), standing_.end(),
                                 [&](const StandingDisc& disc) { return !matters(disc); }),
                  standing_.end());
  keep_nearest(here, standing_);
}

bool GuidePolicy::stands_on(const std::vector<Eigen::Vector2d>& path, const StandingDisc& disc) const {
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (distance_to_segment(disc.position_world, {path[i - 1], path[i]}) <
        disc.radius + cost_to_go_.least_clearance() + beside_)
      return true;
  }
  return false;
}

std::optional<GoalAccess> GuidePolicy::access(const Eigen::Vector2d& goal_world) const {
  if (goal_ != goal_world) return std::nullopt;
  if (cut_off_ || cost_to_go_.outcome() == CostToGoOutcome::unreachable) return GoalAccess::cut_off;
  if (cost_to_go_.outcome() == CostToGoOutcome::no_free_goal) return GoalAccess::blocked;
  // A robot that ends within its tolerance of the goal gets there all the same.
  const bool beside = (cost_to_go_.goal_used() - goal_world).norm() >= goal_tolerance_;
  return beside ? GoalAccess::blocked : GoalAccess::open;
}

bool GuidePolicy::goal_out_of_reach(const Eigen::Vector2d& here) const {
  if (cut_off_ || cost_to_go_.outcome() == CostToGoOutcome::unreachable ||
      cost_to_go_.outcome() == CostToGoOutcome::no_free_goal)
    return true;
  // As near to a goal on blocked ground as the path leads.
  return cost_to_go_.outcome() == CostToGoOutcome::goal_moved &&
         (here - cost_to_go_.goal_used()).norm() < goal_tolerance_;
}

}  // namespace spf
