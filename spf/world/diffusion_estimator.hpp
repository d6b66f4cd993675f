// Adaptive process noise of one moving obstacle, learnt from its motion: the diffusion of its position (white
// velocity noise) and of its velocity (a random walk). Both are needed to predict how uncertain its position
// will be in a second or two.
#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>

#include "spf/math/parameters.hpp"

namespace spf {

struct DiffusionParameters {
  double prior_velocity_diffusion =
      0.1;  ///< [(m/s)^2/s] 1e-2 (m/s)^2 every 0.1 s: noise level 1 Sigma, kept velocity
  double prior_position_diffusion =
      2e-3;                      ///< [m^2/s] 1e-2 * 0.1^2 + 1e-4 m^2 every 0.1 s: 1 Sigma, fresh velocity
  double lowest_factor = 0.02;   ///< [1] bounds of what is learnt, in priors
  double highest_factor = 20.0;  ///< [1]

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("prior_velocity_diffusion", self.prior_velocity_diffusion,
          ScaledUnit{"m^2/s^3", Scale::velocity_diffusion}, Range{1e-8, 100.0},
          "growth of an obstacle's velocity variance before anything is learnt (1 Sigma, walk)");
    visit("prior_position_diffusion", self.prior_position_diffusion,
          ScaledUnit{"m^2/s", Scale::position_diffusion}, Range{1e-9, 10.0},
          "growth of an obstacle's position variance before anything is learnt (1 Sigma, white)");
    visit("lowest_factor", self.lowest_factor, "1", Range{1e-6, 1.0},
          "lower bound of a learnt diffusion, in priors");
    visit("highest_factor", self.highest_factor, "1", Range{1.0, 1e6},
          "upper bound of a learnt diffusion, in priors");
  }
};

/// Factors of the priors [1].
struct DiffusionFactors {
  double velocity = 1.0;
  double position = 1.0;
};

/// Linear equations of the two factors, (position, velocity), weighted by seconds of data.
struct DiffusionEvidence {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();

  void add(const Eigen::Vector2d& row, double value, double weight);
  void scale(double kept);
  DiffusionEvidence& operator+=(const DiffusionEvidence& other);
  /// The factors that fit it and a prior of `duration` [s] best; none is negative.
  [[nodiscard]] DiffusionFactors solve(const DiffusionFactors& prior, double duration) const;
};

/// What obstacles of this scene are like: what fits all of those that moved. It is the prior of the next one,
/// which is seen for a few seconds only in a crowd. The priors of the parameters count as kPriorTime of it.
class DiffusionPopulation {
 public:
  explicit DiffusionPopulation(const DiffusionParameters& parameters = {}) : parameters_{parameters} {}

  /// Another `dt` [s] of a moving obstacle whose velocities are reported, and of which these diffusions are
  /// believed.
  void learn(double dt, double velocity_diffusion, double position_diffusion);
  /// Another `dt` [s] of one of which positions alone are known. Its evidence counts, not what it is believed
  /// to be, which is half its prior as long as it has been seen for a few seconds.
  void learn(double dt, const DiffusionEvidence& evidence);
  [[nodiscard]] DiffusionFactors prior() const;

 private:
  DiffusionParameters parameters_;
  double time_ = 0.0;  // [s]
  DiffusionFactors mean_;
  double evidence_time_ = 0.0;  // [s]
  DiffusionEvidence evidence_;
};

/// Learns from samples of one obstacle in the order of time, by what a sample holds:
///  - with velocity: from the increments of the velocity and what these leave of the position's increments.
///    Neighbouring increments that cancel out are noise of the reported velocity, not motion.
///  - without: from second differences of the position over 0.3 s and 1 s, whose variances mix both
///    diffusions differently:
///    Dp (t2 + r^2 t1) + Dv (t2^3 + r^2 t1^3) / 3 + (1 + (1 + r)^2 + r^2) sigma^2 with r = t2 / t1,
///    fitted by least squares.
/// Single outliers (a bounce off a wall) are clipped or left out, so that they do not raise the diffusion.
class DiffusionEstimator {
 public:
  explicit DiffusionEstimator(const DiffusionParameters& parameters = {}, const DiffusionFactors& prior = {});

  void update(double time, const Eigen::Vector2d& position, double position_sigma,
              const Eigen::Vector2d& velocity);
  void update(double time, const Eigen::Vector2d& position, double position_sigma);
  /// Starts a new motion (after a bounce): no differences are taken across it.
  void restart();

  [[nodiscard]] double velocity_diffusion() const { return velocity_diffusion_; }  ///< [(m/s)^2/s]
  [[nodiscard]] double position_diffusion() const { return position_diffusion_; }  ///< [m^2/s]
  [[nodiscard]] double velocity_noise() const {
    return velocity_noise_;
  }  ///< [(m/s)^2] of reported velocities
  /// What the last sample without velocity has told.
  [[nodiscard]] const DiffusionEvidence& new_evidence() const { return new_evidence_; }

 private:
  struct Sample {
    double time = 0.0;
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    double position_sigma = 0.0;
  };
  static constexpr int kHistory = 128;

  void forget(double dt);
  void learn_from_increment(const Sample& last, const Sample& now);
  void learn_from_difference(const Sample& now, double lag);
  void keep(const Sample& sample);
  void solve();
  [[nodiscard]] const Sample& history(int age) const;
  [[nodiscard]] const Sample* sample_near(double time) const;

  DiffusionParameters parameters_;
  DiffusionFactors prior_;
  double velocity_diffusion_;
  double position_diffusion_;
  double velocity_noise_ = 0.0;

  // Weighted sums; weights in seconds of data.
  double increment_time_ = 0.0;  // [s] observed so far, never forgotten
  double increment_weight_ = 0.0;
  double velocity_square_ = 0.0;  // of |dv|^2 / (2 dt)
  double velocity_lagged_ = 0.0;  // of dv . dv_before / (2 dt)
  double position_weight_ = 0.0;
  double position_square_ = 0.0;
  std::optional<Eigen::Vector2d> velocity_step_;  // [m/s] the previous increment
  bool velocity_outlier_ = false;                 // the previous sample was one
  bool position_outlier_ = false;
  double mean_interval_ = 0.0;      // [s]
  DiffusionEvidence evidence_;      // of samples without velocity
  DiffusionEvidence new_evidence_;  // of the last one

  std::array<Sample, kHistory> ring_;
  int newest_ = 0;
  int count_ = 0;
};

}  // namespace spf
