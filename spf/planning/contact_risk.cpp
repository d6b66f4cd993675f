#include "spf/planning/contact_risk.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "spf/math/normal_distribution.hpp"
#include "spf/planning/moving_disc.hpp"

namespace spf {
namespace {

constexpr double kRiskStep = 0.1;  // [s]
constexpr std::size_t kRiskSteps = 30;
constexpr double kCertain = 5.0;         // [sigma] farther from contact than this is free of risk (3e-7)
constexpr double kExactPosition = 1e-6;  // [m] standard deviation of what is known exactly

/// The robot's positions at all steps.
struct Course {
  std::array<Eigen::Vector2d, kRiskSteps + 1> position_world;  // [m]
  double reach = 0.0;                                          // [m] of all of them from the first

  Course(const Trajectory& trajectory, double from) {
    MovingDisc robot;
    robot.trajectory = &trajectory;
    DiscCursor cursor{robot};
    for (std::size_t k = 0; k <= kRiskSteps; ++k) {
      cursor.move_to(from + static_cast<double>(k) * kRiskStep);
      position_world[k] = cursor.position();
      reach = std::max(reach, (position_world[k] - position_world[0]).norm());
    }
  }
};

/// Largest probability of overlap with a disc, whose centre is `contact` [m] away when the two touch;
/// sigma(k) [m] is the standard deviation at step k.
template <class Sigma>
double largest_overlap(const Course& course, const MovingDisc& disc, double from, const Sigma& sigma) {
  DiscCursor other{disc};
  double largest = 0.0;
  for (std::size_t k = 0; k <= kRiskSteps; ++k) {
    other.move_to(from + static_cast<double>(k) * kRiskStep);
    const double squared = (course.position_world[k] - other.position()).squaredNorm();
    const double deviation = std::max(sigma(k), kExactPosition);
    const double reach = disc.radius + kCertain * deviation;
    if (!(squared < reach * reach)) continue;
    largest = std::max(largest, overlap_probability(std::sqrt(squared), disc.radius, deviation));
  }
  return largest;
}

double risk_with(const ObstacleTrack& track, const Course& course, const PlanRequest& request,
                 double radius) {
  const double age = request.time - track.time;
  MovingDisc disc;
  disc.radius = radius + track.state.radius;
  disc.time = track.time;
  disc.position_world = track.state.position_world;
  disc.velocity_world = track.state.velocity_world;
  const double own_variance = request.position_sigma * request.position_sigma;
  const auto sigma = [&](std::size_t k) {
    const double of_track = track.position_sigma(age + static_cast<double>(k) * kRiskStep);
    return std::sqrt(of_track * of_track + own_variance);
  };
  // The variance is convex in time, so its largest value is at an end.
  const Eigen::Vector2d now = disc.position_world + age * disc.velocity_world;
  const double gap = (course.position_world[0] - now).norm();
  const double largest_sigma = std::max(sigma(0), sigma(kRiskSteps));
  if (gap > disc.radius + course.reach + kRiskHorizon * disc.velocity_world.norm() + kCertain * largest_sigma)
    return 0.0;
  return largest_overlap(course, disc, request.time, sigma);
}

double risk_with(const Peer& peer, const Course& course, const PlanRequest& request, double radius) {
  if (peer.trajectory->empty() || yields(peer, request.world)) return 0.0;
  MovingDisc disc;
  disc.radius = radius + peer.radius + (peer.expired ? peer.growth : 0.0);
  disc.trajectory = &*peer.trajectory;
  const double deviation = std::hypot(peer.position_sigma, request.position_sigma);
  return largest_overlap(course, disc, request.time, [deviation](std::size_t) { return deviation; });
}

}  // namespace

double overlap_probability(double distance, double radius, double sigma) {
  return normal_tail((distance - radius) / sigma) * normal_within(radius / sigma);
}

double contact_risk(const Trajectory& trajectory, const PlanRequest& request, double radius) {
  const Course course{trajectory, request.time};
  double none = 1.0;  // probability of no contact
  if (request.world.tracks != nullptr)
    for (const ObstacleTrack& track : *request.world.tracks)
      none *= 1.0 - risk_with(track, course, request, radius);
  if (request.world.peers != nullptr)
    for (const Peer& peer : *request.world.peers) none *= 1.0 - risk_with(peer, course, request, radius);
  return 1.0 - none;
}

void set_risk(const PlanRequest& request, double radius, PlanResult& result) {
  if (!usable(request)) return;
  result.risk = contact_risk(result.trajectory, request, radius);
  for (Candidate& candidate : result.candidates)
    candidate.risk = contact_risk(candidate.trajectory, request, radius);
}

}  // namespace spf
