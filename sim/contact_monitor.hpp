// Detects contacts in a trial, tick by tick, and measures least distances (docs/protocol.md). Frame: world.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "sim/contact.hpp"
#include "sim/dynamic_obstacles.hpp"
#include "sim/robot_truth.hpp"

namespace spf::sim {

class ContactMonitor {
 public:
  explicit ContactMonitor(const Scenario& scenario);

  /// From now on with these static shapes.
  void change_shapes(const Scenario& scenario) {
    shapes_ = StaticShapes{scenario};
    free_.assign(free_.size(), {});
  }

  /// One tick, from `time` to time + dt [s]: the dynamic obstacles go from share_from to share_to of their
  /// step, the robots along their `motion`. Contacts found are appended to contacts(), by time within the
  /// tick.
  struct Tick {
    double time;
    double dt;
    double share_from;
    double share_to;
  };
  void check(const Tick& tick, const std::vector<RobotTruth>& robots,
             const std::vector<DynamicObstacle>& dynamic_obstacles);

  [[nodiscard]] const std::vector<Contact>& contacts() const { return contacts_; }
  /// Contacts of recorded people with a robot that had stood still for a second; people do not react, so
  /// these are not caused by the robot.
  [[nodiscard]] const std::vector<Contact>& hits_while_standing() const { return hits_while_standing_; }

  // Least values so far, of robots that had not yet arrived; infinite when there was nothing to measure to.
  [[nodiscard]] double dynamic_distance() const { return dynamic_distance_; }    ///< [m] centre to centre
  [[nodiscard]] double dynamic_clearance() const { return dynamic_clearance_; }  ///< [m] minus radii
  [[nodiscard]] double peer_clearance() const { return peer_clearance_; }  ///< [m] exact below kNearPeer

  /// Least gap of a robot to static shapes and border [m]; kFarStatic when it never came nearer.
  [[nodiscard]] double static_clearance(int robot) const {
    return static_clearance_[static_cast<std::size_t>(robot)];
  }

  static constexpr double kNearPeer = 1.0;   ///< [m] clearance beyond which peers are not checked
  static constexpr double kFarStatic = 3.0;  ///< [m] clearance beyond which static shapes are not checked

  [[nodiscard]] const StaticShapes& shapes() const { return shapes_; }

 private:
  void check_dynamic_obstacles(const Tick& tick, std::size_t robot, const RobotTruth& truth,
                               const std::vector<DynamicObstacle>& dynamic_obstacles);
  void check_static(const Tick& tick, std::size_t robot, const RobotTruth& truth);
  void check_peers(const Tick& tick, const std::vector<RobotTruth>& robots);
  void check_pair(const Tick& tick, const std::vector<RobotTruth>& robots, std::size_t i, std::size_t j);
  void refresh_pairs(const std::vector<RobotTruth>& robots);
  void forgive_newcomers(const std::vector<RobotTruth>& robots,
                         const std::vector<DynamicObstacle>& dynamic_obstacles);
  void note_standing(double dt, const std::vector<RobotTruth>& robots);
  [[nodiscard]] Contact contact_of(const Tick& tick, double share, std::size_t robot,
                                   const RobotTruth& truth) const;

  /// A disc of positions known to be free of static contact.
  struct FreeDisc {
    Eigen::Vector2d center = Eigen::Vector2d::Zero();  // [m]
    double radius = -1.0;                              // [m]
    /// Lower bound of the clearance at a position [m].
    [[nodiscard]] double bound(const Eigen::Vector2d& position) const {
      return radius - (position - center).norm();
    }
  };

  double largest_radius_;  // [m]
  StaticShapes shapes_;
  std::vector<FreeDisc> free_;                              // by robot
  std::vector<double> static_clearance_;                    // [m] by robot
  std::vector<Eigen::Vector2d> centers_;                    // of the robots when pairs_ was made
  UniformGrid grid_;                                        // over centers_
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;  // that may come near before centers_ are too old
  std::vector<Contact> contacts_;
  std::vector<Contact> hits_while_standing_;
  std::vector<bool> touching_static_;                 // by robot: counted once while it lasts
  std::vector<double> standing_time_;                 // [s] by robot
  std::set<int> people_present_;                      // ids in the last tick
  std::set<std::pair<int, int>> forgiven_;            // (robot, person): appeared too near, has not left yet
  std::set<std::pair<int, int>> touching_obstacles_;  // (robot, obstacle): counted once while it lasts
  std::set<std::pair<int, int>> touching_pairs_;      // robots that have touched: counted once
  double dynamic_distance_;
  double dynamic_clearance_;
  double peer_clearance_;
};

}  // namespace spf::sim
