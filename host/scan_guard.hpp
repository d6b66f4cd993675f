// The guard below everything: whatever plan, map and tracks say, a robot goes no faster than lets it stop
// before what its scanner shows in its way. Every command is held against the newest scan: the disc of the
// robot is swept along the arc that the command leads along, and the command is scaled down until reaction
// and braking fit into the distance that is free. What comes towards the robot is stopped for while it comes.
//
// Three zones of a collision monitor in one rule: `stops` within the margin, `slows` within what it takes to
// brake, and the approach by closing speed. Only what is in the way counts: a robot may pass a wall, go
// through a door that it fits, turn on the spot, and move away from what it touches.
//
// A return counts when one of its two neighbours has about its range, or something was there in the scan
// before. Returns nearer to the centre than GuardParameters::own_radius are parts of the robot; of one with
// corners those are that lie well within its outline, and its outline is swept instead of the disc around it,
// also where it turns on the spot. It knows no
// pose: between scans the robot moves as its wheels do. Frame: body (x forward, y left); times are the host's
// [s].
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "host/dead_reckoning.hpp"
#include "host/guard_parameters.hpp"
#include "host/step_clock.hpp"
#include "spf/robot/footprint.hpp"
#include "spf/team/agent_parameters.hpp"
#include "spf/world/observation.hpp"

namespace spf::host {

enum class GuardAction { none, slows, stops };
[[nodiscard]] const char* to_string(GuardAction action);

struct GuardVerdict {
  GuardAction action = GuardAction::none;
  double scale = 1.0;  ///< [1] of the command that is let through; when it stops, turning on the spot is too
  double free_distance =
      std::numeric_limits<double>::infinity();  ///< [m] as commanded, until the robot touches
  double closing_speed = 0.0;                   ///< [m/s] of what is there
  bool may_turn = true;                         ///< on the spot: corners meet nothing
};

struct GuardCounts {
  std::uint32_t stops = 0;  ///< those within a second of each other count once
  double held_time = 0.0;   ///< [s] in which it slowed or stopped
  std::uint32_t scans_refused = 0;
};

/// Never throws; allocates until its memory has grown to the scans that come.
class ScanGuard {
 public:
  /// Throws std::invalid_argument on parameters out of range. Stamps may be ahead of the clock by
  /// `clock_error` [s].
  ScanGuard(const GuardParameters& parameters, const AgentParameters& agent, double clock_error);

  /// Takes in a scan made at a time; false when it is refused: malformed, not newer than the last, too old,
  /// or from the future.
  bool add_scan(double time, const RangeScan& scan, const Pose2& sensor_in_body, double now);
  /// The body moves with this twist [m/s, m/s, rad/s] now. Call it before judge().
  void moves(double now, const Eigen::Vector3d& twist_body) { motion_.advance(now, twist_body); }
  /// How much of a commanded twist [m/s, m/s, rad/s] may be carried out until the next call.
  const GuardVerdict& judge(double now, const Eigen::Vector3d& twist_body);
  /// What the verdict makes of the twist.
  [[nodiscard]] Eigen::Vector3d allowed(const Eigen::Vector3d& twist_body) const;
  /// Nothing known can be dated any more.
  void forget();

  [[nodiscard]] const GuardVerdict& verdict() const { return verdict_; }
  [[nodiscard]] const GuardCounts& counts() const { return counts_; }
  [[nodiscard]] double scan_age(double now) const;  ///< [s] infinite without one
  /// Whether it sees: a scan young enough to judge by.
  [[nodiscard]] bool sees(double now) const { return scan_age(now) <= stale_time_; }

 private:
  /// What a scan showed, in the frame of the dead reckoning.
  struct Sweep {
    double time = kNever;                // [s]
    std::vector<Eigen::Vector2d> seen;   // [m]
    std::vector<Eigen::Vector2d> alone;  // [m] of one beam, not confirmed
  };
  static constexpr std::size_t kSweeps = 3;

  [[nodiscard]] const Sweep& sweep(std::size_t ago) const {
    return sweeps_[(newest_ + kSweeps - ago) % kSweeps];
  }
  Sweep& next_sweep();
  void collect(const RangeScan& scan, const Pose2& sensor_in_body, const Pose2& body, Sweep& into) const;
  void confirm(Sweep& sweep, const Sweep& before) const;
  /// Along which the robot goes, in the frame of the dead reckoning.
  struct Course {
    Eigen::Vector2d direction;  // unit vector
    double curvature;           // [1/m] positive to the left
  };
  [[nodiscard]] bool may_turn(double yaw_rate) const;
  [[nodiscard]] Course course_of(double now, const Eigen::Vector3d& twist_body);
  [[nodiscard]] Eigen::Vector2d setting_out(const Eigen::Vector2d& commanded) const;
  [[nodiscard]] double free_distance(const Sweep& sweep, const Course& course) const;
  [[nodiscard]] GuardVerdict look_along(const Course& course, bool stood) const;
  [[nodiscard]] double stopping_distance(double speed, double curvature, double closing) const;
  [[nodiscard]] double admissible_speed(double room, double speed, double curvature, double closing) const;
  [[nodiscard]] bool must_brake_first(const Eigen::Vector2d& command) const;
  void count(double now);

  GuardParameters parameters_;
  RobotParameters robot_;
  Footprint footprint_;
  double control_period_;  // [s]
  double reaction_time_;   // [s] from a return that is known to wheels that brake
  double stale_time_;      // [s]
  double clock_error_;     // [s]
  double reach_;           // [m] from the centre, beyond which nothing matters

  DeadReckoning motion_;
  std::array<Sweep, kSweeps> sweeps_;
  std::size_t newest_ = 0;
  double judged_time_ = kNever;     // [s]
  double last_direction_ = 0.0;     // [rad] of the last command in the body
  double veering_ = 0.0;            // [rad/s] smoothed rate of that
  double last_stop_time_ = kNever;  // [s]
  GuardVerdict verdict_;
  GuardCounts counts_;
};

}  // namespace spf::host
