#include "host/motion_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/angles.hpp"

namespace spf::host {
namespace {

constexpr double kMovingShare = 0.7;   // [1] of what was told: as it should
constexpr double kStuckShare = 0.3;    // [1] of it: not at all
constexpr double kAwayRadii = 5.0;     // from where it last failed: farther than it backs off
constexpr int kQuarters = 4;           // of the window: a jump of the poses falls into two of them at most
constexpr int kStuckQuarters = 3;      // that show standing
constexpr double kQuarterStuck = 0.5;  // [1] of what was told in it
constexpr double kSteady = 0.1;        // [1] of the whole displacement is to be told in it
constexpr double kSigmas = 5.0;        // by which what is missing must exceed the noise
constexpr int kSlotsRemembered = 40;   // slots over which noise is averaged
constexpr double kLongestGap = 0.5;    // [s] between poses: beyond, nothing is known of the time between
constexpr double kLastSlot = 1e15;     // of any clock

}  // namespace

MotionMonitor::MotionMonitor(const RobotParameters& robot)
    : lever_{robot.radius},
      least_told_{std::min(robot.radius / 3.0, 0.3 * robot.max_speed * kWindow)},
      deceleration_{robot.max_acceleration},
      last_time_{kNever},
      noise_{NoiseMeter{kSlotsRemembered}, NoiseMeter{kSlotsRemembered}, NoiseMeter{kSlotsRemembered}} {}

std::size_t MotionMonitor::in_ring(long long slot) {
  return static_cast<std::size_t>((slot % kSlots + kSlots) % kSlots);
}

void MotionMonitor::reset() {
  slots_ = {};
  last_time_ = kNever;
  last_mean_ = {};
  for (NoiseMeter& meter : noise_) meter.reset();
  attempts_.reset();
  displacement_in_vain_.setZero();
}

void MotionMonitor::begin(double time, double heading) {
  slots_ = {};
  slot_ = static_cast<long long>(std::floor(time / kSlotLength));
  last_heading_ = heading;
  turned_ = 0.0;
  told_.setZero();
  last_mean_ = {};
}

void MotionMonitor::note(double time, const Pose2& pose_world, const Eigen::Vector3d& told_twist_world) {
  const double since = time - last_time_;
  if (!(since > 0.0) || !(std::abs(time / kSlotLength) < kLastSlot)) return;
  last_time_ = time;
  if (since > kLongestGap)
    begin(time, pose_world.heading);
  else
    told_ += since * told_twist_world.cwiseProduct(Displacement{1.0, 1.0, lever_});
  told_speed_ = told_twist_world.head<2>().norm();
  turned_ += angle_difference(pose_world.heading, last_heading_);
  last_heading_ = pose_world.heading;

  advance_to_slot(static_cast<long long>(std::floor(time / kSlotLength)));
  Slot& slot = slots_[in_ring(slot_)];
  slot.position +=
      Displacement{pose_world.position_world.x(), pose_world.position_world.y(), lever_ * turned_};
  slot.told += told_;
  ++slot.poses;
}

void MotionMonitor::advance_to_slot(long long slot) {
  if (slot <= slot_) return;
  learn_noise();
  judge();
  for (long long next = std::max(slot_ + 1, slot - kSlots + 1); next <= slot; ++next)
    slots_[in_ring(next)] = {};
  slot_ = slot;
}

/// Of a group of slots that ends so long before the newest full one.
MotionMonitor::Slot MotionMonitor::mean_of_group(long long slots_ago) const {
  Slot mean;
  for (long long i = 0; i < kGroup; ++i) {
    const Slot& slot = slots_[in_ring(slot_ - slots_ago - i)];
    mean.position += slot.position;
    mean.told += slot.told;
    mean.poses += slot.poses;
  }
  if (mean.poses == 0) return mean;
  mean.position /= mean.poses;
  mean.told /= mean.poses;
  return mean;
}

void MotionMonitor::learn_noise() {
  Slot mean = slots_[in_ring(slot_)];
  if (mean.poses == 0) return;
  mean.position /= mean.poses;
  mean.told /= mean.poses;
  if (last_mean_.poses > 0) {
    const Displacement innovation = (mean.position - last_mean_.position) - (mean.told - last_mean_.told);
    for (std::size_t i = 0; i < noise_.size(); ++i) noise_[i].note(innovation[static_cast<Eigen::Index>(i)]);
  }
  last_mean_ = mean;
}

void MotionMonitor::judge() {
  std::array<Slot, kQuarters + 1> at;  // the newest first
  for (std::size_t i = 0; i < at.size(); ++i) {
    at[i] = mean_of_group(kQuarter * static_cast<long long>(i));
    if (at[i].poses == 0) return;
  }
  const Displacement told = at.front().told - at.back().told;
  const double length = told.norm();
  if (length < least_told_) return;
  const double moved = (at.front().position - at.back().position).dot(told) / length;
  const Eigen::Vector2d here = at.front().position.head<2>();
  if (moved >= kMovingShare * length && (here - failed_at_world_).norm() >= kAwayRadii * lever_)
    attempts_.succeed();
  // Of the difference of two groups' means, over all axes.
  const double variance = noise_[0].variance() + noise_[1].variance() + noise_[2].variance();
  const double noise = std::sqrt(2.0 * variance / static_cast<double>(kGroup));
  if (moved >= kStuckShare * length || length - moved <= kSigmas * noise) return;

  int stuck_quarters = 0;
  for (std::size_t i = 0; i < kQuarters; ++i) {
    const double told_here = (at[i].told - at[i + 1].told).dot(told) / length;
    const double moved_here = (at[i].position - at[i + 1].position).dot(told) / length;
    if (told_here >= kSteady * length && moved_here < kQuarterStuck * told_here) ++stuck_quarters;
  }
  if (stuck_quarters < kStuckQuarters) return;
  attempts_.fail(last_time_, told_speed_ / deceleration_);
  failed_at_world_ = here;
  displacement_in_vain_ = told.head<2>();
  slots_ = {};  // the next attempt is judged by itself
}

}  // namespace spf::host
