// The bases of simulated robots as their drivers see them: velocity or wheel commands come in when they like,
// wheel speeds go to the motors. A base whose commands stop does what a real one's watchdog does: it stops
// its wheels. Times are simulated seconds.
#pragma once

#include <Eigen/Core>

#include <utility>
#include <vector>

#include "spf/math/index.hpp"
#include "spf/robot/drive.hpp"

namespace spf::simulator {

/// How regularly a base was commanded.
struct CommandRecord {
  long count = 0;
  long late = 0;             ///< came more than 1.5 periods after the one before
  long refused = 0;          ///< not finite, or of the wrong size
  long cut = 0;              ///< beyond the wheels' limits
  double longest_gap = 0.0;  ///< [s]
};

class SimulatedBases {
 public:
  static constexpr double kWatchdog = 0.5;  ///< [s] without a command until the wheels are stopped

  /// `period` [s] is the one commands are expected at.
  SimulatedBases(const std::vector<spf::RobotParameters>& robots, double period);

  /// A velocity of the body (x, y, yaw rate) [m/s, m/s, rad/s]. One beyond the wheels' limits is slowed down
  /// as a whole, so that the robot goes where it was told to, only later.
  void command_twist(int robot, const Eigen::Vector3d& twist_body, double time);
  /// Rim speeds [m/s]; each motor clips its own.
  void command_wheels(int robot, const std::vector<double>& wheel_speeds, double time);

  /// What the motors are told at a time [m/s].
  [[nodiscard]] spf::DriveInput wheels(int robot, double time) const;
  [[nodiscard]] const CommandRecord& record(int robot) const { return bases_[spf::as_index(robot)].record; }

 private:
  struct Base {
    explicit Base(spf::Drive of) : drive{std::move(of)} {}
    spf::Drive drive;
    spf::DriveInput wheel_speeds;
    double time = 0.0;  // [s] of the last command
    bool commanded = false;
    CommandRecord record;
  };
  void take(Base& base, const spf::DriveInput& wheel_speeds, double time) const;

  double period_;  // [s]
  std::vector<Base> bases_;
};

}  // namespace spf::simulator
