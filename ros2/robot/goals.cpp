#include "ros2/robot/goals.hpp"

#include <algorithm>
#include <cmath>
#include <ros2_messages/action_msgs/GoalStatus.hpp>
#include <ros2_messages/std_msgs/Empty.hpp>
#include <utility>

#include "config/parameter_text.hpp"

namespace spf_ros2 {
namespace {

using ros2::action_msgs::GoalStatus;
using ros2::geometry_msgs::PoseStamped;
using spf::host::GoalOutcome;
using spf::host::GoalSupervisor;

constexpr double kFeedbackPeriod = 0.2;  // [s]

}  // namespace

Goals::Goals(ros2::Node& node, const RobotConfig& config, spf::host::PlannerProcess& host,
             const Frames& frames, Refuse refuse)
    : node_{node},
      frame_{config.frame},
      host_{host},
      frames_{frames},
      refuse_{std::move(refuse)},
      patience_{config.file.host.goal_patience},
      supervisor_{config.agent, config.file.host} {
  for (const char* topic : {"goal", "goal_pose"})
    node.subscribe<PoseStamped>(topic, ros2::Qos::keep_last(5),
                                [this](const PoseStamped& pose) { pursue(pose, GoalSupervisor::kForEver); });
  node.subscribe<ros2::std_msgs::Empty>("cancel", ros2::Qos::keep_last(5), [this](const auto&) { cancel(); });
  server_ = make_navigate_server(
      node, config.distribution, [this](const PoseStamped& pose) { return pursue(pose, patience_); },
      [this] { cancel(); });
}

void Goals::reconfigure(const spf::AgentParameters& agent, const spf::host::HostParameters& host) {
  patience_ = host.goal_patience;
  supervisor_.reconfigure(agent, host);
}

bool Goals::pursue(const PoseStamped& pose, double patience) {
  PoseStamped framed = pose;
  if (framed.header.frame_id.empty()) framed.header.frame_id = frame_;
  const Converted<spf::Pose2> goal = frames_.pose(framed.header, framed.pose, frame_);
  if (!goal) host_.planner().count_refused_input();
  if (!goal || !host_.planner().set_goal({goal->position_world, goal->heading})) {
    refuse_("goal", goal ? "beyond all robots" : goal.refusal);
    return false;
  }
  take_away(GoalOutcome::preempted);
  supervisor_.begin(patience);
  begun_ = next_feedback_ = 1e-9 * static_cast<double>(node_.clock().now());
  return true;
}

/// Who sent it is told; the planner's goal is its caller's affair.
void Goals::take_away(GoalOutcome outcome) {
  supervisor_.end(outcome);
  const bool cancelled = outcome == GoalOutcome::cancelled;
  server_->end(cancelled ? GoalStatus::STATUS_CANCELED : GoalStatus::STATUS_ABORTED,
               cancelled ? to_string(outcome) : "a newer goal");
}

void Goals::cancel() {
  host_.planner().cancel();
  take_away(GoalOutcome::cancelled);
}

void Goals::step(double now) {
  if (supervisor_.outcome() != GoalOutcome::pursued) return;
  const spf::host::GoalFacts facts = goal_facts(host_.planner(), &host_.localiser(), now);
  if (supervisor_.step(facts, now) != GoalOutcome::pursued) return conclude();
  tell_feedback(facts.distance, now);
}

void Goals::conclude() {
  const GoalOutcome outcome = supervisor_.outcome();
  std::string text = to_string(outcome);
  if (outcome == GoalOutcome::no_path) text += " for " + spf::to_text(patience_) + " s";
  if (given_up(outcome)) {
    host_.planner().cancel();
    node_.log().warn("goal: " + text);  // the planner's diagnostics show it too, until the next goal
  }
  server_->end(given_up(outcome) ? GoalStatus::STATUS_ABORTED : GoalStatus::STATUS_SUCCEEDED, text);
}

void Goals::tell_feedback(double distance, double now) {
  const double time = 1e-9 * static_cast<double>(node_.clock().now());
  if (!server_->active() || !std::isfinite(distance) ||
      (time < next_feedback_ && next_feedback_ <= time + kFeedbackPeriod))
    return;
  next_feedback_ = time + kFeedbackPeriod;
  NavigateFeedback feedback;
  feedback.pose.header.stamp = node_.clock().stamp();
  feedback.pose.header.frame_id = frame_;
  spf::wire::fill(host_.localiser().belief().pose_world, feedback.pose.pose);
  feedback.time = std::max(0.0, time - begun_);
  feedback.distance = distance;
  if (const spf::RobotAgent* agent = host_.planner().agent())
    feedback.time_left = std::max(0.0, agent->committed().end_time() - now);
  server_->tell(feedback);
}

}  // namespace spf_ros2
