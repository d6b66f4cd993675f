#include "host/recovery.hpp"

namespace spf::host {
namespace {

constexpr int kReplanFirst = 1;  // failures after which it plans anew and no more
constexpr double kBackOffRadii = 2.0;
constexpr double kNearTolerances = 3.0;  // of the goal: before it counts itself arrived
constexpr double kBackOffSpeed = 0.2;    // [1] of max_speed: slower than this it is not waited for
constexpr double kBackOffSpare = 2.0;    // [s] to get going

}  // namespace

Recovery::Recovery(const AgentParameters& agent) : progress_{agent.robot} {
  reconfigure(agent);
}

void Recovery::reconfigure(const AgentParameters& agent) {
  distance_ = kBackOffRadii * agent.robot.radius;
  longest_time_ = distance_ / (kBackOffSpeed * agent.robot.max_speed) + kBackOffSpare;
  near_ = kNearTolerances * agent.team.goal_tolerance;
  progress_.reconfigure(agent.robot);
}

void Recovery::reset() {
  progress_.reset();
  pushes_in_vain_ = false;
  backed_off_in_vain_ = false;
  aside_.reset();
}

void Recovery::look(double now, const Localiser& localiser, const RobotAgent& agent, bool goes) {
  const bool pushed_in_vain = pushes_in_vain_;
  pushes_in_vain_ = localiser.motion().stuck(now);
  const AgentStatus status = agent.status();
  const bool moves = status.state == PeerState::moving && status.reason == StopCause::none;
  progress_.note(now, localiser.state().estimate.pose_world.position_world, goes && moves && !stuck(now));

  if (pushes_in_vain_ && !pushed_in_vain) backed_off_in_vain_ = aside_.has_value();
  if (aside_) {
    const bool there = (agent.committed().position(now) - *aside_).norm() < near_;
    if (there || stuck(now) || now > aside_until_) aside_.reset();
  }
  if (pushed_in_vain && !pushes_in_vain_ && goes) begin_to_back_off(now, localiser);
}

void Recovery::begin_to_back_off(double now, const Localiser& localiser) {
  const MotionMonitor& motion = localiser.motion();
  const double length = motion.displacement_in_vain().norm();
  if (motion.failures() <= kReplanFirst || backed_off_in_vain_ || length <= 0.0) return;
  aside_ = localiser.state().estimate.pose_world.position_world -
           distance_ / length * motion.displacement_in_vain();
  aside_until_ = now + longest_time_;
}

}  // namespace spf::host
