// Detects and tracks moving objects in range scans: returns that neither the map nor a teammate
// masks become detections and tracks (docs/perception.md). Frame: world.
#pragma once

#include <cstdint>
#include <vector>

#include "spf/perception/scan_tracker.hpp"
#include "spf/world/observation.hpp"
#include "spf/world/occupancy_map.hpp"

namespace spf {

struct ScanPerceptionStats {
  std::uint64_t sweeps = 0;     ///< processed
  std::uint64_t malformed = 0;  ///< refused: numbers out of range, or too many beams
  std::uint64_t stale = 0;      ///< refused: not newer than the one before
};

class ScanPerception {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  explicit ScanPerception(const PerceptionParameters& parameters = {});

  /// Processes one sweep. `map`: as known and sensed before it. `discs`: masks of the returns of
  /// something known (trusted teammates, tracks of another detector), enlarged by their uncertainty. False
  /// when the sweep was refused, which changes the stats alone. Allocates only while sweeps or the number of
  /// objects grow.
  bool update(const SensorSweep& sweep, const OccupancyMap& map, const std::vector<MaskedDisc>& discs);

  /// All tracks, tentative ones too, sorted by id.
  [[nodiscard]] const std::vector<ScanTrack>& tracks() const { return tracker_.tracks(); }
  /// Tracks that ended with the last sweep or are no longer reported since then, sorted.
  [[nodiscard]] const std::vector<int>& ended() const { return tracker_.ended(); }
  /// Measurements for an ObstacleTracker: the position of every reported track that the last sweep shows, as
  /// measured by this sweep alone and moved to `time` [s]. No velocity: a filtered one is no independent
  /// measurement. Sorted by id.
  void detections(double time, std::vector<Detection>& detections) const;
  /// A flag per beam of the last sweep: its return is of a moving object or a masked disc and must not
  /// enter the map.
  [[nodiscard]] const std::vector<std::uint8_t>& kept_out() const { return kept_out_; }

  [[nodiscard]] const ScanPerceptionStats& stats() const { return stats_; }
  [[nodiscard]] const ScanTrackerStats& tracker_stats() const { return tracker_.stats(); }

 private:
  void mask_by_map(const OccupancyMap& map);
  void mask_by_discs(const SensorSweep& sweep, const std::vector<MaskedDisc>& discs);
  void compare_with_free_space(const OccupancyMap& map);
  void mark_kept_out();

  PerceptionParameters parameters_;
  Segmentation segmentation_;
  ScanDetector detector_;
  ScanTracker tracker_;
  ScanPerceptionStats stats_;
  double last_time_;  // [s]

  // Of the last sweep; memory is reused.
  std::vector<ScanReturn> returns_;
  std::vector<std::uint8_t> masked_;     // by return
  std::vector<std::int32_t> return_at_;  // by beam, -1 = none
  std::vector<std::uint8_t> kept_out_;   // by beam
};

}  // namespace spf
