#include "spf/planning/space_time/space_time_cost.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/normal_distribution.hpp"

namespace spf {
namespace {

constexpr double kInverseSqrtTwoPi = 0.39894228040143267794;
constexpr double kFarSigmas = 5.0;  // Phi(-5) = 3e-7

double density(double z) {
  return kInverseSqrtTwoPi * std::exp(-0.5 * z * z);
}

/// An instant between two steps of the table.
struct Instant {
  std::size_t step = 0;
  double part = 0.0;        // [0, 1]
  double per_second = 0.0;  // d part / d time; 0 beyond the table
};

Instant instant_at(double ahead, const SpaceTimeRisk& risk) {
  const double position = ahead / risk.step();
  if (position <= 0.0) return {0, 0.0, 0.0};
  if (position >= risk.steps()) return {static_cast<std::size_t>(risk.steps() - 1), 1.0, 0.0};
  const double floor = std::floor(position);
  return {static_cast<std::size_t>(floor), position - floor, 1.0 / risk.step()};
}

void add_disc(const SpaceTimeRisk::PredictedDisc& disc, const Instant& at, double rate,
              const NodeSample& node, NodePenalty& penalty) {
  const Eigen::Vector2d step = disc.mean_world[at.step + 1] - disc.mean_world[at.step];
  const Eigen::Vector2d offset = node.position - disc.mean_world[at.step] - at.part * step;
  const double sigma_step = disc.sigma[at.step + 1] - disc.sigma[at.step];
  const double sigma = disc.sigma[at.step] + at.part * sigma_step;
  const double distance = offset.norm();
  const double z = (distance - disc.radius) / sigma;
  if (z > kFarSigmas) return;
  const double factor_step = disc.weight[at.step + 1] - disc.weight[at.step];
  const double factor = rate * (disc.weight[at.step] + at.part * factor_step);
  const double chance = normal_tail(z);
  const double slope = -factor * density(z);  // dP / dz
  penalty.integrand += factor * chance;
  // At the very centre all directions outwards are equally good.
  const Eigen::Vector2d away =
      distance > 1e-9 ? Eigen::Vector2d{offset / distance} : Eigen::Vector2d{Eigen::Vector2d::Zero()};
  penalty.wrt_position += (slope / sigma) * away;
  const double z_by_time = (-away.dot(step) - z * sigma_step) * at.per_second / sigma;
  penalty.wrt_time += slope * z_by_time + rate * factor_step * at.per_second * chance;
}

}  // namespace

void SpaceTimeCost::operator()(NodeSet& nodes) const {
  const double rate = price / exposure;
  for (int k = 0; k < nodes.size(); ++k) {
    const NodeSample& node = nodes[k];
    NodePenalty& penalty = nodes.penalty(k);
    const double ahead = node.time - start_time;
    const Instant at = instant_at(ahead, *risk);
    for (int e = 0; e < risk->disc_count(); ++e) add_disc(risk->disc(e), at, rate, node, penalty);

    const double clearance = map->distance(node.position) - wanted_clearance;
    const double z = clearance / static_sigma;
    if (z > kFarSigmas) continue;
    // Inside the margin the cost keeps growing, so that it always falls outwards.
    const double depth = std::max(0.0, -clearance) / wanted_clearance;
    penalty.integrand += rate * (normal_tail(z) + depth);
    const double slope = -density(z) / static_sigma - (clearance < 0.0 ? 1.0 / wanted_clearance : 0.0);
    penalty.wrt_position += rate * slope * map->distance_gradient(node.position);
  }
}

}  // namespace spf
