#include "sim/movers.hpp"

namespace spf::sim {

Movers::Movers(const Scenario& scenario)
    : discs_{scenario}, crowd_{scenario.crowd, scenario.crowd_gap}, person_radius_{scenario.crowd_radius} {}

void Movers::advance(double time) {
  discs_.advance();
  movers_.clear();
  const int discs = static_cast<int>(discs_.now().size());
  for (int i = 0; i < discs; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const ObstacleState& now = discs_.now()[index];
    const Motion motion{now.position_world, discs_.next()[index].position_world};
    movers_.push_back({i, false, now.radius, motion, now.velocity_world});
  }
  crowd_.visit(time, kStep, [&](int id, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    movers_.push_back({discs + id, true, person_radius_, {from, to}, (to - from) / kStep});
  });
}

}  // namespace spf::sim
