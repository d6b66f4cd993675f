#include "spf/world/diffusion_estimator.hpp"

#include <algorithm>
#include <cmath>

namespace spf {
namespace {

constexpr double kPriorDuration = 4.0;  // [s] of data that the prior is worth at first
constexpr double kMemory = 20.0;        // [s] time constant of forgetting
constexpr double kPriorTime = 10.0;     // [s] of moving obstacles that the parameters are worth
constexpr double kMostTime = 60.0;      // [s] of moving obstacles that are remembered together
constexpr double kShortLag = 0.3;       // [s] of the second differences
constexpr double kLongLag = 1.0;        // [s]

// Squares of two axes against their expectation, so 1 on average: 3.5 and 7 sigma.
constexpr double kClip = 6.0;
constexpr double kInnovationGate = 25.0;

/// Part of the square that counts: none of an outlier, unless the previous square was an outlier too; then it
/// is no single event, but the expectation is too low.
double robust_part(double square, double expected, bool& outlier) {
  const double ratio = square / std::max(expected, 1e-12);
  const bool again = outlier;
  outlier = ratio > kInnovationGate;
  if (outlier) return again ? kInnovationGate / ratio : 0.0;
  return ratio > kClip ? kClip / ratio : 1.0;
}

}  // namespace

void DiffusionPopulation::learn(double dt, double velocity_diffusion, double position_diffusion) {
  if (!(dt > 0.0)) return;
  time_ = std::min(time_ + dt, kMostTime);
  const double part = std::min(dt / time_, 1.0);
  mean_.velocity += part * (velocity_diffusion / parameters_.prior_velocity_diffusion - mean_.velocity);
  mean_.position += part * (position_diffusion / parameters_.prior_position_diffusion - mean_.position);
}

void DiffusionPopulation::learn(double dt, const DiffusionEvidence& evidence) {
  if (!(dt > 0.0)) return;
  evidence_time_ += dt;
  if (evidence_time_ > kMostTime) {
    evidence_.scale(kMostTime / evidence_time_);
    evidence_time_ = kMostTime;
  }
  evidence_ += evidence;
}

DiffusionFactors DiffusionPopulation::prior() const {
  const double part = time_ / (time_ + kPriorTime);
  const DiffusionFactors reported{1.0 + part * (mean_.velocity - 1.0), 1.0 + part * (mean_.position - 1.0)};
  return evidence_time_ > 0.0 ? evidence_.solve(reported, kPriorTime) : reported;
}

void DiffusionEvidence::add(const Eigen::Vector2d& row, double value, double weight) {
  normal += weight * row * row.transpose();
  right += weight * value * row;
}

void DiffusionEvidence::scale(double kept) {
  normal *= kept;
  right *= kept;
}

DiffusionEvidence& DiffusionEvidence::operator+=(const DiffusionEvidence& other) {
  normal += other.normal;
  right += other.right;
  return *this;
}

DiffusionFactors DiffusionEvidence::solve(const DiffusionFactors& prior, double duration) const {
  const Eigen::Matrix2d all = normal + duration * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d wanted = right + duration * Eigen::Vector2d{prior.position, prior.velocity};
  const double determinant = all(0, 0) * all(1, 1) - all(0, 1) * all(1, 0);
  DiffusionFactors best;
  best.position = (wanted.x() * all(1, 1) - wanted.y() * all(0, 1)) / determinant;
  best.velocity = (wanted.y() * all(0, 0) - wanted.x() * all(1, 0)) / determinant;
  // When one of the two would be negative, it is set to zero and the other explains all.
  if (best.position < 0.0) return {std::max(wanted.y() / all(1, 1), 0.0), 0.0};
  if (best.velocity < 0.0) return {0.0, std::max(wanted.x() / all(0, 0), 0.0)};
  return best;
}

DiffusionEstimator::DiffusionEstimator(const DiffusionParameters& parameters, const DiffusionFactors& prior)
    : parameters_{validated(parameters)},
      prior_{prior},
      velocity_diffusion_{prior.velocity * parameters.prior_velocity_diffusion},
      position_diffusion_{prior.position * parameters.prior_position_diffusion} {}

const DiffusionEstimator::Sample& DiffusionEstimator::history(int age) const {
  return ring_[static_cast<std::size_t>((newest_ - age + kHistory) % kHistory)];
}

void DiffusionEstimator::keep(const Sample& sample) {
  newest_ = (newest_ + 1) % kHistory;
  ring_[static_cast<std::size_t>(newest_)] = sample;
  count_ = std::min(count_ + 1, kHistory);
}

void DiffusionEstimator::restart() {
  count_ = 0;
  velocity_step_.reset();
}

void DiffusionEstimator::forget(double dt) {
  const double kept = std::exp(-dt / kMemory);
  for (double* sum :
       {&increment_weight_, &velocity_square_, &velocity_lagged_, &position_weight_, &position_square_}) {
    *sum *= kept;
  }
  evidence_.scale(kept);
}

void DiffusionEstimator::update(double time, const Eigen::Vector2d& position, double position_sigma,
                                const Eigen::Vector2d& velocity) {
  const Sample now{time, position, velocity, position_sigma};
  if (count_ > 0 && time > history(0).time) {
    forget(time - history(0).time);
    learn_from_increment(history(0), now);
    solve();
  }
  keep(now);
}

void DiffusionEstimator::update(double time, const Eigen::Vector2d& position, double position_sigma) {
  const Sample now{time, position, Eigen::Vector2d::Zero(), position_sigma};
  new_evidence_ = {};
  if (count_ > 0 && time > history(0).time) {
    const double dt = time - history(0).time;
    mean_interval_ = mean_interval_ > 0.0 ? mean_interval_ + 0.1 * (dt - mean_interval_) : dt;
    forget(dt);
    learn_from_difference(now, kShortLag);
    learn_from_difference(now, kLongLag);
    evidence_ += new_evidence_;
    solve();
  }
  keep(now);
}

void DiffusionEstimator::learn_from_increment(const Sample& last, const Sample& now) {
  const double dt = now.time - last.time;
  mean_interval_ = mean_interval_ > 0.0 ? mean_interval_ + 0.1 * (dt - mean_interval_) : dt;
  const Eigen::Vector2d step = now.velocity - last.velocity;
  const double square = 0.5 * step.squaredNorm();
  const double part =
      robust_part(square, velocity_diffusion_ * dt + 2.0 * velocity_noise_, velocity_outlier_);
  if (part > 0.0) {
    increment_weight_ += dt;
    increment_time_ += dt;
    velocity_square_ += part * square;
    if (velocity_step_) velocity_lagged_ += part * 0.5 * step.dot(*velocity_step_);
    velocity_step_ = step;
  } else {
    velocity_step_.reset();
  }

  const Eigen::Vector2d left = now.position - last.position - 0.5 * dt * (now.velocity + last.velocity);
  const double noise = last.position_sigma * last.position_sigma + now.position_sigma * now.position_sigma +
                       0.5 * dt * dt * velocity_noise_;
  const double expected = position_diffusion_ * dt;
  const double left_part = robust_part(0.5 * left.squaredNorm(), expected + noise, position_outlier_);
  if (left_part <= 0.0) return;
  // The noisier a sample, the less it tells about the diffusion.
  const double trust = expected / (expected + noise);
  position_weight_ += trust * trust * dt;
  position_square_ += trust * trust * (left_part * 0.5 * left.squaredNorm() - noise);
}

const DiffusionEstimator::Sample* DiffusionEstimator::sample_near(double time) const {
  const Sample* best = nullptr;
  for (int age = 0; age < count_; ++age) {
    const Sample& sample = history(age);
    if (best && std::fabs(sample.time - time) >= std::fabs(best->time - time)) break;
    best = &sample;
  }
  return best;
}

void DiffusionEstimator::learn_from_difference(const Sample& now, double lag) {
  const Sample* middle = sample_near(now.time - lag);
  if (!middle) return;
  const double late = now.time - middle->time;
  const Sample* first = sample_near(middle->time - late);
  const double early = middle->time - first->time;
  const bool close_enough = late > 0.5 * lag && late < 1.5 * lag && early > 0.5 * late && early < 1.5 * late;
  if (!close_enough) return;
  const double ratio = late / early;
  const Eigen::Vector2d difference =
      now.position - middle->position - ratio * (middle->position - first->position);
  const double square = 0.5 * difference.squaredNorm();
  const double noise = now.position_sigma * now.position_sigma +
                       (1.0 + ratio) * (1.0 + ratio) * middle->position_sigma * middle->position_sigma +
                       ratio * ratio * first->position_sigma * first->position_sigma;
  const double per_position = late + ratio * ratio * early;
  const double per_velocity = (late * late * late + ratio * ratio * early * early * early) / 3.0;
  const double expected = position_diffusion_ * per_position + velocity_diffusion_ * per_velocity + noise;
  const double part = robust_part(square, expected, position_outlier_);
  if (part <= 0.0) return;
  // In units of the priors, weighted by the inverse variance of the square. Differences overlap: a new one
  // brings only the part of its span that is new.
  const Eigen::Vector2d row = Eigen::Vector2d{parameters_.prior_position_diffusion * per_position,
                                              parameters_.prior_velocity_diffusion * per_velocity} /
                              expected;
  const double weight = std::min(1.0, mean_interval_ / late) * late;
  new_evidence_.add(row, (part * square - noise) / expected, weight);
}

// Prior and data together. Increments of the velocity separate the two diffusions, so there the prior fades
// soon; for the least squares it stays, since noisy positions alone leave the split between the two open.
void DiffusionEstimator::solve() {
  double prior = kPriorDuration;
  double velocity_factor = 1.0;
  double position_factor = 1.0;
  if (increment_weight_ > 0.0) {
    constexpr double kLeast = 0.25;  // [s]
    prior = std::max(prior * std::exp(-increment_time_ / prior), std::min(prior, kLeast));
    const double total = prior + increment_weight_;
    const double square =
        (prior * prior_.velocity * parameters_.prior_velocity_diffusion + velocity_square_) / total;
    const double lagged = velocity_lagged_ / total;
    // Independent increments have a lagged mean of 0 and pure noise one of -1/2: in between it is noise only
    // when the cancelling is clear (3 standard deviations for 100 samples).
    constexpr double kClear = -0.2;
    const bool noisy = lagged < kClear * square;
    velocity_noise_ = noisy ? -lagged * mean_interval_ : 0.0;
    velocity_factor = (noisy ? square + 2.0 * lagged : square) / parameters_.prior_velocity_diffusion;
    position_factor = (prior * prior_.position + position_square_ / parameters_.prior_position_diffusion) /
                      (prior + position_weight_);
  } else {
    const DiffusionFactors best = evidence_.solve(prior_, prior);
    position_factor = best.position;
    velocity_factor = best.velocity;
  }
  const auto bounded = [this](double factor) {
    return std::clamp(factor, parameters_.lowest_factor, parameters_.highest_factor);
  };
  velocity_diffusion_ = parameters_.prior_velocity_diffusion * bounded(velocity_factor);
  position_diffusion_ = parameters_.prior_position_diffusion * bounded(position_factor);
}

}  // namespace spf
