#include "sim/dynamic_obstacles.hpp"

#include <algorithm>

namespace spf::sim {
namespace {

/// The first number that neither a disc nor a recorded person has.
int first_free_id(const Scenario& scenario) {
  int recorded = 0;
  for (const CrowdSample& sample : scenario.crowd) recorded = std::max(recorded, sample.id + 1);
  return static_cast<int>(scenario.moving.size()) + recorded;
}

}  // namespace

DynamicObstacles::DynamicObstacles(const Scenario& scenario)
    : discs_{scenario},
      crowd_{scenario.crowd, scenario.crowd_gap},
      person_radius_{scenario.crowd_radius},
      walkers_{scenario},
      first_walker_{first_free_id(scenario)} {}

void DynamicObstacles::place(int id, const Eigen::Vector2d& position_world) {
  const auto index = static_cast<std::size_t>(std::max(id, 0));
  if (index < discs_.now().size()) discs_.place(index, position_world);
  if (id >= first_walker_) walkers_.place(index - static_cast<std::size_t>(first_walker_), position_world);
}

void DynamicObstacles::advance(double time, const std::vector<RobotTruth>& robots) {
  discs_.advance();
  dynamic_obstacles_.clear();
  const int discs = static_cast<int>(discs_.now().size());
  for (int i = 0; i < discs; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const ObstacleState& now = discs_.now()[index];
    const Motion motion{now.position_world, discs_.next()[index].position_world};
    dynamic_obstacles_.push_back({i, false, false, now.radius, motion, now.velocity_world});
  }
  crowd_.visit(time, kStep, [&](int id, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    dynamic_obstacles_.push_back({discs + id, true, true, person_radius_, {from, to}, (to - from) / kStep});
  });
  if (!walkers_.empty()) advance_walkers(robots);
}

void DynamicObstacles::advance_walkers(const std::vector<RobotTruth>& robots) {
  std::vector<RoundBody> others;
  for (const DynamicObstacle& obstacle : dynamic_obstacles_) {
    RoundBody& body = others.emplace_back();
    body.position = obstacle.motion.from;
    body.velocity = obstacle.velocity_world;
    body.radius = obstacle.radius;
  }
  for (const RobotTruth& robot : robots) {
    if (robot.gone) continue;
    RoundBody& body = others.emplace_back();
    body.position = robot.pose.position_world;
    body.velocity = robot.velocity_world;
    body.radius = robot.radius;
  }
  walkers_.advance(others);
  for (std::size_t i = 0; i < walkers_.size(); ++i) {
    const Motion& motion = walkers_.motion(i);
    dynamic_obstacles_.push_back({first_walker_ + static_cast<int>(i), true, false, walkers_.radius(i),
                                  motion, (motion.to - motion.from) / kStep});
  }
}

}  // namespace spf::sim
