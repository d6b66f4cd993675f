// The safety probability field of one moving obstacle (eq. 1-4).
#include "spf/field/probability_field.hpp"

#include "python/bind.hpp"

namespace spf::python {
namespace {

ProbabilityField make_field(const py::object& position, const py::object& velocity, const py::object& radius,
                            const py::object& robot_radius, const FieldParameters& parameters) {
  const ObstacleState obstacle{point_from(position, "position"), point_from(velocity, "velocity"),
                               positive_number(radius, "radius")};
  const double own = finite_number(robot_radius, "robot_radius");
  if (own < 0.0) refuse("robot_radius", robot_radius, "must be at least 0 m");
  return {obstacle, own, validated(parameters)};
}

py::dict ellipse_of(const ProbabilityField& self, const py::object& mahalanobis) {
  const FieldEllipse ellipse = self.ellipse(positive_number(mahalanobis, "mahalanobis"));
  py::dict found;
  found["center"] = to_array(ellipse.center_world);
  found["half_axes"] = to_array(ellipse.half_axes);
  found["heading"] = ellipse.heading;
  return found;
}

Eigen::Vector2d unit_from(const py::object& direction, const char* key) {
  const Eigen::Vector2d vector = point_from(direction, key);
  if (vector.norm() < 1e-9) refuse(key, direction, "must not be zero");
  return vector.normalized();
}

void bind_clearance(py::class_<ProbabilityField>& type) {
  type.def(
          "clearance",
          [](const ProbabilityField& self, const py::object& points, const py::object& threshold) {
            const double limit = positive_number(threshold, "threshold");
            return number_of_points(points, "points",
                                    [&](const auto& point) { return self.clearance(point, limit); });
          },
          py::arg("points"), py::arg("threshold"),
          "Signed distance [m] from the ellipse `threshold`: negative inside, never too much outside.")
      .def(
          "escape_direction",
          [](const ProbabilityField& self, const py::object& point, const py::object& preferred_side) {
            return to_array(self.escape_direction(point_from(point, "point"),
                                                  point_from(preferred_side, "preferred_side")));
          },
          py::arg("point"), py::arg("preferred_side") = py::make_tuple(0.0, 0.0),
          "Unit vector along which the density falls fastest (eq. 11).")
      .def(
          "guide_point",
          [](const ProbabilityField& self, const py::object& point, const py::object& direction,
             const py::object& mahalanobis) {
            return to_array(self.guide_point(point_from(point, "point"), unit_from(direction, "direction"),
                                             positive_number(mahalanobis, "mahalanobis")));
          },
          py::arg("point"), py::arg("direction"), py::arg("mahalanobis"),
          "Where a ray from a point inside the ellipse leaves it [m].")
      .def("ellipse", &ellipse_of, py::arg("mahalanobis"),
           "A contour as a dict: center (2,) [m], half_axes (2,) [m] along and across, heading [rad].")
      .def_property_readonly("threshold", &ProbabilityField::threshold, "The default limit of danger [1].")
      .def_property_readonly(
          "center", [](const ProbabilityField& self) { return to_array(self.center_world()); },
          "(2,) [m] eq. 2")
      .def_property_readonly(
          "axis", [](const ProbabilityField& self) { return to_array(self.axis_world()); },
          "(2,) unit vector along the velocity")
      .def_property_readonly(
          "half_axes",
          [](const ProbabilityField& self) {
            return to_array(Eigen::Vector2d{self.half_axis_along(), self.half_axis_across()});
          },
          "(2,) [m] a and b of eq. 3");
}

}  // namespace

void bind_field(py::module_& module) {
  py::class_<ProbabilityField> type(
      module, "ProbabilityField",
      "The safety probability field of one moving obstacle (eq. 1-4): an elliptic\n"
      "Gaussian ahead of it, for the centre of a disc-shaped robot. Immutable.");
  type.def(py::init(&make_field), py::arg("position"), py::arg("velocity"), py::arg("radius"),
           py::arg("robot_radius") = RobotParameters{}.radius, py::arg("parameters") = FieldParameters{},
           "Of an obstacle at a position [m] with a velocity [m/s] and a radius [m].")
      .def(
          "density",
          [](const ProbabilityField& self, const py::object& points) {
            return number_of_points(points, "points", [&](const auto& point) { return self.density(point); });
          },
          py::arg("points"), "Density U of eq. 1 [1/m^2] at points (..., 2).")
      .def(
          "density_gradient",
          [](const ProbabilityField& self, const py::object& points) {
            return vector_of_points<2>(points, "points",
                                       [&](const auto& point) { return self.density_gradient(point); });
          },
          py::arg("points"), "dU/dp of eq. 4 [1/m^3], (..., 2).")
      .def(
          "mahalanobis",
          [](const ProbabilityField& self, const py::object& points) {
            return number_of_points(points, "points",
                                    [&](const auto& point) { return self.mahalanobis(point); });
          },
          py::arg("points"), "Distance from the centre, 1 on the ellipse with the half axes [1].")
      .def(
          "risk",
          [](const ProbabilityField& self, const py::object& points) {
            return number_of_points(points, "points", [&](const auto& point) { return self.risk(point); });
          },
          py::arg("points"), "Density over its peak, in [0, 1].");
  bind_clearance(type);
}

}  // namespace spf::python
