// Multi-object tracking: gated global nearest neighbour association, and the life cycle of tracks. Frame:
// world.
#pragma once

#include <cstdint>
#include <vector>

#include "spf/perception/assignment.hpp"
#include "spf/perception/disc_visibility.hpp"
#include "spf/perception/scan_detector.hpp"
#include "spf/perception/scan_track.hpp"

namespace spf {

/// Most tracks at once.
inline constexpr std::size_t kMostScanTracks = 500;

/// Ids start again from 0 beyond it.
inline constexpr int kLastScanTrackId = 1'000'000'000;

struct ScanTrackerStats {
  std::uint64_t born = 0;
  std::uint64_t confirmed = 0;
  std::uint64_t missed = 0;    ///< tracks that ended because beams passed through them
  std::uint64_t lost = 0;      ///< ... because they were out of sight for too long
  std::uint64_t absorbed = 0;  ///< ... because the map or another track has their returns
  std::uint64_t crowded = 0;   ///< detections beyond kMostScanTracks
};

class ScanTracker {
 public:
  explicit ScanTracker(const PerceptionParameters& parameters) : parameters_{parameters} {
    tracks_.reserve(kUsualThings);
    ended_.reserve(kUsualThings);
    pairs_.reserve(4 * kUsualThings);
    track_of_detection_.reserve(kUsualThings);
    main_of_detection_.reserve(kUsualThings);
  }

  /// Processes the detections of one sweep, which it may refit and join.
  void update(const SensorSweep& sweep, const Segmentation& segmentation, ScanDetector& detector);

  /// Sorted by id.
  [[nodiscard]] const std::vector<ScanTrack>& tracks() const { return tracks_; }
  /// Of each detection of the last sweep: its track's id; -1 = none.
  [[nodiscard]] const std::vector<int>& track_of_detection() const { return track_of_detection_; }
  /// Tracks that ended with the last sweep or are no longer reported since then, sorted.
  [[nodiscard]] const std::vector<int>& ended() const { return ended_; }
  [[nodiscard]] const ScanTrackerStats& stats() const { return stats_; }

 private:
  void match(const std::vector<ScanDetection>& detections);
  void join_parts(const Segmentation& segmentation, std::vector<ScanDetection>& detections);
  void correct_matched(const SensorSweep& sweep, const Segmentation& segmentation, ScanDetector& detector);
  void look_for(const SensorSweep& sweep, ScanTrack& track) const;
  void give_birth(const Segmentation& segmentation, const std::vector<ScanDetection>& detections);
  void watch_stand(ScanTrack& track) const;
  void judge(const SensorSweep& sweep, ScanTrack& track);
  void end_doubles();
  [[nodiscard]] bool over(const ScanTrack& track, double time);
  void drop_ended(double time);

  PerceptionParameters parameters_;
  std::vector<ScanTrack> tracks_;
  int next_id_ = 0;
  ScanTrackerStats stats_;
  std::vector<int> ended_;

  // Of the current sweep; memory is reused.
  std::vector<AssignmentPair> pairs_;
  Assignment assignment_;
  std::vector<int> track_of_detection_;
  std::vector<int> main_of_detection_;  // the detection that it is another part of, -1 = none
};

}  // namespace spf
