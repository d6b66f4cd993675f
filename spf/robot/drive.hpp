// The drive of a ground robot as a value: what its wheels can do, whatever their number and kind. A closed
// set: omni wheels (three or more, at any angles), four mecanum wheels, a differential drive, a car.
// Everything else asks it. Frames: world; body (x ahead). A twist is (x, y, yaw rate) [m/s, m/s, rad/s].
#pragma once

#include <Eigen/Core>

#include <array>
#include <utility>
#include <vector>

#include "spf/math/parameters.hpp"

namespace spf {

enum class DriveType { omni, mecanum, differential, car };

template <>
struct EnumNames<DriveType> {
  static constexpr std::array<std::pair<DriveType, const char*>, 4> values{
      {{DriveType::omni, "omni"},
       {DriveType::mecanum, "mecanum"},
       {DriveType::differential, "differential"},
       {DriveType::car, "car"}}};
};

inline constexpr int kMaxDriveInputs = 8;

/// What is commanded: rim speeds [m/s] of the wheels, in the order of DriveDesign; of a car the rim speed of
/// its rear axle [m/s] and the steering angle [rad], positive to the left. Never allocates.
using DriveInput = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxDriveInputs, 1>;
/// Of a twist by the inputs.
using DriveJacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxDriveInputs>;

/// Geometry and limits of a drive.
struct DriveDesign {
  DriveType type = DriveType::omni;
  /// [rad] of the axles of omni wheels in the body, at least three that do not all lie along one line. Other
  /// drives ignore it.
  std::vector<double> wheel_angles{0.0, 2.0943951023931953, 4.1887902047863905};
  /// [m] omni: centre to wheel contact; differential: half the distance of the wheels; mecanum: half of
  /// length plus width between the wheels' contacts.
  double wheel_arm = 0.2;
  double max_wheel_speed = 1.5;  ///< [m/s] rim speed, in both directions
  double wheel_base = 0.4;  ///< [m] of a car, between the axles; its centre is the middle of the rear axle
  double min_turning_radius = 0.6;  ///< [m] of a car's centre, by the stop of its steering
  bool may_reverse = true;          ///< of a car
};

/// Immutable. Queries never allocate and never throw.
class Drive {
 public:
  /// Throws std::invalid_argument on a design that cannot move as its type does.
  explicit Drive(const DriveDesign& design);

  [[nodiscard]] DriveType type() const { return type_; }
  [[nodiscard]] int inputs() const { return static_cast<int>(upper_.size()); }
  /// May move along and turn about every axis at once.
  [[nodiscard]] bool holonomic() const { return type_ == DriveType::omni || type_ == DriveType::mecanum; }
  [[nodiscard]] bool turns_on_the_spot() const { return type_ != DriveType::car; }
  [[nodiscard]] bool may_reverse() const { return lower_[0] < 0.0; }
  /// [m] 0 where it turns on the spot.
  [[nodiscard]] double min_turning_radius() const { return min_turning_radius_; }

  /// The motion that inputs cause, without wheel slip; of too many rim speeds for three freedoms the
  /// least-squares one.
  [[nodiscard]] Eigen::Vector3d twist_body(const DriveInput& input) const;
  [[nodiscard]] Eigen::Vector3d twist_world(const DriveInput& input, double heading) const;
  /// Of twist_body() at an input; constant but for a car.
  [[nodiscard]] DriveJacobian jacobian(const DriveInput& input) const;
  /// Inputs for a motion of the body, perhaps beyond the limits. What the drive cannot do is left out:
  /// sideways motion of differential drives and cars, turning on the spot of cars, which keep the
  /// `steering_angle` [rad] they have when they stand.
  [[nodiscard]] DriveInput input_for(const Eigen::Vector3d& twist_body, double steering_angle = 0.0) const;
  /// All zero; a car steers straight ahead.
  [[nodiscard]] DriveInput standstill() const { return DriveInput::Zero(inputs()); }

  [[nodiscard]] const DriveInput& lower() const { return lower_; }  ///< limits of the inputs
  [[nodiscard]] const DriveInput& upper() const { return upper_; }
  /// The inputs themselves when within the limits. Else rim speeds are scaled down together, so that the path
  /// is kept; a steering angle is clipped. Anything not finite stops the robot.
  [[nodiscard]] DriveInput saturated(const DriveInput& input) const;
  /// The largest factor by which the motion may be sped up within the limits: below 1 when they are exceeded,
  /// infinite at standstill.
  [[nodiscard]] double scale_to_limit(const DriveInput& input) const;
  /// The nearest motion that the drive can do, apart from its limits of speed: no sideways motion, no tighter
  /// turn.
  [[nodiscard]] Eigen::Vector3d possible(const Eigen::Vector3d& twist_body) const;

  /// Rows: rim speeds by the motion of the body. Empty for a car.
  [[nodiscard]] const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, kMaxDriveInputs, 3>&
  wheel_from_body() const {
    return wheel_from_body_;
  }

 private:
  void set_wheels(const DriveDesign& design);

  DriveType type_;
  double wheel_base_;          // [m]
  double min_turning_radius_;  // [m]
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, kMaxDriveInputs, 3> wheel_from_body_;
  DriveJacobian body_from_wheel_;
  DriveInput lower_, upper_;
};

}  // namespace spf
