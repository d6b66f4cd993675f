#include "sim/tight_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sim/task_between.hpp"

namespace spf::sim {
namespace {

// CLUTTER: columns along x between the walls, rows along y, from start to goal, which lie beyond.
constexpr int kColumns = 28;
constexpr int kRows = 30;
constexpr double kPitch = 0.15;  // [m] of the lattice; pillars are as wide
constexpr double kEnd = 5.0;     // [m] |y| of start and goal

/// The lattice of a clutter: true = a pillar.
class PillarGrid {
 public:
  PillarGrid(RandomStream& random, double fill) {
    for (bool& cell : cells_) cell = random.uniform(0.0, 1.0) < fill;
  }

  [[nodiscard]] bool at(int column, int row) const {
    return column >= 0 && column < kColumns && row >= 0 && row < kRows && cells_[slot(column, row)];
  }

  /// A pillar comes to stand among five, and one that has fewer than two beside it is taken away.
  void smooth() {
    const std::array<bool, kColumns* kRows> before = cells_;
    const auto there = [&](int column, int row) {
      return column >= 0 && column < kColumns && row >= 0 && row < kRows && before[slot(column, row)];
    };
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        int neighbours = there(column, row) ? -1 : 0;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) neighbours += there(column + dx, row + dy) ? 1 : 0;
        bool& cell = cells_[slot(column, row)];
        if (neighbours >= 5) cell = true;
        if (neighbours < 2) cell = false;
      }
  }

  [[nodiscard]] static Eigen::Vector2d position(int column, int row) {
    return {kPitch * (column - 0.5 * (kColumns - 1)), kPitch * (row - 0.5 * (kRows - 1))};
  }

 private:
  static std::size_t slot(int column, int row) { return static_cast<std::size_t>(row * kColumns + column); }
  std::array<bool, kColumns * kRows> cells_{};
};

/// Whether a disc of this radius gets from the start to the goal past all static discs: a wavefront on a fine
/// grid, whose steps may come nearer by half of their length.
bool passable(const Scenario& scenario, double radius) {
  constexpr double kStep = 0.025;  // [m]
  const double half_width = 0.5 * kPitch * (kColumns + 1);
  const int width = static_cast<int>(2.0 * half_width / kStep) + 1;
  const int height = static_cast<int>(2.0 * kEnd / kStep) + 1;
  std::vector<char> free(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1);
  const auto slot = [&](int i, int j) {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i);
  };
  for (const Disc& disc : scenario.discs) {
    const double reach = disc.radius + radius + 0.5 * kStep;
    const int low_i = std::max(0, static_cast<int>((disc.center.x() - reach + half_width) / kStep));
    const int high_i =
        std::min(width - 1, static_cast<int>((disc.center.x() + reach + half_width) / kStep) + 1);
    const int low_j = std::max(0, static_cast<int>((disc.center.y() - reach + kEnd) / kStep));
    const int high_j = std::min(height - 1, static_cast<int>((disc.center.y() + reach + kEnd) / kStep) + 1);
    for (int j = low_j; j <= high_j; ++j)
      for (int i = low_i; i <= high_i; ++i) {
        const Eigen::Vector2d node{i * kStep - half_width, j * kStep - kEnd};
        if ((node - disc.center).squaredNorm() < reach * reach) free[slot(i, j)] = 0;
      }
  }
  std::vector<Eigen::Vector2i> reached{{width / 2, 0}};
  free[slot(width / 2, 0)] = 0;
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const Eigen::Vector2i here = reached[next];
    if (here.y() == height - 1) return true;
    for (const auto& [dx, dy] : std::array<std::array<int, 2>, 4>{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}}) {
      const Eigen::Vector2i there = here + Eigen::Vector2i{dx, dy};
      if (there.x() < 0 || there.x() >= width || there.y() < 0 || there.y() >= height) continue;
      char& open = free[slot(there.x(), there.y())];
      if (open != 0) reached.push_back(there);
      open = 0;
    }
  }
  return false;
}

/// Half of the narrowest passage that a family promises [m], and the layout's key that says so.
std::pair<double, const char*> promised_room(const FamilySetup& setup) {
  switch (setup.family) {
    case Family::clutter:
      return {setup.layout.passable_radius, "passable_radius"};
    case Family::doors:
      return {0.5 * setup.layout.door_width_low, "door_width_low"};
    case Family::corridor:
      return {0.5 * setup.layout.corridor_width_low, "corridor_width_low"};
    default:
      return {std::numeric_limits<double>::infinity(), ""};
  }
}

}  // namespace

void require_robots_that_fit(const FamilySetup& setup) {
  if (setup.family == Family::clutter && setup.layout.robots != 1)
    throw NoRoom{"the family clutter has 1 robot, not " + std::to_string(setup.layout.robots), "robots"};
  const auto [open, key] = promised_room(setup);
  const double radius = largest_radius(setup.robot, setup.fleet);
  if (radius < open) return;
  std::ostringstream problem;
  problem << "a robot of radius " << radius << " m must be narrower than that";
  throw NoRoom{problem.str(), key};
}

bool draw_clutter(RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  const double fill = random.uniform(layout.fill_low, layout.fill_high);
  PillarGrid grid{random, fill};
  const int rounds = 2 + static_cast<int>(random.uniform(0.0, 3.0));
  for (int round = 0; round < rounds; ++round) grid.smooth();
  const double radius = 0.5 * kPitch;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      if (grid.at(column, row)) scenario.discs.push_back({PillarGrid::position(column, row), radius});
  const int end = static_cast<int>(std::ceil(kEnd / kPitch)) + 8;  // the walls go on beyond start and goal
  for (int row = -end; row <= end; ++row)
    for (const int column : {-1, kColumns})
      scenario.discs.push_back({{PillarGrid::position(column, 0).x(), kPitch * row}, radius});
  // Nobody goes round outside.
  const double side = PillarGrid::position(kColumns, 0).x();
  scenario.border = Box{{-side, -kPitch * end}, {side, kPitch * end}};
  scenario.robots.push_back(task_between({0.0, -kEnd}, {0.0, kEnd}));
  return passable(scenario, layout.passable_radius);
}

bool draw_doors(RandomStream& random, const LayoutParameters& layout, Scenario& scenario) {
  const Box kHall{{-6.0, -4.0}, {6.0, 4.0}};
  const double width = random.uniform(layout.door_width_low, layout.door_width_high);
  const double middle = random.uniform(-2.0, 2.0);
  const double wall = random.uniform(0.0, 0.6);
  const double half_wall = 0.5 * random.uniform(layout.wall_thickness_low, layout.wall_thickness_high);
  scenario.border = kHall;
  scenario.boxes.push_back({{wall - half_wall, middle + 0.5 * width}, {wall + half_wall, kHall.high.y()}});
  scenario.boxes.push_back({{wall - half_wall, kHall.low.y()}, {wall + half_wall, middle - 0.5 * width}});
  if (scenario.boxes[0].low.y() >= kHall.high.y() || scenario.boxes[1].high.y() <= kHall.low.y())
    return false;
  const double start = random.uniform(-3.0, 3.0);
  scenario.robots.push_back(task_between({-4.0, start}, {4.0, random.uniform(-3.0, 3.0)}));
  return true;
}

}  // namespace spf::sim
