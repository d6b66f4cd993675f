// The safety probability field of a person who walks to the right (eq. 1-4), for the centre of a robot: it
// lies ahead of the person and is stretched along the velocity.
#include <spf/field/probability_field.hpp>

#include <iostream>

#include "picture.hpp"

int main() {
  const double robot_radius = 0.3;
  const spf::ObstacleState person{{0.0, 0.0}, {0.9, 0.0}, 0.3};
  const spf::ProbabilityField field{person, robot_radius, spf::FieldParameters{}};

  Picture picture{{-2.5, -2.0}, {5.5, 2.0}};
  for (double m = 2.4; m > 0.1; m -= 0.3) {  // the fuller the colour, the higher the risk
    const spf::FieldEllipse contour = field.ellipse(m);
    picture.ellipse(contour.center_world, contour.half_axes, contour.heading, "obstacle", 0.12);
  }
  const spf::FieldEllipse limit = field.ellipse(field.threshold());
  picture.ellipse(limit.center_world, limit.half_axes, limit.heading, "limit", 0.0);
  picture.disc(person.position_world, person.radius, "obstacle", 0.9);
  picture.line({person.position_world, person.position_world + person.velocity_world}, "obstacle", 4.0);

  std::cout << "dangerous up to a Mahalanobis distance of " << spf::fixed(field.threshold(), 2) << "\n";
  std::cout << "   x [m]   y [m]   risk [1]   clearance [m]   escape to\n";
  for (const Eigen::Vector2d& robot :
       {Eigen::Vector2d{1.5, 0.4}, {3.0, 0.8}, {-1.0, 0.5}, {0.5, -1.2}, {4.5, -0.6}}) {
    const Eigen::Vector2d escape = field.escape_direction(robot, Eigen::Vector2d::UnitY());
    picture.disc(robot, 0.06, "robot-0", 1.0);
    picture.line({robot, robot + 0.6 * escape}, "robot-0");
    std::cout << spf::fixed(robot.x(), 2) << "   " << spf::fixed(robot.y(), 2) << "   "
              << spf::fixed(field.risk(robot), 3) << "   "
              << spf::fixed(field.clearance(robot, field.threshold()), 2) << "   ("
              << spf::fixed(escape.x(), 2) << ", " << spf::fixed(escape.y(), 2) << ")\n";
  }
  picture.text({-2.4, 1.75},
               "risk for a robot's centre; red: where it counts as dangerous; lines: the way out");
  picture.save("01_field.svg");
}
