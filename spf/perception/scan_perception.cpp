#include "spf/perception/scan_perception.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/math/index.hpp"

namespace spf {

ScanPerception::ScanPerception(const PerceptionParameters& parameters)
    : parameters_{validated(parameters)},
      segmentation_{parameters_},
      detector_{parameters_},
      tracker_{parameters_},
      last_time_{-std::numeric_limits<double>::infinity()} {}

bool ScanPerception::update(const SensorSweep& sweep, const OccupancyMap& map,
                            const std::vector<MaskedDisc>& discs) {
  if (!sweep.well_formed()) {
    ++stats_.malformed;
    return false;
  }
  if (!(sweep.time > last_time_)) {
    ++stats_.stale;
    return false;
  }
  ++stats_.sweeps;
  last_time_ = sweep.time;
  kept_out_.assign(sweep.scan->ranges.size(), 0);
  returns_.reserve(sweep.scan->ranges.size());
  masked_.reserve(sweep.scan->ranges.size());
  collect_returns(sweep, returns_);
  mask_by_map(map);
  mask_by_discs(sweep, discs);
  segmentation_.run(sweep, returns_, masked_);
  detector_.run(sweep, segmentation_);
  compare_with_free_space(map);
  tracker_.update(sweep, segmentation_, detector_);
  mark_kept_out();
  return true;
}

/// Return by return, so that an object close to a wall keeps the rest of its returns.
void ScanPerception::mask_by_map(const OccupancyMap& map) {
  // Half a cell, since the surface may run anywhere through a cell.
  const double tolerance =
      3.0 * std::hypot(parameters_.range_sigma, parameters_.pose_sigma) + 0.5 * map.frame().resolution;
  masked_.resize(returns_.size());
  for (std::size_t k = 0; k < returns_.size(); ++k)
    masked_[k] = map.distance(returns_[k].position_world) < tolerance ? 1 : 0;
}

void ScanPerception::mask_by_discs(const SensorSweep& sweep, const std::vector<MaskedDisc>& discs) {
  if (discs.empty()) return;
  return_at_.assign(sweep.scan->ranges.size(), -1);
  for (std::size_t k = 0; k < returns_.size(); ++k)
    return_at_[as_index(returns_[k].beam)] = static_cast<std::int32_t>(k);
  for (const MaskedDisc& disc : discs) {
    const double middle = sweep.beam_towards(disc.position_world);
    const double distance = (disc.position_world - sweep.ray(middle).origin_world).norm();
    if (!(distance - disc.radius < sweep.scan->max_range)) continue;
    const double reach = distance > disc.radius ? std::asin(disc.radius / distance) : 4.0;
    const double half_span = reach / std::abs(sweep.scan->angle_increment) + 1.0;
    const long low = std::lround(std::max(middle - half_span, middle - 0.5 * sweep.beams()));
    const long high = std::lround(std::min(middle + half_span, middle + 0.5 * sweep.beams()));
    for (long number = low; number <= high; ++number) {
      const int beam = sweep.wrapped(number);
      const std::int32_t index = beam < 0 ? -1 : return_at_[as_index(beam)];
      if (index < 0) continue;
      const Eigen::Vector2d offset = returns_[as_index(index)].position_world - disc.position_world;
      if (offset.squaredNorm() >= disc.radius * disc.radius) continue;
      masked_[as_index(index)] = 1;
      kept_out_[as_index(beam)] = 1;
    }
  }
}

void ScanPerception::compare_with_free_space(const OccupancyMap& map) {
  if (!map.sensed()) return;
  for (ScanDetection& detection : detector_.detections()) {
    int free = 0;
    for (int part = 0; part < detection.part_count; ++part) {
      const Segment& segment = detection.parts[as_index(part)];
      for (int k = 0; k < segment.count; ++k)
        if (map.seen_free(segmentation_.returns()[as_index(segment.first + k)].position_world)) ++free;
    }
    detection.free_share = static_cast<double>(free) / std::max(detection.returns, 1);
  }
}

void ScanPerception::mark_kept_out() {
  const std::vector<ScanDetection>& found = detector_.detections();
  for (std::size_t k = 0; k < found.size(); ++k) {
    const int id = tracker_.track_of_detection()[k];
    const auto track = std::lower_bound(tracks().begin(), tracks().end(), id,
                                        [](const ScanTrack& one, int wanted) { return one.id < wanted; });
    if (track == tracks().end() || track->id != id) continue;
    // A new compact object gets time to show whether it moves.
    const bool on_probation = !parameters_.moving_alone && track->isolated &&
                              track->time - track->birth.time < parameters_.probation;
    if (!track->dynamic && !on_probation) continue;
    for (int part = 0; part < found[k].part_count; ++part) {
      const Segment& segment = found[k].parts[as_index(part)];
      for (int i = 0; i < segment.count; ++i)
        kept_out_[as_index(segmentation_.returns()[as_index(segment.first + i)].beam)] = 1;
    }
  }
}

void ScanPerception::detections(double time, std::vector<Detection>& detections) const {
  detections.clear();
  for (const ScanTrack& track : tracks()) {
    if (track.sight != ScanTrack::Sight::seen || !track.reported) continue;
    Detection detection;
    detection.id = track.id;
    detection.position_world = track.measured_world + (time - track.time) * track.velocity();
    detection.radius = track.radius;
    detection.position_sigma = track.measured_sigma;
    detections.push_back(detection);
  }
}

}  // namespace spf
