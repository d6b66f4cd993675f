// What the optimiser varies, in one vector: [q_1x q_1y q_2x ... ; tau_1 ... tau_N], inner waypoints in world
// and one unconstrained tau per duration (time_map.hpp).
#pragma once

#include <Eigen/Core>

#include <cassert>

#include "spf/trajectory/minco.hpp"
#include "spf/trajectory/time_map.hpp"

namespace spf {

/// Where waypoints and taus lie in the decision vector of a motion of `piece_count` pieces.
struct DecisionLayout {
  int piece_count = 0;

  [[nodiscard]] int waypoint_entries() const { return 2 * (piece_count - 1); }
  [[nodiscard]] int size() const { return waypoint_entries() + piece_count; }
  static constexpr int kMaxSize = 3 * Trajectory::kMaxPieces - 2;

  /// Waypoints as seen in `decision`, a column each.
  [[nodiscard]] Eigen::Map<const Eigen::Matrix2Xd> waypoints(
      const Eigen::Ref<const Eigen::VectorXd>& decision) const {
    assert(decision.size() == size());
    return {decision.data(), 2, piece_count - 1};
  }

  [[nodiscard]] Minco::Durations durations(const Eigen::Ref<const Eigen::VectorXd>& decision) const {
    assert(decision.size() == size());
    Minco::Durations result(piece_count);
    for (int i = 0; i < piece_count; ++i) result[i] = duration_from_tau(decision[waypoint_entries() + i]);
    return result;
  }

  /// Writes waypoints and durations > 0 into `decision`.
  void pack(const Minco::WaypointsView& waypoints_world, const Minco::DurationsView& durations,
            Eigen::Ref<Eigen::VectorXd> decision) const {
    assert(decision.size() == size() && waypoints_world.cols() == piece_count - 1 &&
           durations.size() == piece_count);
    for (int i = 0; i + 1 < piece_count; ++i) decision.segment<2>(2 * i) = waypoints_world.col(i);
    for (int i = 0; i < piece_count; ++i) decision[waypoint_entries() + i] = tau_from_duration(durations[i]);
  }

  /// Converts a gradient with respect to waypoints and durations to one with respect to the decision vector.
  void pack_gradient(const MincoGradient& gradient, const Eigen::Ref<const Eigen::VectorXd>& decision,
                     Eigen::Ref<Eigen::VectorXd> wrt_decision) const {
    assert(decision.size() == size() && wrt_decision.size() == size());
    for (int i = 0; i + 1 < piece_count; ++i) wrt_decision.segment<2>(2 * i) = gradient.waypoints.col(i);
    for (int i = 0; i < piece_count; ++i) {
      const int at = waypoint_entries() + i;
      wrt_decision[at] = gradient.durations[i] * duration_slope(decision[at]);
    }
  }
};

}  // namespace spf
