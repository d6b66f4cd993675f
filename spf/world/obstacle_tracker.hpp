// Moving obstacles from detections: one Kalman filter (constant velocity, both axes alike) per detection id,
// with the process noise learnt per track. Frame: world.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

#include "spf/math/parameters.hpp"
#include "spf/world/diffusion_estimator.hpp"
#include "spf/world/observation.hpp"
#include "spf/world/obstacle_track.hpp"

namespace spf {

struct ObstacleTrackerParameters {
  double timeout = 2.0;        ///< [s] a track unseen for longer is dropped
  double initial_speed = 1.0;  ///< [m/s] standard deviation per axis of the velocity after a single detection
  double least_sigma = 1e-4;   ///< [m] positions are never taken as more exact
  double still_distance = 0.15;  ///< [m] what stays this near to a position stands there ...
  double still_speed = 0.2;      ///< [m/s] ... unless it is faster, as far as its velocity is known
  DiffusionParameters diffusion;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("timeout", self.timeout, "s", Range{0.05, 60.0}, "a track that is unseen for longer is dropped");
    visit.group("diffusion", self.diffusion);
  }

  /// No settings, but they follow the robot.
  template <class Self, class Visitor>
  static void visit_constants(Self& self, Visitor&& visit) {
    visit(self.initial_speed, Scale::speed, Range{0.01, 50.0});
    visit(self.least_sigma, Scale::size, Range{1e-6, 1.0});
    visit(self.still_distance, Scale::size, Range{1e-3, 10.0});
    visit(self.still_speed, Scale::speed, Range{1e-3, 10.0});
  }
};

/// Largest number of obstacles that a robot tracks.
inline constexpr std::size_t kMostTracks = 2000;

struct ObstacleTrackerStats {
  std::uint64_t accepted = 0;   ///< detections that updated a track
  std::uint64_t malformed = 0;  ///< not believable, or a radius or sigma out of range
  std::uint64_t stale = 0;      ///< not newer than the track
  std::uint64_t changes = 0;    ///< sudden changes of motion
  std::uint64_t dropped = 0;    ///< tracks that timed out
  std::uint64_t crowded = 0;    ///< detections of new obstacles beyond kMostTracks
};

class ObstacleTracker {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  explicit ObstacleTracker(const ObstacleTrackerParameters& parameters = {});

  /// Takes in the detections of one observation; the other tracks are predicted to its time, with growing
  /// uncertainty.
  void update(const Observation& observation);

  /// Ends these tracks (sorted ids): whoever detects them knows that they are no more.
  void forget(const std::vector<int>& ids);

  /// Sorted by id, all at the time of the newest observation.
  [[nodiscard]] const std::vector<ObstacleTrack>& tracks() const { return tracks_; }
  [[nodiscard]] const ObstacleTrackerStats& stats() const { return stats_; }

 private:
  /// The private part of a track; memories_[k] belongs to tracks_[k].
  struct Memory {
    double last_seen = 0.0;                              // [s]
    double last_change = -1e9;                           // [s]
    double still_since = 0.0;                            // [s]
    Eigen::Vector2d stood_at = Eigen::Vector2d::Zero();  // [m] of the track then
    Eigen::Vector2d cusum =
        Eigen::Vector2d::Zero();  // cusum: discounted sum of innovations, each over its standard deviation
    DiffusionEstimator diffusion;
  };

  void enter(const Detection& detection, double time);
  void begin_track(std::size_t slot, const Detection& detection, double time);
  void correct(ObstacleTrack& track, Memory& memory, const Detection& detection, double time);
  void watch_standing(ObstacleTrack& track, Memory& memory, const Detection& detection, double time) const;
  void drop_unseen(double time);
  template <class Over>
  std::size_t drop(const Over& over);

  ObstacleTrackerParameters parameters_;
  ObstacleTrackerStats stats_;
  std::vector<ObstacleTrack> tracks_;
  std::vector<Memory> memories_;
  DiffusionPopulation population_;
};

}  // namespace spf
