#include "spf/planning/space_time/space_time_risk.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/normal_distribution.hpp"
#include "spf/world/prediction.hpp"

namespace spf {
namespace {

constexpr double kStoppedPeerGrowth = 0.25;  // [1] of the growth of a peer's uncertainty, while it is stopped
constexpr double kNegligibleSigmas =
    4.0;  // Phi(-4) = 3e-5: a contact of cost 1000 s then counts 0.03 s at most

}  // namespace

SpaceTimeRisk::SpaceTimeRisk(const SpaceTimeParameters& parameters, double robot_radius, double max_speed)
    : parameters_{parameters},
      robot_radius_{robot_radius},
      max_speed_{max_speed},
      steps_{std::min(kMaxSteps, static_cast<int>(std::lround(parameters.horizon / parameters.step)))} {
  for (int k = 0; k <= kMaxSteps; ++k) {
    const auto at = static_cast<std::size_t>(k);
    discount_[at] = std::exp(-k * parameters.step / parameters.discount_time);
    peer_discount_[at] = std::exp(-k * parameters.step / parameters.peer_discount_time);
  }
  order_.reserve(256);
}

void SpaceTimeRisk::prepare(const PlanRequest& request) {
  disc_count_ = 0;
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
  if (order_.size() > kMaxDiscs) {
    std::nth_element(order_.begin(), order_.begin() + kMaxDiscs, order_.end());
    order_.resize(kMaxDiscs);
  }
  for (const auto& [gap, index] : order_) {
    if (index >= 0) {
      add_track(request, tracks[static_cast<std::size_t>(index)]);
    } else {
      add_peer(request, peers[static_cast<std::size_t>(-1 - index)]);
    }
  }
}

SpaceTimeRisk::PredictedDisc* SpaceTimeRisk::next_disc() {
  const auto next = static_cast<std::size_t>(disc_count_++);
  if (next == discs_.size()) discs_.emplace_back();
  return &discs_[next];
}

void SpaceTimeRisk::add_track(const PlanRequest& request, const ObstacleTrack& track) {
  const double lead = request.time - track.time;  // the track may be older than the plan's start
  const ObstaclePrediction prediction{track, lead + steps_ * parameters_.step, parameters_.step,
                                      parameters_.predict_bounces ? request.world.map : nullptr};
  PredictedDisc& disc = *next_disc();
  disc.id = track.id;
  disc.is_peer = false;
  disc.stopped = false;
  disc.priority_weight = 1.0;
  disc.radius = robot_radius_ + track.state.radius + parameters_.margin;
  for (int k = 0; k <= steps_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    disc.mean_world[at] = prediction.position(lead + k * parameters_.step);
    disc.sigma[at] = std::hypot(prediction.sigma(lead + k * parameters_.step), parameters_.sigma_floor);
  }
  finish(disc, request.position_sigma);
}

void SpaceTimeRisk::add_peer(const PlanRequest& request, const Peer& peer) {
  PredictedDisc& disc = *next_disc();
  disc.id = peer.robot_id;
  disc.is_peer = true;
  // A stopped peer cannot be asked to yield; a moving one of lower priority will.
  const bool yields =
      goes_first(request.world.rank(), peer.rank()) && peer.state == PeerState::moving && !peer.expired;
  disc.priority_weight = yields ? kLowerPriorityWeight : 1.0;
  disc.radius = robot_radius_ + peer.radius + peer.growth + parameters_.peer_margin;
  // A stopped peer starts moving only to dodge or to go on.
  const bool stopped = peer.state == PeerState::stopped || peer.state == PeerState::arrived;
  disc.stopped = stopped && !peer.expired;
  const double growth = parameters_.peer_sigma_growth * (stopped ? kStoppedPeerGrowth : 1.0);
  for (int k = 0; k <= steps_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double ahead = k * parameters_.step;
    disc.mean_world[at] = peer.position(request.time + ahead);
    disc.sigma[at] = std::hypot(parameters_.peer_sigma + growth * ahead, peer.position_sigma);
  }
  finish(disc, request.position_sigma);
}

void SpaceTimeRisk::finish(PredictedDisc& disc, double own_sigma) {
  for (int k = 0; k <= steps_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    disc.sigma[at] = std::hypot(disc.sigma[at], own_sigma);
    disc.weight[at] = normal_within(disc.radius / disc.sigma[at]) *
                      (disc.is_peer ? peer_discount_ : discount_)[at] * disc.priority_weight;
    disc.reach[at] = disc.radius + kNegligibleSigmas * disc.sigma[at];
  }
}

double SpaceTimeRisk::chance(const PredictedDisc& disc, int step,
                             const Eigen::Vector2d& position_world) const {
  const auto at = static_cast<std::size_t>(step);
  const double squared = (position_world - disc.mean_world[at]).squaredNorm();
  if (squared > disc.reach[at] * disc.reach[at]) return 0.0;
  const double z = (std::sqrt(squared) - disc.radius) / disc.sigma[at];
  return normal_tail(z) * disc.weight[at];
}

double SpaceTimeRisk::along(const std::array<Eigen::Vector2d, kMaxSteps + 1>& positions, int steps,
                            const Eigen::Vector2d& stop_world, double enough, int* worst) const {
  double sum = 0.0;
  double largest = 0.0;
  if (worst != nullptr) *worst = -1;
  for (int i = 0; i < disc_count_; ++i) {
    const PredictedDisc& disc = discs_[static_cast<std::size_t>(i)];
    double peak = chance(disc, steps, stop_world);
    if (disc.stopped) peak /= peer_discount_[static_cast<std::size_t>(steps)];
    for (int k = 1; k <= steps; ++k) {
      if (disc.weight[static_cast<std::size_t>(k)] <= peak) continue;  // cannot exceed the peak
      peak = std::max(peak, chance(disc, k, positions[static_cast<std::size_t>(k)]));
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
