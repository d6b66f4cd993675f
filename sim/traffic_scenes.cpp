#include "sim/traffic_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/task_between.hpp"

namespace spf::sim {
namespace {

constexpr double kHalfLength = 6.0;  // [m] of both rooms together for two robots
constexpr double kHalfWidth = 4.0;   // [m]
constexpr double kLonger = 0.25;     // [m] each further robot
constexpr double kWider = 0.1;       // [m]
constexpr double kDoorClear = 2.0;   // [m] from starts and goals to the ends of the passage
constexpr double kWallClear = 0.3;   // [m] from the surface of a robot at its start or goal to a wall
constexpr double kApart = 0.4;       // [m] between the surfaces of two of them
constexpr double kMostOff = 0.5;     // [1] of kHalfWidth: how far the passage is from the middle
constexpr int kMostTries = 2000;

/// Two rooms beside each other along x, joined by a passage.
struct TwoRooms {
  double half_length = 0.0;    // [m]
  double half_width = 0.0;     // [m]
  double low_wall = 0.0;       // [m] x of the left room's inner wall
  double high_wall = 0.0;      // [m] x of the right one's
  double middle = 0.0;         // [m] y of the passage
  double passage_width = 0.0;  // [m]
};

void build(const TwoRooms& rooms, Scenario& scenario) {
  scenario.border = Box{{-rooms.half_length, -rooms.half_width}, {rooms.half_length, rooms.half_width}};
  const double half = 0.5 * rooms.passage_width;
  scenario.boxes.push_back({{rooms.low_wall, rooms.middle + half}, {rooms.high_wall, rooms.half_width}});
  scenario.boxes.push_back({{rooms.low_wall, -rooms.half_width}, {rooms.high_wall, rooms.middle - half}});
}

/// A position in the left (-1) or right (1) room, away from what is taken and from the passage.
bool draw_position(RandomStream& random, const TwoRooms& rooms, int side, double radius,
                   std::vector<Eigen::Vector2d>& taken) {
  const double wall = side < 0 ? rooms.low_wall : rooms.high_wall;
  const double outer = side * (rooms.half_length - radius - kWallClear);
  const double inner = wall + side * (radius + kWallClear);
  const double most_y = rooms.half_width - radius - kWallClear;
  const Eigen::Vector2d end{wall, rooms.middle};
  for (int tries = 0; tries < kMostTries; ++tries) {
    const double x = random.uniform(std::min(inner, outer), std::max(inner, outer));
    const Eigen::Vector2d point{x, random.uniform(-most_y, most_y)};
    bool free = (point - end).norm() >= kDoorClear + radius;
    for (const Eigen::Vector2d& other : taken) free = free && (point - other).norm() >= 2.0 * radius + kApart;
    if (!free) continue;
    taken.push_back(point);
    return true;
  }
  return false;
}

bool place_robots(RandomStream& random, const TwoRooms& rooms, int robots, Scenario& scenario) {
  const double radius = scenario.largest_radius();
  std::vector<Eigen::Vector2d> starts;
  std::vector<Eigen::Vector2d> goals;
  for (int i = 0; i < robots; ++i) {
    const int side = i % 2 == 0 ? -1 : 1;
    if (!draw_position(random, rooms, side, radius, starts)) return false;
    if (!draw_position(random, rooms, -side, radius, goals)) return false;
    scenario.robots.push_back(task_between(starts.back(), goals.back()));
  }
  return true;
}

bool draw_rooms(RandomStream& random, int robots, double length, double width, Scenario& scenario) {
  TwoRooms rooms;
  rooms.half_length = kHalfLength + kLonger * (robots - 2) + 0.5 * length;
  rooms.half_width = kHalfWidth + kWider * (robots - 2);
  rooms.low_wall = -0.5 * length;
  rooms.high_wall = 0.5 * length;
  rooms.middle = random.uniform(-kMostOff, kMostOff) * rooms.half_width;
  rooms.passage_width = width;
  if (0.5 * width + std::fabs(rooms.middle) >= rooms.half_width) return false;
  build(rooms, scenario);
  return place_robots(random, rooms, robots, scenario);
}

}  // namespace

bool draw_busy_door(RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  const double width = random.uniform(layout.door_width_low, layout.door_width_high);
  const double wall = random.uniform(layout.wall_thickness_low, layout.wall_thickness_high);
  return draw_rooms(random, layout.robots, wall, width, scenario);
}

bool draw_corridor(RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  const double width = random.uniform(layout.corridor_width_low, layout.corridor_width_high);
  const double length = random.uniform(layout.corridor_length_low, layout.corridor_length_high);
  return draw_rooms(random, layout.robots, length, width, scenario);
}

}  // namespace spf::sim
