#include "spf/planning/costs/node_set.hpp"

#include <cassert>

namespace spf {
namespace {

using ConstRow = Eigen::Map<const Eigen::Vector2d>;
using Row = Eigen::Map<Eigen::Vector2d>;

/// Position and four derivatives of one piece; `c` points to its six rows.
void evaluate(const double* c, double t, NodeSample& node) {
  const ConstRow c0{c}, c1{c + 2}, c2{c + 4}, c3{c + 6}, c4{c + 8}, c5{c + 10};
  node.position = c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * c5))));
  node.velocity = c1 + t * (2.0 * c2 + t * (3.0 * c3 + t * (4.0 * c4 + (t * 5.0) * c5)));
  node.acceleration = 2.0 * c2 + t * (6.0 * c3 + t * (12.0 * c4 + (t * 20.0) * c5));
  node.jerk = 6.0 * c3 + t * (24.0 * c4 + (t * 60.0) * c5);
  node.snap = 24.0 * c4 + (t * 120.0) * c5;
}

/// Adds the outer products of the basis vector and its derivatives with the gradients to the six rows of a
/// piece.
void add_basis(double t, const Eigen::Vector2d& g_p, const Eigen::Vector2d& g_v, const Eigen::Vector2d& g_a,
               const Eigen::Vector2d& g_j, double* c) {
  const double t2 = t * t;
  const double t3 = t2 * t;
  Row{c} += g_p;
  Row{c + 2} += t * g_p + g_v;
  Row{c + 4} += t2 * g_p + (2.0 * t) * g_v + 2.0 * g_a;
  Row{c + 6} += t3 * g_p + (3.0 * t2) * g_v + (6.0 * t) * g_a + 6.0 * g_j;
  Row{c + 8} += (t2 * t2) * g_p + (4.0 * t3) * g_v + (12.0 * t2) * g_a + (24.0 * t) * g_j;
  Row{c + 10} += (t3 * t2) * g_p + (5.0 * t2 * t2) * g_v + (20.0 * t3) * g_a + (60.0 * t2) * g_j;
}

}  // namespace

NodeSet::NodeSet(int max_pieces, int intervals_per_piece)
    : intervals_{intervals_per_piece},
      samples_(static_cast<std::size_t>(max_pieces * intervals_per_piece + 1)),
      penalties_(samples_.size()) {}

void NodeSet::sample(const Minco& minco, double start_time) {
  pieces_ = minco.piece_count();
  size_ = pieces_ * intervals_ + 1;
  assert(pieces_ >= 1 && size_ <= static_cast<int>(samples_.size()));
  const double* coefficients = minco.coefficients().data();
  const Minco::Durations& durations = minco.durations();
  double piece_start = start_time;
  for (int i = 0; i < pieces_; ++i) {
    const double duration = durations[i];
    const double interval = duration / intervals_;
    // Node 0 belongs to piece 0, every junction to the piece that ends there.
    for (int j = (i == 0 ? 0 : 1); j <= intervals_; ++j) {
      NodeSample& node = samples_[static_cast<std::size_t>(i * intervals_ + j)];
      node.piece = i;
      node.fraction = static_cast<double>(j) / intervals_;
      node.local_time = node.fraction * duration;
      node.time = piece_start + node.local_time;
      node.weight = interval;
      evaluate(coefficients + 12 * i, node.local_time, node);
    }
    // Half weights at the ends of a piece; a junction also gets the half of the piece that follows.
    if (i == 0) samples_[0].weight = 0.5 * interval;
    samples_[static_cast<std::size_t>((i + 1) * intervals_)].weight =
        0.5 * interval + (i + 1 < pieces_ ? 0.5 * durations[i + 1] / intervals_ : 0.0);
    piece_start += duration;
  }
  for (int k = 0; k < size_; ++k) penalties_[static_cast<std::size_t>(k)] = NodePenalty{};
}

double NodeSet::fold(Minco::Coefficients& wrt_coefficients, Minco::Durations& wrt_durations) const {
  assert(wrt_coefficients.rows() == 6 * pieces_ && wrt_durations.size() == pieces_);
  double cost = 0.0;
  // From the last node to the first: the time of a node depends on the durations of all earlier pieces.
  double later_wrt_time = 0.0;
  for (int i = pieces_ - 1; i >= 0; --i) {
    wrt_durations[i] += later_wrt_time;
    for (int j = intervals_; j >= (i == 0 ? 0 : 1); --j) {
      const auto k = static_cast<std::size_t>(i * intervals_ + j);
      const NodeSample& node = samples_[k];
      const NodePenalty& penalty = penalties_[k];
      cost += node.weight * penalty.integrand + penalty.point_cost;
      const Eigen::Vector2d g_p = node.weight * penalty.wrt_position + penalty.point_wrt_position;
      const Eigen::Vector2d g_v = node.weight * penalty.wrt_velocity;
      const Eigen::Vector2d g_a = node.weight * penalty.wrt_acceleration;
      const Eigen::Vector2d g_j = node.weight * penalty.wrt_jerk;
      add_basis(node.local_time, g_p, g_v, g_a, g_j, wrt_coefficients.data() + 12 * i);

      const double along = g_p.dot(node.velocity) + g_v.dot(node.acceleration) + g_a.dot(node.jerk) +
                           g_j.dot(node.snap) + node.weight * penalty.wrt_time;
      // A node's local time is its fraction of the duration; its time weight is a share of one or two
      // durations.
      const double share = (j == 0 || j == intervals_ ? 0.5 : 1.0) / intervals_ * penalty.integrand;
      wrt_durations[i] += node.fraction * along + share;
      if (j == intervals_ && i + 1 < pieces_) wrt_durations[i + 1] += share;
      later_wrt_time += node.weight * penalty.wrt_time;
    }
  }
  return cost;
}

}  // namespace spf
