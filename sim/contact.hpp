// Contacts: shapes that touch while they move. Everything is swept: within a step each shape moves linearly,
// and the least distance over the step is exact. Frame: world.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "sim/outlines.hpp"
#include "sim/scenario.hpp"
#include "sim/uniform_grid.hpp"
#include "spf/math/convex_polygon.hpp"
#include "spf/math/parameters.hpp"

namespace spf {
namespace sim {

enum class ContactWith { moving, person, robot, box, disc, wall, border, polygon, map };

}  // namespace sim

/// The words are those of result files and do not change: moving discs are called discs there, static discs
/// pillars.
template <>
struct EnumNames<sim::ContactWith> {
  static constexpr std::array<std::pair<sim::ContactWith, const char*>, 9> values{
      {{sim::ContactWith::moving, "disc"},
       {sim::ContactWith::person, "person"},
       {sim::ContactWith::robot, "robot"},
       {sim::ContactWith::box, "box"},
       {sim::ContactWith::disc, "pillar"},
       {sim::ContactWith::wall, "wall"},
       {sim::ContactWith::border, "border"},
       {sim::ContactWith::polygon, "polygon"},
       {sim::ContactWith::map, "map"}}};
};

}  // namespace spf

namespace spf::sim {

/// Which robot touched what, when, and how fast both were.
struct Contact {
  double time = 0.0;  ///< [s]
  int robot = -1;
  ContactWith with = ContactWith::border;
  int other = -1;  ///< robot number, id of the moving disc or person, index of the box, disc, wall or
                   ///< polygon; -1 = the border or the map
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m] of the robot
  double robot_speed = 0.0;                                  ///< [m/s]
  double other_speed = 0.0;                                  ///< [m/s]
};

/// Linear motion over one step.
struct Motion {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< [m]
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< [m]
  [[nodiscard]] Eigen::Vector2d at(double share) const { return from + share * (to - from); }
};

/// Least distance of two moving points over a step [m].
[[nodiscard]] double swept_distance(const Motion& a, const Motion& b);
/// Share of the step in [0, 1] at which two moving points are first nearer than `distance`.
[[nodiscard]] std::optional<double> first_within(const Motion& a, const Motion& b, double distance);

struct BodyMotion;

/// Clearances to the static shapes of a scenario. Far shapes are skipped by means of a grid of their
/// positions.
class StaticShapes {
 public:
  explicit StaticShapes(const Scenario& scenario);

  /// Distance from a robot's centre to the nearest static surface minus its radius, the border included [m];
  /// anything above `far` reads `far`.
  [[nodiscard]] double clearance(const Eigen::Vector2d& position_world, double radius,
                                 double far = kFar) const;
  static constexpr double kFar = 10.0;  ///< [m]

  /// The first contact of a disc that moves over one step, with `time` as the share of the step in [0, 1].
  [[nodiscard]] std::optional<Contact> first_contact(const Motion& motion, double radius) const;

  // Likewise of a robot with corners, whose outline lies within `radius` [m] of `centre`.
  [[nodiscard]] double clearance(const ConvexPolygon& outline, const Eigen::Vector2d& centre, double radius,
                                 double far = kFar) const;
  [[nodiscard]] std::optional<Contact> first_contact(const BodyMotion& motion) const;

 private:
  struct Shape {
    ContactWith kind;
    int index;
  };
  [[nodiscard]] double distance_to(const Shape& shape, const Eigen::Vector2d& position) const;
  [[nodiscard]] double swept_distance_to(const Shape& shape, const Motion& motion) const;
  [[nodiscard]] double distance_to(const Shape& shape, const ConvexPolygon& outline) const;

  std::optional<Box> border_;
  std::vector<Box> boxes_;
  std::vector<Disc> discs_;
  std::vector<Segment> walls_;
  std::vector<Shape> shapes_;
  std::vector<Eigen::Vector2d> centers_;  // of the shapes
  double reach_ = 0.0;                    // [m] largest distance from a shape's centre to its surface
  UniformGrid grid_;
  Outlines outlines_;
};

}  // namespace spf::sim
