// What the robot tells about itself: its status for the host, and the messages to its peers.
#pragma once

#include <cstdint>
#include <optional>

#include "spf/team/agent_parameters.hpp"
#include "spf/team/agent_status.hpp"
#include "spf/trajectory/trajectory.hpp"
#include "spf/world/trajectory_message.hpp"

namespace spf {

/// What the status follows from.
struct Situation {
  const Trajectory& committed;
  bool braking = false;                            ///< it is a braking one
  std::optional<Eigen::Vector2d> goal_world = {};  ///< [m]
  StopCause stop = StopCause::none;                ///< reason to stop that no plan can mend
  StandCause cause{StopCause::planner_failed};     ///< why it would stand without such a reason
};

class Announcement {
 public:
  Announcement(int robot_id, const AgentParameters& parameters, double time);

  /// Another goal tolerance and priority and other limits from now on.
  void reconfigure(const AgentParameters& parameters);

  /// How the robot stands at a time [s].
  void update(double time, const Situation& situation);
  [[nodiscard]] const AgentStatus& status() const { return status_; }

  /// The message that is due at a time [s]: after every new trajectory or state, and again before the last
  /// one is message_period old. `next_time` [s] is when this is asked again, `position_sigma` [m] how far the
  /// robot may be from its trajectory; `claim` to a narrow passage, whose changes are told at once, too.
  [[nodiscard]] std::optional<TrajectoryMessage> message(double time, double next_time,
                                                         const Trajectory& committed, double position_sigma,
                                                         const std::optional<PassageClaim>& claim = {});

 private:
  int robot_id_;
  RobotParameters robot_;
  int priority_;
  double goal_tolerance_;    // [m]
  double message_period_;    // [s]
  double message_lifetime_;  // [s]
  AgentStatus status_;
  double last_motion_time_;        // [s]
  double next_message_time_;       // [s]
  double last_start_time_ = -1.0;  // [s] of the trajectory in the last message
  PeerState last_state_ = PeerState::stopped;
  std::optional<PassageClaim> last_claim_;
  std::uint32_t sequence_ = 0;
};

}  // namespace spf
