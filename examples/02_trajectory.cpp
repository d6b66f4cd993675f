// A minimum-jerk trajectory (MINCO, eq. 5-8): of all motions through these waypoints at these times the one
// with the least jerk. With another split of the same time it may have less still; planners find it by
// gradients.
#include <spf/trajectory/minco.hpp>

#include <iostream>

#include "picture.hpp"

int main() {
  Eigen::Matrix2Xd waypoints{2, 3};
  waypoints << 2.0, 4.0, 6.0,  //
      1.2, -0.8, 1.0;
  const Eigen::Vector2d start{0.0, 0.0}, goal{8.0, 0.0};
  const Eigen::Vector2d rest = Eigen::Vector2d::Zero();  // Eigen leaves what is given as {} to chance
  const spf::MincoEnds rest_to_rest{{start, rest, rest}, {goal, rest, rest}};

  Picture picture{{-0.5, -1.6}, {8.5, 2.2}};
  for (int i = 0; i < waypoints.cols(); ++i) picture.disc(waypoints.col(i), 0.12, "muted", 0.3);
  int style = 0;
  for (const Eigen::Vector4d& durations :
       {Eigen::Vector4d{3, 3, 3, 3}, Eigen::Vector4d{3.3, 2.7, 2.7, 3.3}}) {
    spf::Minco minco;
    minco.solve(rest_to_rest, waypoints, durations);
    const spf::Trajectory motion = minco.trajectory(0.0);
    const std::string colour = "robot-" + std::to_string(style++);

    std::vector<Eigen::Vector2d> path;
    for (double time = 0.0; time <= motion.duration(); time += 0.05) path.push_back(motion.position(time));
    picture.line(path, colour);
    for (double time = 0.0; time <= motion.duration(); time += 0.5)
      picture.disc(motion.position(time), 0.05, colour, 0.9);

    std::cout << "pieces of " << durations.transpose() << " s: " << spf::fixed(motion.length(), 2)
              << " m, at most " << spf::fixed(motion.max_speed(), 2) << " m/s and "
              << spf::fixed(motion.max_acceleration(), 2) << " m/s^2, jerk integral "
              << spf::fixed(minco.smoothness(), 1) << " m^2/s^5\n";
  }
  picture.text({-0.4, 1.95},
               "dots every 0.5 s: equal pieces (blue), and more time for start and stop (ochre)");
  picture.save("02_trajectory.svg");
}
