#include "sim/dynamic_obstacles.hpp"

namespace spf::sim {

DynamicObstacles::DynamicObstacles(const Scenario& scenario)
    : discs_{scenario}, crowd_{scenario.crowd, scenario.crowd_gap}, person_radius_{scenario.crowd_radius} {}

void DynamicObstacles::advance(double time) {
  discs_.advance();
  dynamic_obstacles_.clear();
  const int discs = static_cast<int>(discs_.now().size());
  for (int i = 0; i < discs; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const ObstacleState& now = discs_.now()[index];
    const Motion motion{now.position_world, discs_.next()[index].position_world};
    dynamic_obstacles_.push_back({i, false, now.radius, motion, now.velocity_world});
  }
  crowd_.visit(time, kStep, [&](int id, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    dynamic_obstacles_.push_back({discs + id, true, person_radius_, {from, to}, (to - from) / kStep});
  });
}

}  // namespace spf::sim
