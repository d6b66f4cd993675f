#include "spf/perception/scan_tracker.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/math/index.hpp"

namespace spf {
namespace {

constexpr double kTentativeCost = 1.0;    // [1] confirmed tracks are preferred
constexpr double kReferenceSigma = 0.05;  // [m] innovation sigma whose log-determinant costs 0
constexpr double kTentativeTime = 0.35;   // [s] longest time out of sight of a tentative track
constexpr double kRadiusDrift = 0.02;     // [m/sqrt(s)] process noise of the radius
constexpr double kSameTime = 0.01;        // [s] parts farther apart in time are not fitted together
constexpr double kDoubleShare = 0.5;      // [1] of the sum of radii: nearer than this, two tracks are one
constexpr double kStopTime = 3.0;         // [s] at one position
constexpr double kVacatedSigmas = 5.0;    // [1] of the range noise
constexpr double kLargestSigma = 1.0;     // [m] a track with a larger position sigma ends

}  // namespace

void ScanTracker::update(const SensorSweep& sweep, const Segmentation& segmentation, ScanDetector& detector) {
  const double time = sweep.time + 0.5 * sweep.duration;
  ended_.clear();
  if (next_id_ > kLastScanTrackId) {  // after years of operation, or of hostile scans
    tracks_.clear();
    next_id_ = 0;
  }
  for (ScanTrack& track : tracks_) predict(track, time, parameters_);
  match(detector.detections());
  join_parts(segmentation, detector.detections());
  correct_matched(sweep, segmentation, detector);
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    if (assignment_.column_of_row()[k] < 0) look_for(sweep, tracks_[k]);
    judge(sweep, tracks_[k]);
  }
  end_doubles();
  drop_ended(time);
  give_birth(segmentation, detector.detections());
}

void ScanTracker::match(const std::vector<ScanDetection>& detections) {
  pairs_.clear();
  for (std::size_t row = 0; row < tracks_.size(); ++row) {
    const ScanTrack& track = tracks_[row];
    for (std::size_t column = 0; column < detections.size(); ++column) {
      const ScanDetection& detection = detections[column];
      Innovation innovation = innovation_of(track, detection);
      // The gate allows for a sudden change of velocity (a bounce) between two sweeps.
      const double sudden =
          parameters_.sudden_speed * std::clamp(detection.time - track.evidence.last_seen, 0.0, 0.2);
      innovation.covariance += sudden * sudden * Eigen::Matrix2d::Identity();
      const double reach = parameters_.gate * innovation.covariance.trace();
      if (innovation.difference.squaredNorm() > reach) continue;
      const double distance = innovation.squared_mahalanobis();
      if (distance > parameters_.gate) continue;
      const double spread = std::sqrt(std::max(innovation.covariance.determinant(), 1e-12));
      const double cost = distance + 2.0 * std::log(spread / (kReferenceSigma * kReferenceSigma)) +
                          (track.confirmed ? 0.0 : kTentativeCost);
      pairs_.push_back({static_cast<int>(row), static_cast<int>(column), cost});
    }
  }
  assignment_.solve(static_cast<int>(tracks_.size()), static_cast<int>(detections.size()), pairs_,
                    parameters_.unassigned_cost);
}

/// An unmatched detection within the disc of a matched track is part of the same object, split by something
/// thin in front of it.
void ScanTracker::join_parts(const Segmentation& segmentation, std::vector<ScanDetection>& detections) {
  const std::vector<ScanReturn>& returns = segmentation.returns();
  main_of_detection_.assign(detections.size(), -1);
  for (std::size_t k = 0; k < detections.size(); ++k) {
    if (assignment_.row_of_column()[k] >= 0) continue;
    const Segment& part = detections[k].parts[0];
    const std::array<int, 3> indices{part.first, part.first + part.count / 2, part.first + part.count - 1};
    for (std::size_t row = 0; row < tracks_.size(); ++row) {
      const int main = assignment_.column_of_row()[row];
      if (main < 0 || detections[as_index(main)].part_count >= ScanDetection::kMostParts) continue;
      const double reach = tracks_[row].radius + 3.0 * parameters_.range_sigma +
                           2.0 * std::sqrt(0.5 * tracks_[row].position_covariance().trace());
      const bool within = std::all_of(indices.begin(), indices.end(), [&](int index) {
        return (returns[as_index(index)].position_world - tracks_[row].position()).norm() < reach;
      });
      if (!within) continue;
      main_of_detection_[k] = main;
      ScanDetection& whole = detections[as_index(main)];
      if (std::abs(whole.time - detections[k].time) > kSameTime) break;
      whole.parts[as_index(whole.part_count++)] = part;
      whole.returns += part.count;
      std::sort(whole.parts.begin(), whole.parts.begin() + whole.part_count,
                [](const Segment& a, const Segment& b) { return a.first < b.first; });
      break;
    }
  }
}

void ScanTracker::correct_matched(const SensorSweep& sweep, const Segmentation& segmentation,
                                  ScanDetector& detector) {
  std::vector<ScanDetection>& detections = detector.detections();
  track_of_detection_.assign(detections.size(), -1);
  for (std::size_t row = 0; row < tracks_.size(); ++row) {
    const int column = assignment_.column_of_row()[row];
    if (column < 0) continue;
    ScanTrack& track = tracks_[row];
    ScanDetection& detection = detections[as_index(column)];
    const double unseen = std::max(detection.time - track.evidence.last_seen, 0.0);
    track.radius_variance += kRadiusDrift * kRadiusDrift * unseen;
    const bool part_of_disc = detection.kind == ScanDetection::Kind::face && track.dynamic && !track.face &&
                              detection.radius < track.radius + 3.0 * parameters_.range_sigma;
    if ((detection.kind == ScanDetection::Kind::disc && !track.face) || part_of_disc) {
      detector.refit(sweep, segmentation, track.radius, std::sqrt(track.radius_variance), detection);
      track.radius = detection.radius;
      track.radius_variance = detection.radius_variance;
    } else {
      const double gain = track.radius_variance / (track.radius_variance + detection.radius_variance);
      track.radius += gain * (detection.radius - track.radius);
      track.radius_variance *= 1.0 - gain;
    }
    correct(track, detection, parameters_);
    track_of_detection_[as_index(column)] = track.id;
  }
  for (std::size_t k = 0; k < detections.size(); ++k)
    if (main_of_detection_[k] >= 0)
      track_of_detection_[k] = track_of_detection_[as_index(main_of_detection_[k])];
}

void ScanTracker::look_for(const SensorSweep& sweep, ScanTrack& track) const {
  const double sigma = std::sqrt(0.5 * track.position_covariance().trace());
  const double tolerance = 3.0 * parameters_.range_sigma + 0.5 * std::min(sigma, track.radius);
  const DiscVisibility seen = look_at_disc(sweep, track.position(), track.radius, tolerance);
  if (2 * seen.through >= seen.all()) {
    track.sight = ScanTrack::Sight::missing;
    ++track.evidence.misses;
  } else if (seen.on > seen.blocked + seen.unknown) {
    track.sight = ScanTrack::Sight::absorbed;
  } else {
    track.sight = ScanTrack::Sight::hidden;
  }
}

/// Is it confirmed, reported, dynamic?
void ScanTracker::judge(const SensorSweep& sweep, ScanTrack& track) {
  if (!track.confirmed && track.evidence.sweeps >= parameters_.confirming_hits - 1e-9) {
    track.confirmed = true;
    ++stats_.confirmed;
  }
  // A part of a larger surface enters the map at once and is not reported.
  const bool alone = track.sight == ScanTrack::Sight::seen ? track.isolated && !track.face : track.reported;
  const bool report = track.dynamic || (!parameters_.moving_alone && (!parameters_.map_scans || alone));
  if (track.reported && !report) ended_.push_back(track.id);
  track.reported = report;
  if (track.sight != ScanTrack::Sight::seen) return;
  if (track.dynamic) {
    watch_stand(track);
    return;
  }
  // A better estimate of the depth moves the centre, not the object.
  Eigen::Vector2d gone = track.position() - track.birth.position_world;
  if (track.face) gone = gone.dot(track.behind) * track.behind;
  const double distance = gone.norm();
  gone *= std::max(1.0 - std::abs(track.depth - track.birth.depth) / std::max(distance, 1e-9), 0.0);
  const Eigen::Matrix2d spread = track.birth.covariance + track.position_covariance();
  const bool displaced = gone.norm() > parameters_.dynamic_distance && track.evidence.sweeps >= 2.0 &&
                         gone.dot(spread.inverse() * gone) > 11.8;  // three sigma, two degrees
  // What moves into space seen free is known by that. What moves on into its own shadow leaves all of
  // where it was.
  const auto left = [&](const Eigen::Vector2d& position) {
    return vacated(sweep, position, kVacatedSigmas * parameters_.range_sigma);
  };
  const auto& before = track.birth.returns_world;
  track.dynamic = track.evidence.free_sweeps >= 1.5 ||
                  (displaced && (!parameters_.map_scans || std::all_of(before.begin(), before.end(), left)));
}

/// Where an outside detector tells of all that might start to move, what has stopped is static, like what
/// never moved: it enters the map, until it moves again.
void ScanTracker::watch_stand(ScanTrack& track) const {
  if (!parameters_.map_scans || !parameters_.moving_alone) return;
  const double reach =
      parameters_.dynamic_distance + 2.0 * std::sqrt(0.5 * track.position_covariance().trace());
  if (track.still_since <= track.birth.time || (track.position() - track.still_world).norm() > reach) {
    track.still_world = track.position();
    track.still_since = track.time;
  }
  if (track.time - track.still_since < kStopTime) return;
  track.dynamic = false;
  track.evidence.free_sweeps = 0.0;
  track.birth.time = track.time;
  track.birth.position_world = track.position();
  track.birth.covariance = track.position_covariance();
  track.birth.depth = track.depth;
  // From now on it is in the map, so only returns in space seen free show that it moves.
  track.birth.returns_world.fill(Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
}

/// Of two tracks of one object the younger ends.
void ScanTracker::end_doubles() {
  for (std::size_t young = 1; young < tracks_.size(); ++young) {
    ScanTrack& track = tracks_[young];
    if (track.face || track.sight != ScanTrack::Sight::seen) continue;
    for (std::size_t old = 0; old < young; ++old) {
      const ScanTrack& other = tracks_[old];
      if (other.face || other.sight != ScanTrack::Sight::seen) continue;
      const double reach = kDoubleShare * (track.radius + other.radius);
      if ((track.position() - other.position()).squaredNorm() >= reach * reach) continue;
      track.sight = ScanTrack::Sight::doubled;
      break;
    }
  }
}

bool ScanTracker::over(const ScanTrack& track, double time) {
  const double unseen = time - track.evidence.last_seen;
  const double sigma = std::sqrt(0.5 * track.position_covariance().trace());
  if (track.sight == ScanTrack::Sight::seen) return false;
  if (track.sight == ScanTrack::Sight::doubled ||
      (track.sight == ScanTrack::Sight::absorbed && !track.dynamic)) {
    ++stats_.absorbed;
    return true;
  }
  // An uncertain prediction may be off: then more misses are needed.
  const int most_misses = parameters_.misses + std::min(static_cast<int>(sigma / 0.1), 5);
  if (track.evidence.misses >= (track.confirmed ? most_misses : 2)) {
    ++stats_.missed;
    return true;
  }
  // By then, what never moved is in the map.
  const bool mapped = parameters_.map_scans && !track.dynamic &&
                      (track.face || track.evidence.last_seen - track.birth.time > parameters_.probation);
  const bool brief = !track.confirmed || mapped;
  if (unseen > (brief ? kTentativeTime : parameters_.coast_time) || sigma > kLargestSigma) {
    ++stats_.lost;
    return true;
  }
  return false;
}

void ScanTracker::drop_ended(double time) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    if (over(tracks_[k], time)) {
      ended_.push_back(tracks_[k].id);
      continue;
    }
    if (kept != k) tracks_[kept] = tracks_[k];
    ++kept;
  }
  tracks_.resize(kept);
  std::sort(ended_.begin(), ended_.end());
  ended_.erase(std::unique(ended_.begin(), ended_.end()), ended_.end());
}

void ScanTracker::give_birth(const Segmentation& segmentation, const std::vector<ScanDetection>& detections) {
  for (std::size_t k = 0; k < detections.size(); ++k) {
    if (track_of_detection_[k] >= 0) continue;
    if (tracks_.size() >= kMostScanTracks) {
      ++stats_.crowded;
      continue;
    }
    track_of_detection_[k] = next_id_;
    tracks_.push_back(born_track(next_id_++, detections[k], parameters_));
    const Segment& part = detections[k].parts[0];
    const std::array<int, 3> some{part.first, part.first + part.count / 2, part.first + part.count - 1};
    for (std::size_t i = 0; i < some.size(); ++i)
      tracks_.back().birth.returns_world[i] = segmentation.returns()[as_index(some[i])].position_world;
    tracks_.back().reported =
        !parameters_.moving_alone && (!parameters_.map_scans || detections[k].isolated());
    ++stats_.born;
  }
}

}  // namespace spf
