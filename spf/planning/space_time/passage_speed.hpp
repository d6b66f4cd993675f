// Speed that follows clearance: a slow robot tracks its path more exactly, so where the guide's path is
// narrow the robot goes as slowly as the gap needs, and brakes for it in time. Where the path leads through
// something that stands, the robot stops in front of it. Frame: world.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "spf/planning/planner.hpp"
#include "spf/planning/space_time/space_time_parameters.hpp"
#include "spf/robot/footprint.hpp"
#include "spf/world/standing.hpp"

namespace spf {

/// Standard deviation [m] of the robot's position across its path, at a speed [m/s].
[[nodiscard]] double path_sigma(double static_sigma, double position_sigma, double speed, double max_speed);
inline constexpr double kStillPace = 0.15;     ///< [1] of max_speed: below, slower is not more exact
inline constexpr double kSurfaceSigmas = 4.0;  ///< [1] as far from a surface there is no risk

class PassageSpeed {
 public:
  PassageSpeed(const SpaceTimeParameters& parameters, const RobotParameters& robot);

  /// Looks along the guide, which must be ready, as far as the robot can come within the horizon and then
  /// stop. Allocates only for a path of more corners than ever before.
  void prepare(const PlanRequest& request);

  /// Whether anything on the path is narrow.
  [[nodiscard]] bool limits() const { return !marks_.empty(); }
  /// Largest speed [m/s] where `cost_to_go` [m] is left; infinite where nothing limits it.
  [[nodiscard]] double limit(double cost_to_go) const;
  /// Unit vector along the path from a position beside it, at a speed [m/s]: towards a point ahead, so that
  /// turns begin in time and slow robots keep exactly to the corners, round which the guide's gradient leads
  /// a little too early. None far from the path, and where nothing is narrow.
  [[nodiscard]] std::optional<Eigen::Vector2d> direction(const Eigen::Vector2d& position_world,
                                                         double speed) const;
  /// What stands on the guide's path; null: nothing.
  [[nodiscard]] const StandingDisc* blocked_by() const { return blocker_; }
  /// The robot has to stop on its path, before that or to let others pass.
  [[nodiscard]] bool stands_before() const { return waits_ || blocker_ != nullptr; }
  /// What is left to go [m] for who wants to get on: to come nearer to something that stands in the way than
  /// where the robot stops is no progress.
  [[nodiscard]] double left_to_go(double cost_to_go) const {
    if (cost_to_go >= stop_cost_ || cost_to_go <= exit_cost_) return cost_to_go;
    return waits_ ? 2.0 * stop_cost_ - cost_to_go : stop_cost_;  // who is to let others pass makes room
  }
  /// How much longer [s] what is left to go (`left_to_go`) takes than at full speed, as far as the robot can
  /// come: its narrow places, its turns, and the braking before them; 0 where nothing is narrow. Without it
  /// who has a tight place to pass puts that off, beyond the horizon, for ever.
  [[nodiscard]] double delay(double left) const;
  /// The robot is nearer to a passage than it may wait.
  [[nodiscard]] bool in_the_way(double cost_to_go) const {
    return waits_ && cost_to_go < stop_cost_ - kTooNear * robot_.radius;
  }

  static constexpr double kTooNear = 0.7;  ///< [1] of the radius

 private:
  /// Beyond the margin to the nearest surface, and to the nearest of what stands [m].
  struct Room {
    double at_surface = 0.0;
    double at_standing = std::numeric_limits<double>::infinity();
    const StandingDisc* beside = nullptr;

    [[nodiscard]] double least() const { return std::min(at_surface, at_standing); }
  };
  struct Mark {
    Eigen::Vector2d position_world;
    double cost;   // [m]
    double speed;  // [m/s]
    Room room;
    double delay = 0.0;  // [s] from here to the last mark
    double along = 0.0;  // [m] of the path, from the first mark
  };
  struct Leg {
    Eigen::Vector2d from_world;
    Eigen::Vector2d direction_world;
    double length;  // [m]
  };
  [[nodiscard]] double reach() const;
  void keep_legs();
  [[nodiscard]] Room room_at(const PlanRequest& request, const Eigen::Vector2d& position_world,
                             const Eigen::Vector2d& ahead) const;
  [[nodiscard]] double straight_speed(const PlanRequest& request, double room) const;
  /// First mark with at most so much left to go.
  [[nodiscard]] std::vector<Mark>::const_iterator mark_at(double cost_to_go) const;
  template <class Look>
  void look_along(const Look& look) const;
  void slow_down_in_turns();
  void leave_room_to_brake();
  void add_delays();
  void stop_before_what_stands();

  SpaceTimeParameters parameters_;
  RobotParameters robot_;
  Footprint footprint_;
  std::vector<Eigen::Vector2d> path_;
  std::vector<Leg> legs_;    // of the path, as far as the robot can come
  std::vector<Mark> marks_;  // by falling cost, at most a third of the radius apart
  const StandingDisc* blocker_ = nullptr;
  bool waits_ = false;
  double stop_cost_ = 0.0;  // [m] where the robot stops before something that stands; 0: nothing does
  double exit_cost_ = 0.0;  // [m] behind it
};

}  // namespace spf
