// Parameters of the pose observer (eq. 17 and the filter that shares its model).
#pragma once

#include <array>
#include <utility>

#include "spf/math/parameters.hpp"

namespace spf {

enum class ObserverKind {
  none,    ///< the last measurement as it came (the ablation "without observer")
  eso,     ///< extended state observer with fixed poles (eq. 17)
  kalman,  ///< the same two-state model, gains from the noise levels
};

template <>
struct EnumNames<ObserverKind> {
  static constexpr std::array<std::pair<ObserverKind, const char*>, 3> values{
      {{ObserverKind::none, "none"}, {ObserverKind::eso, "eso"}, {ObserverKind::kalman, "kalman"}}};
};

struct ObserverParameters {
  ObserverKind kind = ObserverKind::kalman;
  double bandwidth = 0.5;          ///< [rad/s] eso: w of x and y, l1 = 2 w = 1, l2 = w^2 = 0.25 (paper)
  double heading_bandwidth = 0.5;  ///< [rad/s] eso: w of the heading (paper: the same)
  double pose_sigma = 0.0;         ///< [m] of a measurement, per axis; 0 = exact
  double heading_sigma = 0.0;      ///< [rad] of a measurement; 0 = exact
  double velocity_noise = 0.05;    ///< [m/sqrt(s)] wheel slip, white in the velocity
  double drift_noise = 0.02;       ///< [m/s/sqrt(s)] random walk of the disturbance velocity
  double max_disturbance = 0.5;    ///< [m/s] and [rad/s], bound of the estimated disturbance
  double gate_floor = 0.02;        ///< [m]
  double settling_time = 1.0;      ///< [s] in which they are, when they are a jump of at most largest_jump
  double largest_jump = 1.0;       ///< [m] a larger one is believed at once: the robot was carried away

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("kind", self.kind,
          "none | eso (eq. 17) | kalman (same model, gains from the noise levels; our default)");
    visit("bandwidth", self.bandwidth, "rad/s", Range{1e-3, 100.0},
          "eso: w of x and y; l1 = 2 w, l2 = w^2 (paper: 0.5)");
    visit("heading_bandwidth", self.heading_bandwidth, "rad/s", Range{1e-3, 100.0},
          "eso: w of the heading (paper: 0.5)");
    visit("pose_sigma", self.pose_sigma, "m", Range{0.0, 100.0},
          "standard deviation of a measured x or y; 0 = exact");
    visit("heading_sigma", self.heading_sigma, "rad", Range{0.0, 3.0},
          "standard deviation of a measured heading; 0 = exact");
    visit("velocity_noise", self.velocity_noise, ScaledUnit{"m/sqrt(s)", Scale::speed}, Range{0.0, 10.0},
          "white noise of the velocity (wheel slip); our choice");
    visit("drift_noise", self.drift_noise, ScaledUnit{"m/s/sqrt(s)", Scale::speed}, Range{0.0, 10.0},
          "random walk of the disturbance velocity; our choice");
    visit("max_disturbance", self.max_disturbance, kSpeedByRobot, Range{0.0, 100.0},
          "bound of the estimated disturbance velocity (and yaw rate in rad/s)");
    visit("settling_time", self.settling_time, "s", Range{0.0, 60.0},
          "time constant with which the estimate follows a measured pose that has jumped: a sensor jumps (at "
          "the seam of two cameras, say), a robot does not; 0 = at once");
  }

  /// No settings, but they follow the robot.
  template <class Self, class Visitor>
  static void visit_constants(Self& self, Visitor&& visit) {
    visit(self.gate_floor, Scale::size, Range{0.0, 100.0});
    visit(self.largest_jump, Scale::size, Range{0.0, 1000.0});
  }
};

}  // namespace spf
