// Nodes: the points of a trajectory at which costs are evaluated, with the cost and gradient that the terms
// add there. Terms see nodes only; NodeSet turns gradients at nodes into gradients with respect to
// coefficients and durations (eq. 12-13 without the term's own factor). Frame: world.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "spf/trajectory/minco.hpp"

namespace spf {

/// One node with its derivatives with respect to time.
struct NodeSample {
  Eigen::Vector2d position;      ///< [m]
  Eigen::Vector2d velocity;      ///< [m/s]
  Eigen::Vector2d acceleration;  ///< [m/s^2]
  Eigen::Vector2d jerk;          ///< [m/s^3]
  Eigen::Vector2d snap;          ///< [m/s^4]
  double local_time = 0.0;       ///< [s] in its piece
  double time = 0.0;             ///< [s] absolute
  double weight = 0.0;           ///< [s] share of the time integral (trapezoid rule)
  double fraction = 0.0;         ///< local_time / duration of its piece
  int piece = 0;
};

/// Cost and gradient of all terms at one node, of two kinds: the integrand P [1/s] is multiplied by the
/// node's time weight; the point part is added as it is (sums over points, such as eq. 10).
struct NodePenalty {
  Eigen::Vector2d wrt_position = Eigen::Vector2d::Zero();        ///< dP/dposition
  Eigen::Vector2d wrt_velocity = Eigen::Vector2d::Zero();        ///< dP/dvelocity
  Eigen::Vector2d wrt_acceleration = Eigen::Vector2d::Zero();    ///< dP/dacceleration
  Eigen::Vector2d wrt_jerk = Eigen::Vector2d::Zero();            ///< dP/djerk
  Eigen::Vector2d point_wrt_position = Eigen::Vector2d::Zero();  ///< gradient of the point part
  double wrt_time = 0.0;    ///< dP/dt at a fixed position, from discs that move with absolute time
  double integrand = 0.0;   ///< P [1/s]
  double point_cost = 0.0;  ///< point part [1]
};

/// N pieces with K intervals each have N K + 1 nodes; neighbours share the node at their junction, where the
/// trajectory is continuous up to the snap. Memory is allocated by the constructor only.
class NodeSet {
 public:
  NodeSet(int max_pieces, int intervals_per_piece);

  /// Evaluates all nodes and clears all penalties.
  void sample(const Minco& minco, double start_time);

  /// Adds the gradients of the penalties to those with respect to coefficients and durations; returns their
  /// cost.
  double fold(Minco::Coefficients& wrt_coefficients, Minco::Durations& wrt_durations) const;

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int pieces() const { return pieces_; }
  [[nodiscard]] const NodeSample& operator[](int index) const {
    return samples_[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] NodePenalty& penalty(int index) { return penalties_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] const NodePenalty& penalty(int index) const {
    return penalties_[static_cast<std::size_t>(index)];
  }

 private:
  int intervals_;
  int pieces_ = 0;
  int size_ = 0;
  std::vector<NodeSample> samples_;
  std::vector<NodePenalty> penalties_;
};

}  // namespace spf
