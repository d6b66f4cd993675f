#include "spf/planning/space_time/space_time_risk.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/normal_distribution.hpp"
#include "spf/planning/space_time/passage_speed.hpp"
#include "spf/world/prediction.hpp"

namespace spf {
namespace {

constexpr double kStillGrowth = 0.25;   // [1] of the growth of a peer's uncertainty, while it stands
constexpr double kStands = 0.3;         // [1] of a peer's radius: a plan that leads no farther stands
constexpr double kRestPace = 0.02;      // [1] of max_speed: it stands
constexpr double kAtGoalWeight = 0.1;   // [1] of the risk with peers, for a robot at its goal
constexpr double kAtGoal = 0.3;         // [1] of the radius
constexpr double kParking = 4.0;        // [1] of the radius
constexpr double kNearGoal = 3.0;       // [1] of the radius
constexpr double kAtGoalSpeed = 0.1;    // [1] of max_speed
constexpr double kTrackStands = 2.0;    // [s] at one position: it stands
constexpr double kArrivedCounts = 3.0;  // [1] of the time stood, for peers that say that they stay
constexpr std::size_t kMoreDiscs = 8;
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
    peer_discount_[at] = std::exp(-k * parameters.step / parameters.peer_discount_time);
  }
  order_.reserve(64);
}

void SpaceTimeRisk::prepare(const PlanRequest& request, const MovingRisk& moving) {
  const double discount_time = moving.discount_share * parameters_.discount_time;
  for (int k = 0; k <= kMaxSteps; ++k)
    discount_[static_cast<std::size_t>(k)] = std::exp(-k * parameters_.step / discount_time);
  disc_count_ = 0;
  order_.clear();
  watch_goal(request);
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
      add_track(request, tracks[static_cast<std::size_t>(index)], moving.weight);
    } else {
      add_peer(request, peers[static_cast<std::size_t>(-1 - index)]);
    }
  }
}

SpaceTimeRisk::PredictedDisc* SpaceTimeRisk::next_disc() {
  const auto next = static_cast<std::size_t>(disc_count_++);
  if (next == discs_.capacity()) discs_.reserve(next + kMoreDiscs);  // not twice as many: they are large
  if (next == discs_.size()) discs_.emplace_back();
  return &discs_[next];
}

void SpaceTimeRisk::add_track(const PlanRequest& request, const ObstacleTrack& track, double moving_weight) {
  const double lead = request.time - track.time;  // the track may be older than the plan's start
  const ObstaclePrediction prediction{track, lead + steps_ * parameters_.step, parameters_.step,
                                      parameters_.predict_bounces ? request.world.map : nullptr};
  PredictedDisc& disc = *next_disc();
  disc.id = track.id;
  disc.is_peer = false;
  disc.speed_margin = disc.speed_sigma = 0.0;
  disc.factor = moving_weight;
  const bool stands = track.stood > kTrackStands;
  disc.radius =
      robot_radius_ + track.state.radius + (stands ? parameters_.static_margin : parameters_.margin);
  for (int k = 0; k <= steps_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    disc.mean_world[at] = prediction.position(lead + k * parameters_.step);
    disc.sigma[at] = std::hypot(prediction.sigma(lead + k * parameters_.step), parameters_.sigma_floor);
  }
  if (!stands) {
    finish(disc, request.position_sigma);
    return;
  }
  for (int k = 0; k <= steps_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double ahead = k * parameters_.step;
    disc.sigma[at] = std::hypot(disc.sigma[at], 0.5 * parameters_.start_acceleration * ahead * ahead);
  }
  finish(disc, request.position_sigma);
  weigh_start(disc, track.stood);
  add_standing(track.id, false, track.state.position_world, track.state.radius, parameters_.margin,
               std::sqrt(track.position_variance), request.position_sigma);
}

/// Who has stood for T starts within t with probability t / (T + t). And to wait until it has gone would take
/// as long again, which counts the more against waiting.
void SpaceTimeRisk::weigh_start(PredictedDisc& disc, double stood) const {
  const double horizon = steps_ * parameters_.step;
  const double discount = horizon / (horizon + stood);
  for (int k = 0; k <= steps_; ++k) {
    const double ahead = k * parameters_.step;
    const double starts = stood + ahead > 0.0 ? ahead / (stood + ahead) : 1.0;
    disc.weight[static_cast<std::size_t>(k)] *= starts * discount * discount;
  }
}

void SpaceTimeRisk::add_standing(int id, bool is_peer, const Eigen::Vector2d& position_world, double radius,
                                 double margin, double sigma, double own_sigma) {
  PredictedDisc& disc = *next_disc();
  disc.id = id;
  disc.is_peer = is_peer;
  disc.factor = 1.0;
  disc.radius = robot_radius_ + radius + parameters_.static_margin;
  disc.speed_margin = std::max(margin - parameters_.static_margin, 0.0);
  disc.speed_sigma = parameters_.static_sigma;
  const double still = std::hypot(kStillPace * parameters_.static_sigma, sigma, own_sigma);
  disc.mean_world.fill(position_world);
  disc.sigma.fill(still);
  disc.weight.fill(normal_within(disc.radius / still) * (is_peer && at_goal_ ? kAtGoalWeight : 1.0));
}

void SpaceTimeRisk::add_peer(const PlanRequest& request, const Peer& peer) {
  PredictedDisc& disc = *next_disc();
  disc.id = peer.robot_id;
  disc.is_peer = true;
  disc.speed_margin = disc.speed_sigma = 0.0;
  // A stopped peer cannot be asked to yield; a moving one of lower priority will, and one that waits to let
  // others pass. And a robot at its goal is gone round.
  const bool waits = peer.claim != nullptr && peer.claim->waits;
  const bool yields =
      !request.give_way && !peer.expired &&
      (waits || (goes_first(request.world.rank(), peer.rank()) && peer.state == PeerState::moving));
  disc.factor = yields ? kLowerPriorityWeight : 1.0;
  if (at_goal_) disc.factor *= kAtGoalWeight;
  // What it says of its plan counts for more than what it says of its state.
  const Eigen::Vector2d now = peer.position(request.time);
  const double moves = (peer.position(request.time + steps_ * parameters_.step) - now).norm();
  const bool stands = (peer.state == PeerState::stopped || peer.state == PeerState::arrived) &&
                      !peer.expired && moves < kStands * peer.radius;
  disc.radius = robot_radius_ + peer.radius + peer.growth +
                (stands ? parameters_.static_margin : parameters_.peer_margin);
  // It plans again, less so where it means to stand; and where robots park, the less the slower it is.
  double sigma = parameters_.peer_sigma;
  for (int k = 0; k <= steps_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    disc.mean_world[at] = peer.position(request.time + k * parameters_.step);
    if (k > 0) {
      const double pace =
          (disc.mean_world[at] - disc.mean_world[at - 1]).norm() / (parameters_.step * max_speed_);
      const double share = near_goal_         ? std::clamp(pace, kStillGrowth, 1.0)
                           : pace > kRestPace ? 1.0
                                              : kStillGrowth;
      sigma += parameters_.peer_sigma_growth * share * parameters_.step;
    }
    disc.sigma[at] = std::hypot(sigma, peer.position_sigma);
  }
  finish(disc, request.position_sigma);
  if (!stands) return;
  // A stopped peer starts moving only to dodge or to go on, one that has arrived hardly ever.
  weigh_start(disc, peer.state == PeerState::arrived ? kArrivedCounts * peer.stood : peer.stood);
  add_standing(peer.robot_id, true, now, peer.radius, parameters_.peer_margin, peer.position_sigma,
               request.position_sigma);
}

/// Once there a robot counts as at its goal for as long as it stays near: who dodges comes back.
void SpaceTimeRisk::watch_goal(const PlanRequest& request) {
  if (request.goal_world != goal_) at_goal_ = false;
  goal_ = request.goal_world;
  const double gap = (request.head.position_world - goal_).norm();
  near_goal_ = gap < kParking * robot_radius_;
  if (gap > kNearGoal * robot_radius_)
    at_goal_ = false;
  else if (gap < kAtGoal * robot_radius_ && request.head.velocity_world.norm() < kAtGoalSpeed * max_speed_)
    at_goal_ = true;
}

void SpaceTimeRisk::finish(PredictedDisc& disc, double own_sigma) {
  for (int k = 0; k <= steps_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    disc.sigma[at] = std::hypot(disc.sigma[at], own_sigma);
    disc.weight[at] = normal_within(disc.radius / disc.sigma[at]) *
                      (disc.is_peer ? peer_discount_ : discount_)[at] * disc.factor;
  }
}

double SpaceTimeRisk::chance(const PredictedDisc& disc, int step, const Eigen::Vector2d& position_world,
                             double speed) const {
  const auto at = static_cast<std::size_t>(step);
  double radius = disc.radius;
  double sigma = disc.sigma[at];
  if (disc.stands()) {
    const double pace = std::min(1.0, speed / max_speed_);
    radius += pace * disc.speed_margin;
    sigma = std::hypot(sigma, pace * disc.speed_sigma);
  }
  const double reach = radius + kNegligibleSigmas * sigma;
  const double squared = (position_world - disc.mean_world[at]).squaredNorm();
  if (squared > reach * reach) return 0.0;
  const double z = (std::sqrt(squared) - radius) / sigma;
  return normal_tail(z) * disc.weight[at];
}

double SpaceTimeRisk::along(const std::array<Eigen::Vector2d, kMaxSteps + 1>& positions, int steps,
                            const Eigen::Vector2d& stop_world, double enough, int* worst) const {
  double sum = 0.0;
  double largest = 0.0;
  if (worst != nullptr) *worst = -1;
  for (int i = 0; i < disc_count_; ++i) {
    const PredictedDisc& disc = discs_[static_cast<std::size_t>(i)];
    double peak = chance(disc, steps, stop_world, 0.0);
    for (int k = 1; k <= steps; ++k) {
      if (disc.weight[static_cast<std::size_t>(k)] <= peak) continue;  // cannot exceed the peak
      const auto at = static_cast<std::size_t>(k);
      const double speed =
          disc.stands() ? (positions[at] - positions[at - 1]).norm() / parameters_.step : 0.0;
      peak = std::max(peak, chance(disc, k, positions[at], speed));
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
