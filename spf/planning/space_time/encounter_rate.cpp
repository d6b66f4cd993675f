#include "spf/planning/space_time/encounter_rate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "spf/math/angles.hpp"

namespace spf {
namespace {

constexpr double kLeastSeen = 0.1;  // [1] of the disc: among people who stand close it sees hardly farther
constexpr double kStood = 1.0;      // [s] at one position: it does not move
constexpr double kMostPerSecond = 1e3;

/// How far the robot sees, by direction.
class SeenDisc {
 public:
  explicit SeenDisc(double range) : range_{range} { by_sector_.fill(range); }

  void hide_behind(const Eigen::Vector2d& offset, double radius) {
    const double distance = std::max(offset.norm(), 1e-6);
    const double half_angle = std::asin(std::min(1.0, radius / distance));
    const double middle = std::atan2(offset.y(), offset.x());
    for (std::size_t i = 0; i < kSectors; ++i) {
      const double angle = 2.0 * kPi * (static_cast<double>(i) + 0.5) / kSectors;
      if (std::abs(angle_difference(angle, middle)) <= half_angle)
        by_sector_[i] = std::min(by_sector_[i], distance);
    }
  }

  [[nodiscard]] double area() const {
    double area = 0.0;
    for (const double sight : by_sector_) area += kPi / kSectors * sight * sight;
    return std::max(area, kLeastSeen * kPi * range_ * range_);
  }

 private:
  static constexpr std::size_t kSectors = 64;
  double range_;                              // [m]
  std::array<double, kSectors> by_sector_{};  // [m]
};

}  // namespace

EncounterRate::EncounterRate(double robot_radius, double max_speed, double range, double memory)
    : robot_radius_{robot_radius}, max_speed_{max_speed}, range_{range}, memory_{memory} {}

void EncounterRate::update(const PlanRequest& request) {
  const double elapsed = std::max(0.0, request.time - time_);
  time_ = request.time;
  SeenDisc seen{range_};
  double swept = 0.0;  // [m^2/s]
  if (request.world.tracks != nullptr) {
    for (const ObstacleTrack& track : *request.world.tracks) {
      const Eigen::Vector2d offset = track.state.position_world - request.head.position_world;
      if (track.stood > kStood || offset.norm() > range_) continue;
      swept += 2.0 * (robot_radius_ + track.state.radius) *
               std::hypot(max_speed_, track.state.velocity_world.norm());
      seen.hide_behind(offset, track.state.radius);
    }
  }
  const double now = std::min(kMostPerSecond, swept / seen.area());
  rate_ += (1.0 - std::exp(-elapsed / memory_)) * (now - rate_);
}

}  // namespace spf
