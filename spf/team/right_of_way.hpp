// Who goes first through a passage that is too narrow for two: robots that come to a door or a corridor of
// one lane tell each other (PassageClaim), go through in one direction at a time, and wait beside its mouth
// meanwhile. Every robot decides by itself, by the same rule and from the same messages. Frame: world.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "spf/planning/cost_to_go.hpp"
#include "spf/planning/planner.hpp"
#include "spf/robot/robot_parameters.hpp"
#include "spf/world/passage_claim.hpp"
#include "spf/world/priority.hpp"

namespace spf {

class RightOfWay {
 public:
  /// `gives_way`: the robot's method stops where it is told to; else only its claims are told.
  RightOfWay(const RobotParameters& robot, bool gives_way) : robot_{robot}, gives_way_{gives_way} {}

  void reconfigure(const RobotParameters& robot, bool gives_way) {
    robot_ = robot;
    gives_way_ = gives_way;
  }

  /// Looks along the guide's path from `here` [m] on, and at what the peers claim, at a time [s].
  void update(double time, const Eigen::Vector2d& here, const CostToGo& guide, const WorldSnapshot& world);
  /// The robot stops for another cause: it wants nothing, unless it is in a passage already.
  void stop();

  /// To be told to the peers; none where the path is wide, and where nobody hears it.
  [[nodiscard]] const std::optional<PassageClaim>& claim() const { return claim_; }
  /// Where the robot has to wait; none while it may go on.
  [[nodiscard]] const std::optional<GiveWay>& give_way() const { return give_way_; }

 private:
  enum class Side { unknown, own, other };
  /// A claim's rank in the order in which all would be served if they came from one side.
  struct Turn {
    Rank rank;
    double since = 0.0;  // [s]
  };
  struct Rivals {
    Turn with;                           // the first of the robot's own direction
    std::optional<Turn> against;         // the first of the other one
    std::optional<Turn> inside_against;  // one who is inside and comes towards the robot
    double against_gap = 0.0;            // [m] from the nearest of the other direction to its entry
    bool inside_with = false;            // somebody is inside who goes like the robot
    int nearer = 0;                      // those that go the same way and are nearer to the entry
    int in_front = -1;                   // one of them
    bool stalemate = false;              // somebody from the other side has waited for long
  };
  struct Narrow {
    Eigen::Vector2d entry;  // [m]
    Eigen::Vector2d exit;   // [m]
    double ahead;           // [m] along the path to the entry, not positive inside
    double through;         // [m] along the path to the exit
  };
  [[nodiscard]] std::optional<Narrow> next_narrow(const Eigen::Vector2d& here, const CostToGo& guide,
                                                  const OccupancyMap& map);
  [[nodiscard]] double side_room(const OccupancyMap& map, const Eigen::Vector2d& position,
                                 const Eigen::Vector2d& direction, double enough) const;
  [[nodiscard]] std::optional<Eigen::Vector2d> narrow_axis(const OccupancyMap& map,
                                                           const Eigen::Vector2d& position,
                                                           const Eigen::Vector2d& along) const;
  [[nodiscard]] double claim_distance() const;
  void renew_claim(double time, const Eigen::Vector2d& here, const std::optional<Narrow>& narrow);
  void clear();
  [[nodiscard]] Rivals rivals(const WorldSnapshot& world, double time) const;
  void look_in_front(const WorldSnapshot& world, double time, const Eigen::Vector2d& here,
                     Rivals& rivals) const;
  [[nodiscard]] bool through_before(double gap, const Narrow& narrow) const;
  [[nodiscard]] bool own_side_goes(const Rivals& rivals) const;
  [[nodiscard]] static bool earlier(const Turn& one, const Turn& other);
  [[nodiscard]] static bool in_batch(const Turn& turn, const Turn& other);
  [[nodiscard]] int whom_to_let_pass(const WorldSnapshot& world, double time, const Eigen::Vector2d& here,
                                     const Narrow& narrow);
  [[nodiscard]] bool meets(const Peer& peer, double time) const;
  [[nodiscard]] bool goes_same_way(const PassageClaim& other) const;

  RobotParameters robot_;
  bool gives_way_;
  double peer_radius_ = 0.0;  // [m] the largest
  double wait_at_ = 0.0;      // [1] of the radius, before the entry
  bool queues_ = false;       // it waits for one who goes the same way
  std::vector<Eigen::Vector2d> path_;
  std::optional<PassageClaim> claim_;
  Side with_turn_ = Side::unknown;  // of which direction the last was that was seen in the passage
  std::optional<GiveWay> give_way_;
};

}  // namespace spf
