// A map of a ROS map server as robots plan on it, and the cost-to-go from everywhere to one place: the way
// from every metre of the floor, and the shortest paths from three rooms.
//   09_map [MAP.yaml]
#include <host/cell_map.hpp>
#include <spf/planning/cost_to_go.hpp>
#include <study/map_file.hpp>

#include <iostream>

#include "picture.hpp"

int main(int argc, char** argv) {
  const std::string file = argc > 1 ? argv[1] : "scenarios/maps/office.yaml";
  spf::InputProblems problems;
  const auto map = spf::read_map_file(file, {spf::UnknownCells::wall}, {file}, problems);
  if (map == nullptr) {
    std::cerr << problems.to_text() << "\n";
    return 1;
  }
  const spf::host::CellExtent extent = spf::host::extent_of(map->cells());
  const spf::OccupancyMap ground = spf::host::map_of_cells(map->cells(), {});
  const Eigen::Vector2d goal{33.0, 15.0};
  spf::CostToGo guide{{}, 0.3};
  guide.update(ground, goal, extent.low_world);

  Picture picture{extent.low_world, extent.high_world};
  for (const spf::host::CellBlock& wall : spf::host::occupied_blocks(map->cells())) {
    const double cell = map->cells().resolution;
    picture.box(extent.low_world + cell * Eigen::Vector2d(wall.first_column, wall.first_row),
                extent.low_world + cell * Eigen::Vector2d(wall.end_column, wall.end_row), "wall", 0.9);
  }
  for (double x = extent.low_world.x(); x < extent.high_world.x(); x += 1.0)
    for (double y = extent.low_world.y(); y < extent.high_world.y(); y += 1.0)
      if (ground.distance({x, y}) > 0.3 && guide.reachable({x, y}))
        picture.line({{x, y}, Eigen::Vector2d{x, y} + 0.6 * guide.direction({x, y})}, "muted", 1.0);
  for (const Eigen::Vector2d& start : {Eigen::Vector2d{3.0, 4.0}, {9.0, 15.0}, {26.0, 4.2}}) {
    std::vector<Eigen::Vector2d> path;
    guide.shortest_path(start, path);
    picture.line(path, "robot-0", 3.0);
    picture.disc(start, 0.3, "robot-0");
    std::cout << "from (" << start.transpose() << ") " << spf::fixed(guide.cost_to_go(start), 1) << " m with "
              << path.size() - 2 << " corners, " << spf::fixed((goal - start).norm(), 1)
              << " m as the crow flies\n";
  }
  picture.disc(goal, 0.3, "good", 0.9);
  picture.save("09_map.svg");
}
