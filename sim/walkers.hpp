// The people of a scene that walk from waypoint to waypoint, in steps of 0.1 s within which each moves
// linearly. Deterministic: equal scenarios, and robots that move equally, give equal people. Frame: world,
// SI.
#pragma once

#include <string>
#include <vector>

#include "sim/contact.hpp"
#include "sim/person_task.hpp"
#include "sim/walker.hpp"

namespace spf::sim {

/// What people avoid besides each other.
struct RoundBody : Body {
  double radius = 0.0;  ///< [m]
};

class Walkers {
 public:
  static constexpr double kStep = 0.1;  ///< [s]

  explicit Walkers(const Scenario& scenario);

  [[nodiscard]] bool empty() const { return people_.empty(); }
  [[nodiscard]] std::size_t size() const { return people_.size(); }
  /// Begins the next step among these bodies.
  void advance(const std::vector<RoundBody>& others);
  /// Puts somebody elsewhere [m], from where he or she walks on; nobody where there is no such person.
  void place(std::size_t person, const Eigen::Vector2d& position_world);
  /// From now on among these static shapes, on the ways of `scenario` with as many waypoints as before, and
  /// with the people that it has more than there are.
  void change(const Scenario& scenario);
  /// Over the current step; at the beginning where everybody starts.
  [[nodiscard]] const Motion& motion(std::size_t person) const { return people_[person].motion; }
  [[nodiscard]] double radius(std::size_t person) const { return people_[person].task.radius; }

 private:
  struct Person {
    PersonTask task;
    Body body;
    Motion motion;
    std::size_t next = 0;  // the waypoint ahead
    bool backwards = false;
    bool done = false;
  };
  void add(const Scenario& scenario, std::size_t index);
  void choose_start(const Scenario& scenario, std::size_t index, Person& person) const;
  void pass_waypoint(Person& person) const;
  void follow_path(Person& person, double distance) const;
  [[nodiscard]] Eigen::Vector2d wanted_velocity(Person& person) const;
  [[nodiscard]] Eigen::Vector2d acceleration_of(const Person& person, const Eigen::Vector2d& wanted,
                                                const std::vector<RoundBody>& others) const;
  [[nodiscard]] Eigen::Vector2d away_from_surfaces(const Eigen::Vector2d& position) const;
  void keep_out_of_walls(Person& person) const;

  StaticShapes shapes_;
  std::vector<Person> people_;
};

/// Where a person's path leads through something static, in words, naming the waypoints; "" when nowhere.
[[nodiscard]] std::string blocked_path(const PersonTask& task, const StaticShapes& shapes);

}  // namespace spf::sim
