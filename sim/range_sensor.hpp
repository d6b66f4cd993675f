// A planar range sensor at a robot's centre: exact ray casting against static shapes and discs. Every shape
// is tested only against the beams within its angle as seen from the sensor. Frame: world; beams in the
// sensor's body frame.
#pragma once

#include <vector>

#include "sim/outlines.hpp"
#include "sim/scenario.hpp"
#include "spf/robot/footprint.hpp"
#include "spf/world/observation.hpp"

namespace spf::sim {

/// What blocks beams: the disc of a moving obstacle or of another robot, or a polygon within it.
struct SeenDisc {
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m]
  double radius = 0.0;                                       ///< [m]
  const Footprint* outline = nullptr;                        ///< of a robot with corners
  double heading = 0.0;                                      ///< [rad] of it
};

class RangeSensor {
 public:
  /// The scenario's static shapes (the border's sides are walls), its number of beams and range.
  explicit RangeSensor(const Scenario& scenario);

  /// One sweep from `pose_world` into `scan`, whose memory is reused. Beam i points at (i / beams - 1/2)
  /// times the field of view in the body frame. A sensor inside a shape sees that shape's far side. Beams
  /// without return read infinity.
  void sweep(const Pose2& pose_world, const std::vector<SeenDisc>& discs, RangeScan& scan) const;

  /// Whether a part of the disc at `target.position_world` is visible: its nearest point or one near its
  /// outline, past all static shapes and all other discs (the target may be among them).
  [[nodiscard]] bool sees(const Eigen::Vector2d& from_world, const SeenDisc& target,
                          const std::vector<SeenDisc>& discs) const;

 private:
  [[nodiscard]] bool line_clear(const Segment& line, const SeenDisc& target,
                                const std::vector<SeenDisc>& discs) const;
  struct Sweep;
  void cast_segment(const Segment& segment, Sweep& sweep) const;
  void cast_disc(const Eigen::Vector2d& center, double radius, Sweep& sweep) const;

  int beams_;
  double field_of_view_;           // [rad]
  double range_;                   // [m]
  std::vector<Segment> segments_;  // walls, sides of boxes and of the border
  std::vector<Disc> discs_;
  Outlines outlines_;
};

}  // namespace spf::sim
