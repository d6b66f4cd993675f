#include "spf/planning/costs/limits_cost.hpp"

namespace spf {
namespace {

void add_limit(double weight, double limit, const Eigen::Vector2d& value, Eigen::Vector2d& gradient,
               double& integrand) {
  const double scale = 1.0 / (limit * limit);
  const double excess = value.squaredNorm() * scale - 1.0;
  if (excess <= 0.0) return;
  integrand += weight * excess * excess * excess;
  gradient += (6.0 * weight * excess * excess * scale) * value;
}

}  // namespace

void LimitsCost::add(NodeSet& nodes) const {
  if (weight <= 0.0) return;
  for (int k = 0; k < nodes.size(); ++k) {
    const NodeSample& node = nodes[k];
    NodePenalty& penalty = nodes.penalty(k);
    add_limit(weight, max_speed, node.velocity, penalty.wrt_velocity, penalty.integrand);
    add_limit(weight, max_acceleration, node.acceleration, penalty.wrt_acceleration, penalty.integrand);
    add_limit(weight, max_jerk, node.jerk, penalty.wrt_jerk, penalty.integrand);
  }
}

}  // namespace spf
