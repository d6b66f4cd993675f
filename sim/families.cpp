#include "sim/families.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "sim/geometry.hpp"
#include "sim/pedestrian_scene.hpp"
#include "sim/task_between.hpp"
#include "sim/tight_scenes.hpp"
#include "sim/traffic_scenes.hpp"
#include "sim/uniform_grid.hpp"
#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::sim {
namespace {

constexpr double kSidePerRoot = 5.0;          // [m] side of a FIELD over the root of its robots
constexpr double kRobotsPerStaticDisc = 4.0;  // [1] of a FIELD
constexpr int kMaxTries = 2000;               // within one group of shapes (docs/protocol.md)
constexpr int kMaxAttempts = 1000;  // scenes; our choice, so that an impossible layout ends with a message

Eigen::Vector2d draw_point(RandomStream& random, double half_width, double half_height) {
  const double x = random.uniform(-half_width, half_width);
  const double y = random.uniform(-half_height, half_height);
  return {x, y};
}

Eigen::Vector2d polar(double length, double angle) {
  return {length * std::cos(angle), length * std::sin(angle)};
}

/// Draws `count` things; `draw_one` returns false when its draw is rejected. False after kMaxTries tries.
template <class DrawOne>
bool draw_group(int count, DrawOne&& draw_one) {
  int tries = 0;
  for (int done = 0; done < count;) {
    if (++tries > kMaxTries) return false;
    if (draw_one()) ++done;
  }
  return true;
}

// ---- T2, T2-hard, F7

void draw_circle_of_robots(RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  const double phase = random.uniform(0.0, 2.0 * kPi);
  const double degree = kPi / 180.0;
  for (int i = 0; i < layout.robots; ++i) {
    const double angle = phase + 2.0 * kPi * i / layout.robots + random.uniform(-5.0 * degree, 5.0 * degree);
    const Eigen::Vector2d start = polar(layout.circle_radius, angle);
    scenario.robots.push_back(task_between(start, -start));
  }
}

bool draw_square(RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  constexpr double kGap = 1.2;     // [m] between squares
  constexpr double kEndGap = 2.0;  // [m] from a start or goal
  const Eigen::Vector2d center = draw_point(random, layout.squares_within, layout.squares_within);
  const Box box = square(center, random.uniform(layout.square_side_low, layout.square_side_high));
  for (const Box& other : scenario.boxes)
    if (distance_between_boxes(box, other) < kGap) return false;
  for (const RobotTask& task : scenario.robots)
    if (distance_to_box(task.start.position_world, box) < kEndGap ||
        distance_to_box(task.goal_world, box) < kEndGap)
      return false;
  scenario.boxes.push_back(box);
  return true;
}

/// The radius is drawn last, and only where the family varies it.
double draw_radius(RandomStream& random, const LayoutParameters& layout) {
  if (layout.disc_radius_low >= layout.disc_radius_high) return layout.disc_radius_low;
  return random.uniform(layout.disc_radius_low, layout.disc_radius_high);
}

bool draw_disc(RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  constexpr double kStartGap = 3.0;  // [m] centre to start
  constexpr double kBoxGap = 0.2;    // [m] surface to square: 0.6 m from the centre in T2
  constexpr double kDiscGap = 1.0;   // [m] centre to centre
  ObstacleState disc;
  disc.position_world = draw_point(random, layout.discs_within, layout.discs_within);
  const double speed = random.uniform(layout.disc_speed_low, layout.disc_speed_high);
  disc.velocity_world = polar(speed, random.uniform(0.0, 2.0 * kPi));
  disc.radius = draw_radius(random, layout);
  for (const RobotTask& task : scenario.robots)
    if ((disc.position_world - task.start.position_world).norm() < kStartGap) return false;
  for (const Box& box : scenario.boxes)
    if (distance_to_box(disc.position_world, box) < disc.radius + kBoxGap) return false;
  for (const ObstacleState& other : scenario.moving)
    if ((disc.position_world - other.position_world).norm() < kDiscGap) return false;
  scenario.moving.push_back(disc);
  return true;
}

bool draw_crossing(RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  scenario.border = square(Eigen::Vector2d::Zero(), 2.0 * layout.half_field);
  draw_circle_of_robots(random, layout, scenario);
  return draw_group(layout.squares, [&] { return draw_square(random, layout, scenario); }) &&
         draw_group(layout.discs, [&] { return draw_disc(random, layout, scenario); });
}

// ---- P8

constexpr double kArenaWidth = 1.374;   // [m] along x, the short side
constexpr double kArenaLength = 2.432;  // [m] along y

void place_platform(const LayoutParameters& layout, Scenario& scenario) {
  constexpr double kWallGap = 0.12;  // [m] from the short side's wall to the robots' centres
  const Eigen::Vector2d half{0.5 * kArenaWidth, 0.5 * kArenaLength};
  scenario.border = Box{-half, half};
  for (const double third : {-1.0 / 6.0, 1.0 / 6.0})
    scenario.seams.push_back({{-half.x(), third * kArenaLength}, {half.x(), third * kArenaLength}});
  const int below = (layout.robots + 1) / 2;
  for (int i = 0; i < layout.robots; ++i) {
    const bool low = i < below;
    const int column = low ? i : i - below;
    const int columns = low ? below : layout.robots - below;
    const double x = kArenaWidth * ((column + 0.5) / columns - 0.5);
    const double y = (low ? -1.0 : 1.0) * (half.y() - kWallGap);
    scenario.robots.push_back(task_between({x, y}, {x, -y}));
  }
}

bool draw_block(RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  constexpr double kGap = 0.16;  // [m] between blocks, and to the walls
  const Eigen::Vector2d center = draw_point(random, 0.5 * kArenaWidth, layout.squares_within);
  const Box box = square(center, random.uniform(layout.square_side_low, layout.square_side_high));
  if (std::min(depth_inside(box.low, *scenario.border), depth_inside(box.high, *scenario.border)) < kGap)
    return false;
  for (const Box& other : scenario.boxes)
    if (distance_between_boxes(box, other) < kGap) return false;
  scenario.boxes.push_back(box);
  return true;
}

bool draw_platform_disc(RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  constexpr double kStartGap = 0.3;  // [m] centre to start
  constexpr double kGap = 0.03;      // [m] surface to block, wall or disc
  ObstacleState disc;
  disc.position_world = draw_point(random, 0.5 * kArenaWidth, layout.discs_within);
  const double speed = random.uniform(layout.disc_speed_low, layout.disc_speed_high);
  disc.velocity_world = polar(speed, random.uniform(0.0, 2.0 * kPi));
  disc.radius = draw_radius(random, layout);
  if (depth_inside(disc.position_world, *scenario.border) < disc.radius + kGap) return false;
  for (const RobotTask& task : scenario.robots)
    if ((disc.position_world - task.start.position_world).norm() < kStartGap) return false;
  for (const Box& box : scenario.boxes)
    if (distance_to_box(disc.position_world, box) < disc.radius + kGap) return false;
  for (const ObstacleState& other : scenario.moving)
    if ((disc.position_world - other.position_world).norm() < disc.radius + other.radius + kGap) return false;
  scenario.moving.push_back(disc);
  return true;
}

bool draw_platform(RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  place_platform(layout, scenario);
  return draw_group(layout.squares, [&] { return draw_block(random, layout, scenario); }) &&
         draw_group(layout.discs, [&] { return draw_platform_disc(random, layout, scenario); });
}

// ---- SWAP, FIELD

bool draw_swap(RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  const double spacing = 2.0 * kPi / layout.robots;
  const double radius = layout.circle_per_robot * layout.robots / (2.0 * kPi);
  for (int i = 0; i < layout.robots; ++i) {
    const Eigen::Vector2d start = polar(radius, spacing * (i + random.uniform(-0.2, 0.2)));
    scenario.robots.push_back(task_between(start, -start));
  }
  return true;
}

bool is_free(const Eigen::Vector2d& position, const std::vector<Eigen::Vector2d>& taken, double center_gap) {
  for (const Eigen::Vector2d& other : taken)
    if ((position - other).squaredNorm() < center_gap * center_gap) return false;
  return true;
}

bool draw_field(RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  constexpr double kGap = 1.0;               // [m] between surfaces of starts, of goals, and around discs
  constexpr double kNearGoal = 10.0;         // [m]
  constexpr double kFarGoal = 30.0;          // [m]
  constexpr double kStaticDiscRadius = 0.5;  // [m]
  constexpr double kMargin = 1.0;            // [m] between the square of starts and goals and the border
  const double half = 0.5 * kSidePerRoot * std::sqrt(static_cast<double>(layout.robots));
  const double center_gap = kGap + 2.0 * scenario.largest_radius();
  scenario.border = square(Eigen::Vector2d::Zero(), 2.0 * (half + kMargin));

  std::vector<Eigen::Vector2d> starts;
  std::vector<Eigen::Vector2d> goals;
  for (int i = 0; i < layout.robots; ++i) {
    const bool placed =
        draw_group(1, [&] {  // start and goal together, since in a small field some starts admit no goal
          const Eigen::Vector2d start = draw_point(random, half, half);
          const Eigen::Vector2d goal = draw_point(random, half, half);
          const double distance = (goal - start).norm();
          if (distance < kNearGoal || distance > kFarGoal) return false;
          if (!is_free(start, starts, center_gap) || !is_free(goal, goals, center_gap)) return false;
          starts.push_back(start);
          goals.push_back(goal);
          return true;
        });
    if (!placed) return false;
    scenario.robots.push_back(task_between(starts.back(), goals.back()));
  }
  const double end_gap = kGap + kStaticDiscRadius + scenario.largest_radius();
  std::vector<Eigen::Vector2d> discs;
  const int count = static_cast<int>(static_cast<double>(layout.robots) / kRobotsPerStaticDisc);
  for (int i = 0; i < count; ++i) {
    const bool placed = draw_group(1, [&] {
      const Eigen::Vector2d center = draw_point(random, half, half);
      if (!is_free(center, starts, end_gap) || !is_free(center, goals, end_gap)) return false;
      if (!is_free(center, discs, kGap + 2.0 * kStaticDiscRadius)) return false;
      discs.push_back(center);
      return true;
    });
    if (!placed) return false;
    scenario.discs.push_back({discs.back(), kStaticDiscRadius});
  }
  return true;
}

bool draw_scene(Family family, RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  switch (family) {
    case Family::t2:
    case Family::t2_hard:
    case Family::f7:
      return draw_crossing(random, layout, scenario);
    case Family::p8:
      return draw_platform(random, layout, scenario);
    case Family::swap:
      return draw_swap(random, layout, scenario);
    case Family::field:
      return draw_field(random, layout, scenario);
    case Family::clutter:
      return draw_clutter(random, layout, scenario);
    case Family::doors:
      return layout.robots == 1 ? draw_doors(random, layout, scenario)
                                : draw_busy_door(random, layout, scenario);
    case Family::corridor:
      return draw_corridor(random, layout, scenario);
    case Family::ped:
      break;  // nothing is drawn: place_among_people()
  }
  return false;
}

/// An impossible layout ends with its message in seconds, however many robots and shapes it contains.
int attempts_for(const LayoutParameters& layout) {
  constexpr int kMostThings = 200'000;  // in all attempts together
  return std::clamp(kMostThings / (layout.robots + layout.squares + layout.discs + 1), 20, kMaxAttempts);
}

/// What of the layout found no room in a scene that could not be completed, with how much was wanted.
std::pair<std::string, int> what_did_not_fit(Family family, const LayoutParameters& layout,
                                             const Scenario& scenario) {
  const bool draws_shapes = family != Family::swap && family != Family::field;
  if (draws_shapes && scenario.boxes.size() < static_cast<std::size_t>(layout.squares))
    return {"squares", layout.squares};
  if (draws_shapes && scenario.moving.size() < static_cast<std::size_t>(layout.discs))
    return {"discs", layout.discs};
  return {"robots", layout.robots};
}

}  // namespace

Scenario make_scenario(const FamilySetup& setup, std::uint64_t seed, int trial) {
  const FamilySetup checked = validated(setup);
  require_robots_that_fit(checked);
  const std::uint64_t trial_seed = mix(seed, static_cast<std::uint64_t>(trial));
  const int attempts = attempts_for(checked.layout);
  std::pair<std::string, int> crowded;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    Scenario scenario;
    scenario.family = enum_name(checked.family);
    scenario.trial = trial;
    scenario.seed = seed;
    scenario.robot = checked.robot;
    scenario.fleet = checked.fleet;
    scenario.simulation = checked.simulation;
    if (checked.family == Family::ped) {
      if (!checked.crowd) throw std::invalid_argument{"the family ped needs a recorded crowd"};
      place_among_people(*checked.crowd, checked.layout, trial, scenario);
      return scenario;
    }
    RandomStream random{mix(trial_seed, static_cast<std::uint64_t>(attempt))};
    if (draw_scene(checked.family, random, checked.layout, scenario)) {
      give_kinds_in_turn(scenario);
      return scenario;
    }
    crowded = what_did_not_fit(checked.family, checked.layout, scenario);
  }
  const auto& [entry, wanted] = crowded;
  throw NoRoom{"no scene of family " + std::string{enum_name(checked.family)} + " found in " +
                   std::to_string(attempts) + " attempts: no room for " + std::to_string(wanted) + " " +
                   entry,
               entry};
}

}  // namespace spf::sim
