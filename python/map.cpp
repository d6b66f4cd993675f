// What stands: the map with its distance field, and the cost-to-go around it.
#include "python/map.hpp"

#include <memory>
#include <utility>

namespace spf::python {
namespace {

std::shared_ptr<OccupancyMap> make_map(const py::object& low, const py::object& high,
                                       const py::object& resolution, const py::object& max_distance) {
  return std::make_shared<OccupancyMap>(GridFrame::covering(point_from(low, "low"), point_from(high, "high"),
                                                            positive_number(resolution, "resolution")),
                                        positive_number(max_distance, "max_distance"));
}

void add_polygon(OccupancyMap& self, const py::object& corners) {
  const Numbers points = points_from(corners, "corners");
  if (points.ndim() != 2) refuse("corners", corners, "must have the shape (n, 2)");
  std::vector<Eigen::Vector2d> list;
  for (py::ssize_t i = 0; i < points.shape(0); ++i) list.emplace_back(points.at(i, 0), points.at(i, 1));
  self.add_polygon(list);
}

py::array_t<float> node_distances(const OccupancyMap& self) {
  const GridFrame& frame = self.frame();
  py::array_t<float> array({frame.height, frame.width});
  float* to = array.mutable_data();
  for (int j = 0; j < frame.height; ++j)
    for (int i = 0; i < frame.width; ++i) *to++ = static_cast<float>(self.node_distance(i, j));
  return array;
}

const char* name_of(CostToGoOutcome outcome) {
  switch (outcome) {
    case CostToGoOutcome::reachable:
      return "reachable";
    case CostToGoOutcome::goal_moved:
      return "goal moved";
    case CostToGoOutcome::unreachable:
      return "unreachable";
    case CostToGoOutcome::no_free_goal:
      return "no free goal";
  }
  return "?";
}

std::shared_ptr<CostToGo> make_cost_to_go(const OccupancyMap& map, const py::object& goal,
                                          const py::object& robot, const py::object& robot_radius,
                                          const CostToGoParameters& parameters) {
  const double radius = finite_number(robot_radius, "robot_radius");
  if (radius < 0.0) refuse("robot_radius", robot_radius, "must be at least 0 m");
  const Eigen::Vector2d to = point_from(goal, "goal");
  const Eigen::Vector2d from = point_from(robot, "robot");
  auto guide = std::make_shared<CostToGo>(parameters, radius);
  guide->update(map, to, from);
  return guide;
}

py::array_t<double> shortest_path(const CostToGo& self, const py::object& point) {
  std::vector<Eigen::Vector2d> corners;
  ready(self).shortest_path(point_from(point, "point"), corners);
  return to_array(corners);
}

void bind_cost_to_go(py::module_& module) {
  py::class_<CostToGo, std::shared_ptr<CostToGo>>(
      module, "CostToGo", "Length of the shortest path around what stands to a goal, from any position.")
      .def(py::init(&make_cost_to_go), py::arg("map"), py::arg("goal"), py::arg("robot"),
           py::arg("robot_radius") = RobotParameters{}.radius, py::arg("parameters") = CostToGoParameters{},
           "On a map to a goal [m], far enough for a robot at `robot` [m].")
      .def(
          "cost_to_go",
          [](const CostToGo& self, const py::object& points) {
            return number_of_points(points, "points", [&self = ready(self)](const auto& point) {
              return self.cost_to_go(point);
            });
          },
          py::arg("points"), "[m] at points (..., 2).")
      .def(
          "direction",
          [](const CostToGo& self, const py::object& points) {
            return vector_of_points<2>(
                points, "points", [&self = ready(self)](const auto& point) { return self.direction(point); });
          },
          py::arg("points"), "(..., 2) unit vectors towards the goal along the path; zero at the goal.")
      .def(
          "descend",
          [](const CostToGo& self, const py::object& point, const py::object& distance) {
            const double along = finite_number(distance, "distance");
            if (along < 0.0) refuse("distance", distance, "must be at least 0 m");
            return to_array(ready(self).descend(point_from(point, "point"), along));
          },
          py::arg("point"), py::arg("distance"), "The position [m] so far along the path, at most the goal.")
      .def("shortest_path", &shortest_path, py::arg("point"),
           "(k, 2) corners of the path [m], both ends too.")
      .def(
          "reachable",
          [](const CostToGo& self, const py::object& point) {
            return ready(self).reachable(point_from(point, "point"));
          },
          py::arg("point"), "Whether a path leads from there to the goal.")
      .def_property_readonly(
          "outcome", [](const CostToGo& self) { return name_of(self.outcome()); },
          "reachable, goal moved (to goal_used), unreachable, or no free goal.")
      .def_property_readonly(
          "goal_used", [](const CostToGo& self) { return to_array(self.goal_used()); },
          "The goal [m], or the nearest position that keeps the clearance.")
      .def_property_readonly("clearance", &CostToGo::clearance,
                             "Between the robot's centre on a path and what stands [m].");
}

}  // namespace

const CostToGo& ready(const CostToGo& guide) {
  if (!guide.ready()) throw std::invalid_argument("goal: no position near it is free");
  return guide;
}

void bind_map(py::module_& module) {
  py::class_<OccupancyMap, std::shared_ptr<OccupancyMap>>(
      module, "OccupancyMap",
      "What stands: known shapes on a grid, with the distance to the nearest surface.")
      .def(py::init(&make_map), py::arg("low"), py::arg("high"), py::arg("resolution") = 0.1,
           py::arg("max_distance") = 2.0,
           "Free ground from a lower left to an upper right corner [m]. Distances are exact up to\n"
           "max_distance [m] and read that beyond.")
      .def(
          "add_box",
          [](OccupancyMap& self, const py::object& low, const py::object& high) {
            self.add_box(point_from(low, "low"), point_from(high, "high"));
          },
          py::arg("low"), py::arg("high"), "A filled box, by two corners [m].")
      .def(
          "add_disc",
          [](OccupancyMap& self, const py::object& center, const py::object& radius) {
            self.add_disc(point_from(center, "center"), positive_number(radius, "radius"));
          },
          py::arg("center"), py::arg("radius"), "A filled disc [m].")
      .def(
          "add_border",
          [](OccupancyMap& self, const py::object& low, const py::object& high) {
            self.add_border(point_from(low, "low"), point_from(high, "high"));
          },
          py::arg("low"), py::arg("high"), "Outside of these lines counts as inside a wall [m].")
      .def("add_polygon", &add_polygon, py::arg("corners"), "A filled polygon, (n, 2) [m].")
      .def(
          "distance",
          [](const OccupancyMap& self, const py::object& points) {
            return number_of_points(points, "points",
                                    [&](const auto& point) { return self.distance(point); });
          },
          py::arg("points"), "Distance [m] to the nearest surface at points (..., 2), negative inside.")
      .def(
          "distance_gradient",
          [](const OccupancyMap& self, const py::object& points) {
            return vector_of_points<2>(points, "points",
                                       [&](const auto& point) { return self.distance_gradient(point); });
          },
          py::arg("points"), "(..., 2) away from the surface; zero beyond max_distance.")
      .def("node_distances", &node_distances, "(height, width) [m] at the nodes, row by row from the origin.")
      .def_property_readonly(
          "origin", [](const OccupancyMap& self) { return to_array(self.frame().origin_world); },
          "(2,) position of node (0, 0) [m].")
      .def_property_readonly(
          "resolution", [](const OccupancyMap& self) { return self.frame().resolution; }, "[m]")
      .def_property_readonly(
          "max_distance", [](const OccupancyMap& self) { return self.max_distance(); }, "[m]")
      .def_property_readonly(
          "occupied", [](const OccupancyMap& self) { return to_array(self.occupied_points()); },
          "(n, 2) [m] where sensed cells were hit.")
      .def("__copy__", [](const OccupancyMap& self) { return std::make_shared<OccupancyMap>(self); });
  bind_cost_to_go(module);
}

}  // namespace spf::python
