// The surfaces of a scenario's polygons and static map, as pieces so short that those near a point are found
// without testing all. Frame: world.
#pragma once

#include <optional>
#include <vector>

#include "sim/scenario.hpp"
#include "sim/uniform_grid.hpp"

namespace spf::sim {

class Outlines {
 public:
  struct Piece {
    Segment segment;
    int polygon = -1;  ///< its index; -1 = of the map
  };

  explicit Outlines(const Scenario& scenario);

  [[nodiscard]] bool empty() const { return pieces_.empty(); }
  /// Calls visit(piece) for every piece within `radius` [m] of a position, and for some farther off.
  template <class Visit>
  void visit(const Eigen::Vector2d& position_world, double radius, Visit&& visit) const {
    if (pieces_.empty()) return;
    grid_.visit(position_world, radius + reach_,
                [&](int piece) { visit(pieces_[static_cast<std::size_t>(piece)]); });
  }
  /// The nearest point of all surfaces that are nearer than `radius` [m].
  [[nodiscard]] std::optional<Eigen::Vector2d> nearest(const Eigen::Vector2d& position_world,
                                                       double radius) const;

 private:
  std::vector<Piece> pieces_;
  double reach_ = 0.0;  // [m] largest distance from a piece's middle to its ends
  UniformGrid grid_;
};

}  // namespace spf::sim
