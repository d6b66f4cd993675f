#include "spf/world/obstacle_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/believable.hpp"

namespace spf {
namespace {

constexpr double kCusumLimit = 3.0;       // [1] sigmas; a larger cusum means a new motion (a bounce)
constexpr double kCusumForgetting = 0.7;  // [1] from one innovation to the next: a cusum shows within three
constexpr double kMoving = 0.3;    // [1] of initial_speed: what stands tells nothing of how others move
constexpr double kOneEvent = 2.0;  // [s] changes closer together than this are no single event

bool well_formed(const Detection& detection) {
  const bool numbers = believable(detection.position_world) && believable(detection.radius) &&
                       believable(detection.position_sigma) &&
                       (!detection.velocity_world || believable(*detection.velocity_world));
  return numbers && detection.radius >= 0.0 && detection.position_sigma >= 0.0;
}

void predict(ObstacleTrack& track, double time) {
  const double dt = time - track.time;
  if (!(dt > 0.0)) return;
  const double v = track.velocity_variance;
  const double q = track.velocity_diffusion;
  track.state.position_world += dt * track.state.velocity_world;
  track.position_variance +=
      dt * (2.0 * track.cross_covariance + track.position_diffusion + dt * (v + q * dt / 3.0));
  track.cross_covariance += dt * (v + 0.5 * q * dt);
  track.velocity_variance += q * dt;
  track.time = time;
}

void correct_position(ObstacleTrack& track, const Eigen::Vector2d& innovation, double noise) {
  const double innovation_variance = track.position_variance + noise;
  const double kept = noise / innovation_variance;
  track.state.position_world += (1.0 - kept) * innovation;
  track.state.velocity_world += track.cross_covariance / innovation_variance * innovation;
  track.velocity_variance -= track.cross_covariance * track.cross_covariance / innovation_variance;
  track.position_variance *= kept;
  track.cross_covariance *= kept;
}

void correct_velocity(ObstacleTrack& track, const Eigen::Vector2d& innovation, double noise) {
  const double innovation_variance = track.velocity_variance + noise;
  const double kept = noise / innovation_variance;
  track.state.velocity_world += (1.0 - kept) * innovation;
  track.state.position_world += track.cross_covariance / innovation_variance * innovation;
  track.position_variance -= track.cross_covariance * track.cross_covariance / innovation_variance;
  track.velocity_variance *= kept;
  track.cross_covariance *= kept;
}

}  // namespace

ObstacleTracker::ObstacleTracker(const ObstacleTrackerParameters& parameters)
    : parameters_{validated(parameters)}, population_{parameters.diffusion} {}

void ObstacleTracker::update(const Observation& observation) {
  if (!std::isfinite(observation.time)) {
    stats_.malformed += observation.detections.size();
    return;
  }
  for (const Detection& detection : observation.detections) {
    if (well_formed(detection)) {
      enter(detection, observation.time);
    } else {
      ++stats_.malformed;
    }
  }
  for (ObstacleTrack& track : tracks_) predict(track, observation.time);
  drop_unseen(observation.time);
}

void ObstacleTracker::enter(const Detection& detection, double time) {
  const auto found = std::lower_bound(tracks_.begin(), tracks_.end(), detection.id,
                                      [](const ObstacleTrack& track, int id) { return track.id < id; });
  const auto slot = static_cast<std::size_t>(found - tracks_.begin());
  if (found == tracks_.end() || found->id != detection.id) {
    if (tracks_.size() >= kMostTracks) {
      ++stats_.crowded;
      return;
    }
    begin_track(slot, detection, time);
  } else if (!(time > memories_[slot].last_seen)) {
    ++stats_.stale;
    return;
  } else if (time - memories_[slot].last_seen > parameters_.timeout) {
    ++stats_.dropped;  // too old to continue: the same id, a new track
    tracks_.erase(found);
    memories_.erase(memories_.begin() + static_cast<std::ptrdiff_t>(slot));
    begin_track(slot, detection, time);
  } else {
    correct(tracks_[slot], memories_[slot], detection, time);
  }
  ++stats_.accepted;
}

void ObstacleTracker::begin_track(std::size_t slot, const Detection& detection, double time) {
  Memory memory;
  memory.last_seen = time;
  memory.still_since = time;
  memory.stood_at = detection.position_world;
  memory.diffusion = DiffusionEstimator{parameters_.diffusion, population_.prior()};
  const double sigma = std::max(detection.position_sigma, parameters_.least_sigma);
  ObstacleTrack track;
  track.id = detection.id;
  track.time = time;
  track.state.position_world = detection.position_world;
  track.state.radius = detection.radius;
  track.position_variance = sigma * sigma;
  if (detection.velocity_world) {
    track.state.velocity_world = *detection.velocity_world;
    track.velocity_variance = parameters_.least_sigma * parameters_.least_sigma;
    memory.diffusion.update(time, detection.position_world, detection.position_sigma,
                            *detection.velocity_world);
  } else {
    track.velocity_variance = parameters_.initial_speed * parameters_.initial_speed;
    memory.diffusion.update(time, detection.position_world, detection.position_sigma);
  }
  track.position_diffusion = memory.diffusion.position_diffusion();
  track.velocity_diffusion = memory.diffusion.velocity_diffusion();
  tracks_.insert(tracks_.begin() + static_cast<std::ptrdiff_t>(slot), track);
  memories_.insert(memories_.begin() + static_cast<std::ptrdiff_t>(slot), memory);
}

void ObstacleTracker::correct(ObstacleTrack& track, Memory& memory, const Detection& detection, double time) {
  // 1. predict to the detection
  const double dt = time - memory.last_seen;
  predict(track, time);
  memory.last_seen = time;

  // 2. is it the same motion as before?
  const double least = parameters_.least_sigma * parameters_.least_sigma;
  const double position_noise = std::max(detection.position_sigma * detection.position_sigma, least);
  const double velocity_noise = std::max(memory.diffusion.velocity_noise(), least);
  const double limit = 2.0 * kCusumLimit * kCusumLimit;  // two axes
  Eigen::Vector2d innovation = detection.position_world - track.state.position_world;
  memory.cusum =
      kCusumForgetting * memory.cusum + innovation / std::sqrt(track.position_variance + position_noise);
  bool changed = (1.0 - kCusumForgetting * kCusumForgetting) * memory.cusum.squaredNorm() > limit;
  if (detection.velocity_world) {
    const Eigen::Vector2d change = *detection.velocity_world - track.state.velocity_world;
    changed = changed || change.squaredNorm() > limit * (track.velocity_variance + velocity_noise);
  }
  if (changed) {
    ++stats_.changes;
    // A single change is a bounce; repeated ones are process noise, which is to be learnt.
    if (time - memory.last_change > kOneEvent) memory.diffusion.restart();
    memory.last_change = time;
    memory.still_since = time;
    memory.stood_at = detection.position_world;
    memory.cusum.setZero();
    // An obstacle that turned round has changed its velocity by up to twice its speed.
    const double speed = std::max(parameters_.initial_speed, 2.0 * track.state.velocity_world.norm());
    track.velocity_variance += speed * speed;
    track.cross_covariance += speed * speed * dt;
    track.position_variance += speed * speed * dt * dt;
  }

  // 3. correct
  correct_position(track, innovation, position_noise);
  if (detection.velocity_world) {
    correct_velocity(track, *detection.velocity_world - track.state.velocity_world, velocity_noise);
  }
  track.state.radius = detection.radius;
  watch_standing(track, memory, detection, time);

  // 4. learn
  if (detection.velocity_world) {
    memory.diffusion.update(time, detection.position_world, detection.position_sigma,
                            *detection.velocity_world);
  } else {
    memory.diffusion.update(time, detection.position_world, detection.position_sigma);
  }
  track.position_diffusion = memory.diffusion.position_diffusion();
  track.velocity_diffusion = memory.diffusion.velocity_diffusion();
  if (track.state.velocity_world.norm() <= kMoving * parameters_.initial_speed) return;
  if (detection.velocity_world)
    population_.learn(dt, track.velocity_diffusion, track.position_diffusion);
  else
    population_.learn(dt, memory.diffusion.new_evidence());
}

void ObstacleTracker::watch_standing(ObstacleTrack& track, Memory& memory, const Detection& detection,
                                     double time) const {
  const double moved = (track.state.position_world - memory.stood_at).norm();
  const double speed = track.state.velocity_world.norm();
  const bool starts = speed > std::max(parameters_.still_speed, 3.0 * std::sqrt(track.velocity_variance));
  if (starts || moved > std::max(parameters_.still_distance, 3.0 * detection.position_sigma)) {
    memory.stood_at = track.state.position_world;
    memory.still_since = time;
  }
  track.stood = time - memory.still_since;
}

void ObstacleTracker::drop_unseen(double time) {
  stats_.dropped += drop([&](std::size_t k) { return time - memories_[k].last_seen > parameters_.timeout; });
}

void ObstacleTracker::forget(const std::vector<int>& ids) {
  static_cast<void>(
      drop([&](std::size_t k) { return std::binary_search(ids.begin(), ids.end(), tracks_[k].id); }));
}

template <class Over>
std::size_t ObstacleTracker::drop(const Over& over) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    if (over(k)) continue;
    if (kept != k) {
      tracks_[kept] = tracks_[k];
      memories_[kept] = memories_[k];
    }
    ++kept;
  }
  const std::size_t dropped = tracks_.size() - kept;
  tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(kept), tracks_.end());
  memories_.erase(memories_.begin() + static_cast<std::ptrdiff_t>(kept), memories_.end());
  return dropped;
}

}  // namespace spf
