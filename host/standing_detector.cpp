#include "host/standing_detector.hpp"

#include <algorithm>

namespace spf::host {
namespace {

constexpr double kLookBack = 0.3;          // [s] of poses by which a robot is seen to stand
constexpr double kStandingSpeed = 0.1;     // [1] of max_speed
constexpr std::size_t kMostRecent = 4096;  // poses of the look back, at 10 kHz and more
constexpr double kSpare = 1.0;             // [s] beyond braking, after which it is taken to stand

Eigen::Vector2d mean_position(const std::vector<PoseMeasurement>& poses, std::size_t from, std::size_t to) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = from; i < to; ++i) sum += poses[i].pose_world.position_world;
  return sum / static_cast<double>(to - from);
}

}  // namespace

StandingDetector::StandingDetector(const HostParameters& host, const RobotParameters& robot)
    : stopping_time_{host.plan_silence + robot.max_speed / robot.max_acceleration + kSpare},
      standing_speed_{kStandingSpeed * robot.max_speed} {}

void StandingDetector::add(const PoseMeasurement& pose) {
  if (!first_time_) first_time_ = pose.time;
  if (recent_.size() >= kMostRecent) recent_.erase(recent_.begin());
  recent_.push_back(pose);
  const auto old = [&](const PoseMeasurement& past) { return past.time < pose.time - kLookBack; };
  recent_.erase(recent_.begin(), std::find_if_not(recent_.begin(), recent_.end(), old));
}

void StandingDetector::forget() {
  recent_.clear();
  first_time_.reset();
}

bool StandingDetector::stands(double now) const {
  if (!first_time_) return false;
  if (now - *first_time_ > stopping_time_) return true;
  const std::size_t count = recent_.size();
  const double span = count < 2 ? 0.0 : recent_.back().time - recent_.front().time;
  if (span < 0.9 * kLookBack || count < 4) return false;
  const Eigen::Vector2d moved =
      mean_position(recent_, count / 2, count) - mean_position(recent_, 0, count / 2);
  return moved.norm() < standing_speed_ * 0.5 * span;
}

}  // namespace spf::host
