#include "spf/planning/space_time/space_time_risk.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/normal_distribution.hpp"
#include "spf/world/prediction.hpp"

namespace spf {
namespace {

constexpr double kStandingPeerGrowth = 0.25;  // [1] of the growth of a peer's uncertainty, while it stands
constexpr double kNegligibleSigmas = 4.0;     // Phi(-4) = 3e-5: a 1000 s contact then costs 0.03 s at most

}  // namespace

double overlap_probability(double distance, double radius, double sigma) {
  return normal_tail((distance - radius) / sigma) * normal_within(radius / sigma);
}

SpaceTimeRisk::SpaceTimeRisk(const SpaceTimeParameters& parameters, double robot_radius, double max_speed)
    : parameters_{parameters},
      robot_radius_{robot_radius},
      max_speed_{max_speed},
      steps_{std::min(kMaxSteps, static_cast<int>(std::lround(parameters.horizon / parameters.step)))} {
  for (int k = 0; k <= kMaxSteps; ++k) {
    const auto at = static_cast<std::size_t>(k);
    fading_[at] = std::exp(-k * parameters.step / parameters.risk_fading);
    peer_fading_[at] = std::exp(-k * parameters.step / parameters.peer_risk_fading);
  }
  order_.reserve(256);
}

void SpaceTimeRisk::prepare(const PlanRequest& request) {
  entity_count_ = 0;
  order_.clear();
  const std::vector<ObstacleTrack> no_tracks;
  const std::vector<Peer> no_peers;
  const std::vector<ObstacleTrack>& tracks =
      request.world.tracks != nullptr ? *request.world.tracks : no_tracks;
  const std::vector<Peer>& peers = request.world.peers != nullptr ? *request.world.peers : no_peers;
  const double horizon = steps_ * parameters_.step;
  const Eigen::Vector2d& here = request.head.position_world;

  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const ObstacleTrack& track = tracks[i];
    const double reach = (max_speed_ + track.state.velocity_world.norm()) * horizon + track.state.radius +
                         robot_radius_ + parameters_.margin +
                         kNegligibleSigmas * track.position_sigma(request.time + horizon - track.time);
    const double gap = (track.state.position_world - here).norm();
    if (gap < reach) order_.emplace_back(gap, static_cast<int>(i));
  }
  for (std::size_t i = 0; i < peers.size(); ++i) {
    const Peer& peer = peers[i];
    const double gap = (peer.position(request.time) - here).norm();
    const double reach = 2.0 * max_speed_ * horizon + peer.radius + peer.growth + 4.0 * robot_radius_;
    if (gap < reach) order_.emplace_back(gap, -1 - static_cast<int>(i));
  }
  if (order_.size() > kMaxEntities) {
    std::nth_element(order_.begin(), order_.begin() + kMaxEntities, order_.end());
    order_.resize(kMaxEntities);
  }
  for (const auto& [gap, index] : order_) {
    if (index >= 0) {
      add_track(request, tracks[static_cast<std::size_t>(index)]);
    } else {
      add_peer(request, peers[static_cast<std::size_t>(-1 - index)]);
    }
  }
}

SpaceTimeRisk::Entity* SpaceTimeRisk::next_entity() {
  const auto next = static_cast<std::size_t>(entity_count_++);
  if (next == entities_.size()) entities_.emplace_back();
  return &entities_[next];
}

void SpaceTimeRisk::add_track(const PlanRequest& request, const ObstacleTrack& track) {
  const double lead = request.time - track.time;  // the track may be older than the plan's start
  const ObstaclePrediction prediction{track, lead + steps_ * parameters_.step, parameters_.step,
                                      parameters_.predict_bounces ? request.world.map : nullptr};
  Entity& entity = *next_entity();
  entity.id = track.id;
  entity.is_peer = false;
  entity.stands = false;
  entity.weight = 1.0;
  entity.radius = robot_radius_ + track.state.radius + parameters_.margin;
  for (int k = 0; k <= steps_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    entity.mean_world[at] = prediction.position(lead + k * parameters_.step);
    entity.sigma[at] = std::hypot(prediction.sigma(lead + k * parameters_.step), parameters_.sigma_floor);
  }
  finish(entity, request.position_sigma);
}

void SpaceTimeRisk::add_peer(const PlanRequest& request, const Peer& peer) {
  Entity& entity = *next_entity();
  entity.id = peer.robot_id;
  entity.is_peer = true;
  // A peer that stands cannot be asked to yield; a moving one that comes after us will.
  const bool yields =
      goes_first(request.world.rank(), peer.rank()) && peer.state == PeerState::moving && !peer.expired;
  entity.weight = yields ? kLowerPriorityWeight : 1.0;
  entity.radius = robot_radius_ + peer.radius + peer.growth + parameters_.peer_margin;
  // One that stands moves off only when it has to dodge or to go on.
  const bool stands = peer.state == PeerState::stopped || peer.state == PeerState::arrived;
  entity.stands = stands && !peer.expired;
  const double growth = parameters_.peer_sigma_growth * (stands ? kStandingPeerGrowth : 1.0);
  for (int k = 0; k <= steps_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double ahead = k * parameters_.step;
    entity.mean_world[at] = peer.position(request.time + ahead);
    entity.sigma[at] = std::hypot(parameters_.peer_sigma + growth * ahead, peer.position_sigma);
  }
  finish(entity, request.position_sigma);
}

void SpaceTimeRisk::finish(Entity& entity, double own_sigma) {
  for (int k = 0; k <= steps_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    entity.sigma[at] = std::hypot(entity.sigma[at], own_sigma);
    entity.size_factor[at] = normal_within(entity.radius / entity.sigma[at]) *
                             (entity.is_peer ? peer_fading_ : fading_)[at] * entity.weight;
    entity.reach[at] = entity.radius + kNegligibleSigmas * entity.sigma[at];
  }
}

double SpaceTimeRisk::chance(const Entity& entity, int step, const Eigen::Vector2d& position_world) const {
  const auto at = static_cast<std::size_t>(step);
  const double squared = (position_world - entity.mean_world[at]).squaredNorm();
  if (squared > entity.reach[at] * entity.reach[at]) return 0.0;
  const double z = (std::sqrt(squared) - entity.radius) / entity.sigma[at];
  return normal_tail(z) * entity.size_factor[at];
}

double SpaceTimeRisk::along(const std::array<Eigen::Vector2d, kMaxSteps + 1>& positions, int steps,
                            const Eigen::Vector2d& stop_world, double enough, int* worst) const {
  double sum = 0.0;
  double largest = 0.0;
  if (worst != nullptr) *worst = -1;
  for (int i = 0; i < entity_count_; ++i) {
    const Entity& entity = entities_[static_cast<std::size_t>(i)];
    double peak = chance(entity, steps, stop_world);
    if (entity.stands) peak /= peer_fading_[static_cast<std::size_t>(steps)];
    for (int k = 1; k <= steps; ++k) {
      if (entity.size_factor[static_cast<std::size_t>(k)] <= peak) continue;  // cannot exceed the peak
      peak = std::max(peak, chance(entity, k, positions[static_cast<std::size_t>(k)]));
    }
    sum += peak;
    if (peak > largest) {
      largest = peak;
      if (worst != nullptr) *worst = i;
    }
    if (sum > enough) return sum;
  }
  return sum;
}

}  // namespace spf
