// Where robots go after they have reached a goal: to the next of their list, round and round through it, or
// to a place drawn anew. Frame: world.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "sim/contact.hpp"
#include "sim/scenario.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::sim {

class GoalSource {
 public:
  explicit GoalSource(const Scenario& scenario);

  /// The goal after the one that the robot has reached at `from` [m]; none after the last. A drawn one can be
  /// reached from there, and where that can be had it is apart from the goals of others, `taken` by robot.
  /// Every robot draws from a stream of its own.
  std::optional<host::Goal> next(std::size_t robot, const Eigen::Vector2d& from,
                                 const std::vector<std::optional<host::Goal>>& taken);

 private:
  struct Itinerary {
    std::vector<host::Goal> goals;  // the first one among them
    std::size_t reached = 0;        // index of the last one
    double radius = 0.0;            // [m] of the robot
    RandomStream random{0};
  };
  void find_free_places(const Scenario& scenario);
  void flood(std::size_t node, int part);
  [[nodiscard]] std::optional<std::size_t> place_near(const Eigen::Vector2d& point) const;
  [[nodiscard]] Eigen::Vector2d position(std::size_t node) const;
  [[nodiscard]] host::Goal draw(std::size_t robot, const Eigen::Vector2d& from,
                                const std::vector<std::optional<host::Goal>>& taken);

  GoalSupply supply_;
  std::vector<Itinerary> itineraries_;  // by robot

  // A lattice of places where the largest robot fits, in parts that are not connected. Only of drawn goals.
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();  // [m] its first node
  double spacing_ = 0.0;                           // [m]
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<int> part_of_;                     // by node; kBlocked, or which part
  std::vector<std::vector<std::size_t>> parts_;  // their nodes
};

}  // namespace spf::sim
