#include "spf/perception/scan_track.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "spf/math/plane.hpp"

namespace spf {
namespace {

constexpr double kInnovationGate = 9.2;  // [1] chi-square, 2 degrees, 0.99
constexpr double kFaceSlideSigma = 0.2;  // [m/s]
constexpr double kFullEvidence = 3;      // returns that count as full evidence

/// A face of which more becomes visible seems to move along itself. Its velocity along the face is held near
/// 0 by a pseudo-measurement.
void hold_along_face(ScanTrack& track) {
  Eigen::Vector4d along = Eigen::Vector4d::Zero();
  along.tail<2>() = left_of(track.behind);
  const Eigen::Vector4d gain =
      track.covariance * along / (along.dot(track.covariance * along) + kFaceSlideSigma * kFaceSlideSigma);
  track.state -= along.dot(track.state) * gain;
  const Eigen::Matrix4d corrected = track.covariance - gain * along.transpose() * track.covariance;
  track.covariance = 0.5 * (corrected + corrected.transpose());
}

}  // namespace

void ScanTrack::Evidence::add(double time, int returns, double free_share) {
  const double weight = std::min(returns / kFullEvidence, 1.0);
  sweeps += weight;
  free_sweeps += weight * free_share;
  misses = 0;
  last_seen = time;
}

ScanTrack born_track(int id, const ScanDetection& detection, const PerceptionParameters& parameters) {
  ScanTrack track;
  track.id = id;
  track.time = track.birth.time = detection.time;
  track.state << detection.position_world, Eigen::Vector2d::Zero();
  track.covariance.topLeftCorner<2, 2>() = detection.covariance;
  const double speed = parameters.initial_speed;
  track.covariance.bottomRightCorner<2, 2>() = speed * speed * Eigen::Matrix2d::Identity();
  track.birth.position_world = track.measured_world = detection.position_world;
  track.birth.covariance = detection.covariance;
  track.measured_sigma = std::sqrt(0.5 * detection.covariance.trace());
  track.radius = detection.radius;
  track.depth = track.birth.depth = detection.depth;
  track.behind = detection.behind;
  track.isolated = detection.isolated();
  track.radius_variance = detection.radius_variance;
  track.face = detection.kind == ScanDetection::Kind::face;
  track.evidence.add(detection.time, detection.returns, detection.free_share);
  return track;
}

void predict(ScanTrack& track, double time, const PerceptionParameters& parameters) {
  const double dt = time - track.time;
  if (!(dt > 0.0)) return;
  const double q = parameters.velocity_diffusion;
  if (track.dynamic || track.sight == ScanTrack::Sight::seen) track.state.head<2>() += dt * track.velocity();
  const Eigen::Matrix2d cross = track.covariance.topRightCorner<2, 2>();
  const Eigen::Matrix2d velocity = track.covariance.bottomRightCorner<2, 2>();
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  track.covariance.topLeftCorner<2, 2>() +=
      dt * (cross + cross.transpose()) + dt * dt * velocity + q * dt * dt * dt / 3.0 * one;
  track.covariance.topRightCorner<2, 2>() += dt * velocity + 0.5 * q * dt * dt * one;
  track.covariance.bottomLeftCorner<2, 2>() = track.covariance.topRightCorner<2, 2>().transpose();
  track.covariance.bottomRightCorner<2, 2>() += q * dt * one;
  track.time = time;
}

double Innovation::squared_mahalanobis() const {
  return difference.dot(covariance.inverse() * difference);
}

Eigen::Vector2d measured_position(const ScanTrack& track, const ScanDetection& detection) {
  if (!track.face && detection.kind != ScanDetection::Kind::face) return detection.position_world;
  return detection.position_world + (track.depth - detection.depth) * detection.behind;
}

Innovation innovation_of(const ScanTrack& track, const ScanDetection& detection) {
  const double late = detection.time - track.time;
  return {measured_position(track, detection) - track.position() - late * track.velocity(),
          track.position_covariance() + detection.covariance};
}

void correct(ScanTrack& track, const ScanDetection& detection, const PerceptionParameters& parameters) {
  if (track.face && detection.kind != ScanDetection::Kind::face) {
    // It turns out to be compact.
    track.state.head<2>() += (detection.depth - track.depth) * detection.behind;
    track.face = false;
    track.depth = detection.depth;
  }
  if (detection.kind == ScanDetection::Kind::disc) track.depth = detection.depth;
  Innovation innovation = innovation_of(track, detection);
  const double dt = std::max(detection.time - track.evidence.last_seen, 0.0);
  if (innovation.squared_mahalanobis() > kInnovationGate) {
    const double v = parameters.sudden_speed * parameters.sudden_speed;
    const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
    track.covariance.topLeftCorner<2, 2>() += v * dt * dt * one;
    track.covariance.topRightCorner<2, 2>() += v * dt * one;
    track.covariance.bottomLeftCorner<2, 2>() += v * dt * one;
    track.covariance.bottomRightCorner<2, 2>() += v * one;
    innovation = innovation_of(track, detection);
  }
  const Eigen::Matrix<double, 4, 2> gain = track.covariance.leftCols<2>() * innovation.covariance.inverse();
  track.state += gain * innovation.difference;
  // Joseph form; made symmetric, since an antisymmetric part would grow from sweep to sweep.
  Eigen::Matrix4d kept = Eigen::Matrix4d::Identity();
  kept.leftCols<2>() -= gain;
  const Eigen::Matrix4d corrected =
      kept * track.covariance * kept.transpose() + gain * detection.covariance * gain.transpose();
  track.covariance = 0.5 * (corrected + corrected.transpose());
  track.measured_world =
      measured_position(track, detection) - (detection.time - track.time) * track.velocity();
  track.measured_sigma = std::sqrt(0.5 * detection.covariance.trace());
  track.behind = detection.behind;
  if (track.face) hold_along_face(track);
  track.isolated = detection.isolated();
  track.evidence.add(detection.time, detection.returns, detection.free_share);
  track.sight = ScanTrack::Sight::seen;
}

}  // namespace spf
