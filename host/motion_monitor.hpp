// Whether the robot moves as its wheels are told: what its poses show over the last second against what was
// applied. One that is held, wedged or has lost its grip is stuck: it must not go on pushing. After a while
// it may try again; each attempt that fails doubles that while. It sees measured poses rather than estimates,
// which follow the wheels where poses are doubted, and learns for itself how noisy they are. Frame: world.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>

#include "host/attempts.hpp"
#include "spf/localisation/noise_meter.hpp"
#include "spf/math/pose2.hpp"
#include "spf/robot/robot_parameters.hpp"

namespace spf::host {

/// Never throws or allocates.
class MotionMonitor {
 public:
  explicit MotionMonitor(const RobotParameters& robot);

  /// A measured pose that is believed, and the motion [m/s, m/s, rad/s] that the wheels were told since the
  /// one before. Times [s] that do not grow are ignored.
  void note(double time, const Pose2& pose_world, const Eigen::Vector3d& told_twist_world);
  /// Nothing before counts: the robot was relocalised, or the clock has jumped.
  void reset();

  /// From the moment it is found stuck until it may try again.
  [[nodiscard]] bool stuck(double now) const { return attempts_.waiting(now); }
  /// How many attempts in a row have failed, until it has driven well away from there.
  [[nodiscard]] int failures() const { return attempts_.failures(); }
  /// The displacement [m, m] that it was last told to drive in vain, within a window; zero before and after
  /// mere turning.
  [[nodiscard]] const Eigen::Vector2d& displacement_in_vain() const { return displacement_in_vain_; }

  static constexpr double kWindow = 1.0;  ///< [s]

 private:
  // Turning counts by how far it moves a point on the robot's edge.
  using Displacement = Eigen::Vector3d;  // [m]
  /// Sums over the poses of a short time, or their means.
  struct Slot {
    Displacement position = Displacement::Zero();
    Displacement told = Displacement::Zero();
    int poses = 0;
  };
  static constexpr double kSlotLength = 0.05;  // [s]
  static constexpr long long kGroup = 4;       // slots whose mean is compared with that of others
  static constexpr long long kQuarter = 5;     // slots from one group to the next: a quarter of the window
  static constexpr long long kSlots = 4 * kQuarter + kGroup;

  [[nodiscard]] static std::size_t in_ring(long long slot);
  void begin(double time, double heading);
  void advance_to_slot(long long slot);
  void learn_noise();
  void judge();
  [[nodiscard]] Slot mean_of_group(long long slots_ago) const;

  double lever_;         // [m] from turning to displacement
  double least_told_;    // [m] in a window: less says nothing
  double deceleration_;  // [m/s^2]

  std::array<Slot, static_cast<std::size_t>(kSlots)> slots_;  // a ring, up to the one that is being filled
  long long slot_ = 0;                                        // that one
  double last_time_;                                          // [s]
  double last_heading_ = 0.0;                                 // [rad]
  double turned_ = 0.0;                                       // [rad] since the beginning
  Displacement told_ = Displacement::Zero();                  // likewise
  double told_speed_ = 0.0;                                   // [m/s] lately

  Slot last_mean_;                   // of the last slot with poses
  std::array<NoiseMeter, 3> noise_;  // of a slot's mean, per axis

  Attempts attempts_;
  Eigen::Vector2d failed_at_world_ = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d displacement_in_vain_ = Eigen::Vector2d::Zero();
};

}  // namespace spf::host
