// Where a tracked obstacle will be: its mean motion, reflected by static surfaces, and how uncertain that is.
// Frame: world. Times `ahead` are seconds after the track's own time.
#pragma once

#include <Eigen/Core>

#include <array>

#include "spf/world/obstacle_track.hpp"
#include "spf/world/occupancy_map.hpp"

namespace spf {

/// Samples of the mean at equal steps; fixed capacity, so that neither construction nor queries allocate.
class ObstaclePrediction {
 public:
  static constexpr int kCapacity = 64;

  /// Mean: p + v ahead, thrown back by static surfaces of `map` (null: none): a centre that comes nearer than
  /// the obstacle's radius is pushed out along the distance gradient and leaves with that component of its
  /// velocity turned outwards. A centre that begins nearer than its radius is taken as it is, and turned when
  /// it moves further in. At most kCapacity samples: a longer horizon [s] is covered by longer
  /// steps [s]. Needs step > 0, horizon >= 0.
  ObstaclePrediction(const ObstacleTrack& track, double horizon, double step = 0.1,
                     const OccupancyMap* map = nullptr);

  /// Linear between samples; before 0 the value at 0, beyond the last sample straight on at its velocity [m].
  [[nodiscard]] Eigen::Vector2d position(double ahead) const;
  /// Of the step that holds this time [m/s].
  [[nodiscard]] Eigen::Vector2d velocity(double ahead) const;
  /// Standard deviation per axis [m], from the track.
  [[nodiscard]] double sigma(double ahead) const { return track_.position_sigma(ahead); }

  [[nodiscard]] double radius() const { return track_.state.radius; }
  [[nodiscard]] double time() const { return track_.time; }
  [[nodiscard]] int id() const { return track_.id; }
  [[nodiscard]] int sample_count() const { return count_; }
  [[nodiscard]] double step() const { return step_; }

 private:
  [[nodiscard]] int sample_before(double ahead) const;

  ObstacleTrack track_;
  double step_;
  int count_;
  std::array<Eigen::Vector2d, kCapacity> position_;
  std::array<Eigen::Vector2d, kCapacity> velocity_;  // from sample k on
};

}  // namespace spf
