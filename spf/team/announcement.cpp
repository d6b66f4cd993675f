#include "spf/team/announcement.hpp"

#include "spf/team/schedule.hpp"

namespace spf {
namespace {

constexpr double kStandingSpeed = 0.05;  // [1] of max_speed: slower is standing
constexpr double kStandingTime = 0.5;    // [s]
constexpr double kArrivedSpeed = 0.1;    // [1] of max_speed

/// Whether peers would decide otherwise.
bool differ(const std::optional<PassageClaim>& one, const std::optional<PassageClaim>& other) {
  if (!one || !other) return one.has_value() != other.has_value();
  return one->inside != other->inside || one->waits != other->waits || one->since != other->since;
}

}  // namespace

Announcement::Announcement(int robot_id, const AgentParameters& parameters, double time)
    : robot_id_{robot_id},
      robot_{parameters.robot},
      priority_{parameters.team.priority},
      goal_tolerance_{parameters.team.goal_tolerance},
      message_period_{parameters.team.message_period},
      message_lifetime_{parameters.team.message_lifetime},
      last_motion_time_{time},
      next_message_time_{time} {}

void Announcement::reconfigure(const AgentParameters& parameters) {
  robot_ = parameters.robot;
  priority_ = parameters.team.priority;
  goal_tolerance_ = parameters.team.goal_tolerance;
}

void Announcement::update(double time, const Situation& situation) {
  const FlatState now = situation.committed.state(time);
  const double speed = now.velocity_world.norm();
  const double soon = situation.committed.state(time + 0.5).velocity_world.norm();
  const double standing_speed = kStandingSpeed * robot_.max_speed;
  // A robot that means to go soon, and still means to half a second later, stands.
  if (speed >= standing_speed) last_motion_time_ = time;
  const bool stands =
      speed < standing_speed && (soon < standing_speed || time - last_motion_time_ > kStandingTime);
  status_ = {};
  if (situation.goal_world && (now.position_world - *situation.goal_world).norm() < goal_tolerance_ &&
      speed < kArrivedSpeed * robot_.max_speed) {
    status_.state = PeerState::arrived;
    status_.reason = stands ? StopCause::arrived : StopCause::none;
    return;
  }
  status_.reason = situation.stop;
  if (!stands) {
    status_.state = situation.braking ? PeerState::braking : PeerState::moving;
    return;
  }
  status_.state = PeerState::stopped;
  if (situation.stop != StopCause::none) return;
  status_.reason = situation.cause.reason;
  status_.blocking_id = situation.cause.blocking_id;
}

std::optional<TrajectoryMessage> Announcement::message(double time, double next_time,
                                                       const Trajectory& committed, double position_sigma,
                                                       const std::optional<PassageClaim>& claim) {
  const bool changed = committed.start_time() != last_start_time_ || status_.state != last_state_ ||
                       differ(claim, last_claim_);
  const bool due = next_time > next_message_time_ + kTimeTolerance;  // the next chance would be too late
  if (!changed && !due) return std::nullopt;
  next_message_time_ = time + message_period_;
  last_start_time_ = committed.start_time();
  last_state_ = status_.state;
  last_claim_ = claim;
  TrajectoryMessage message;
  message.robot_id = robot_id_;
  message.priority = priority_;
  message.sequence = ++sequence_;
  message.sent_time = time;
  message.expiry_time = time + message_lifetime_;
  message.radius = robot_.radius;
  message.position_sigma = position_sigma;
  message.state = status_.state;
  message.claim = claim;
  message.trajectory = committed;
  return message;
}

}  // namespace spf
