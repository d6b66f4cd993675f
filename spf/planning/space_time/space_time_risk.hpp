// Space-time field: the probability that the robot, at a position and a time, overlaps a moving obstacle or a
// peer, whose mean moves and whose uncertainty grows with time. Our extension of eq. 1-4
// (docs/space_time.md). Frame: world.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "spf/planning/planner.hpp"
#include "spf/planning/space_time/space_time_parameters.hpp"

namespace spf {

/// How much the risk of tracks that move counts.
struct MovingRisk {
  double weight = 1.0;          ///< [1]
  double discount_share = 1.0;  ///< [1] of discount_time
};

/// Obstacles and peers of one planning call, tabulated over the horizon.
class SpaceTimeRisk {
 public:
  static constexpr int kMaxSteps = 30;
  static constexpr int kMaxDiscs = 48;
  static constexpr double kLowerPriorityWeight =
      0.3;  ///< [1] of the risk with peers that yield to this robot

  /// One obstacle or peer: its predicted position at each step.
  struct PredictedDisc {
    int id = -1;
    bool is_peer = false;
    double factor = 1.0;                                    ///< [1] of `weight`, by rank or crowd
    double radius = 0.0;                                    ///< [m] both radii and the margin
    std::array<Eigen::Vector2d, kMaxSteps + 1> mean_world;  ///< [m]
    std::array<double, kMaxSteps + 1> sigma;                ///< [m]
    std::array<double, kMaxSteps + 1> weight;               ///< erf(R / (sigma sqrt 2)) * discount * weight
    /// Of something that stands, [m] added to the radius for a robot at full speed: a slow one may go nearer.
    double speed_margin = 0.0;
    double speed_sigma = 0.0;  ///< [m] likewise of sigma; 0 for what moves

    [[nodiscard]] bool stands() const { return speed_sigma > 0.0; }
  };

  SpaceTimeRisk(const SpaceTimeParameters& parameters, double robot_radius, double max_speed);

  /// Tabulates every obstacle and peer that can come near within the horizon (the nearest kMaxDiscs of
  /// them). Allocates only when there are more of them than ever before.
  void prepare(const PlanRequest& request, const MovingRisk& moving = {});

  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] double step() const { return parameters_.step; }  ///< [s]
  [[nodiscard]] int disc_count() const { return disc_count_; }
  [[nodiscard]] const PredictedDisc& disc(int index) const { return discs_[static_cast<std::size_t>(index)]; }

  /// Discounted and weighted probability of contact at one step with one disc, in [0, 1], at a speed [m/s].
  [[nodiscard]] double chance(const PredictedDisc& disc, int step, const Eigen::Vector2d& position_world,
                              double speed) const;

  /// Sum over discs of the largest discounted probability along positions[1..steps] and at stop_world, where
  /// the robot would come to rest if it braked at the end, at the last step's time; returns early once the
  /// sum exceeds `enough`. `worst` receives the index of the disc that contributes most, -1 for none.
  [[nodiscard]] double along(const std::array<Eigen::Vector2d, kMaxSteps + 1>& positions, int steps,
                             const Eigen::Vector2d& stop_world, double enough, int* worst = nullptr) const;

 private:
  void add_track(const PlanRequest& request, const ObstacleTrack& track, double moving_weight);
  void add_peer(const PlanRequest& request, const Peer& peer);
  /// What stands is two things: something that will stay, which is passed like a wall, and something that may
  /// start, the less likely the longer it has stood.
  void add_standing(int id, bool is_peer, const Eigen::Vector2d& position_world, double radius, double margin,
                    double sigma, double own_sigma);
  void weigh_start(PredictedDisc& disc, double stood) const;
  void watch_goal(const PlanRequest& request);
  [[nodiscard]] PredictedDisc* next_disc();
  void finish(PredictedDisc& disc, double own_sigma);

  SpaceTimeParameters parameters_;
  double robot_radius_;
  double max_speed_;
  int steps_;
  std::array<double, kMaxSteps + 1> discount_;
  std::array<double, kMaxSteps + 1> peer_discount_;
  std::vector<PredictedDisc> discs_;  // the first disc_count_ are valid; kept for their memory of 1.3 KB each
  std::vector<std::pair<double, int>> order_;
  int disc_count_ = 0;
  bool at_goal_ = false;
  bool near_goal_ = false;
  Eigen::Vector2d goal_ = Eigen::Vector2d::Zero();  // [m]
};

}  // namespace spf
