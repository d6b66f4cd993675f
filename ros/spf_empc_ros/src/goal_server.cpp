#include "spf_empc_ros/goal_server.hpp"

#include <ros/console.h>

#include <utility>

#include "config/parameter_text.hpp"
#include "spf_empc_ros/conversions.hpp"

namespace spf_empc_ros {
namespace {

using spf::host::GoalOutcome;
using spf::host::GoalSupervisor;

const ros::Duration kFeedbackPeriod{0.2};

}  // namespace

void GoalServer::Server::resume(const RememberedGoal& remembered) {
  move_base_msgs::MoveBaseActionGoal goal;
  goal.goal_id = remembered.id;
  goal.header.stamp = remembered.id.stamp;
  started_ = true;  // so that it listens; nothing is published before start()
  goalCallback(boost::make_shared<const move_base_msgs::MoveBaseActionGoal>(goal));
  status_list_.back().status_.status = actionlib_msgs::GoalStatus::ACTIVE;
  started_ = false;
}

GoalServer::GoalServer(ros::NodeHandle node, const ros::NodeHandle& own, const RobotConfig& config,
                       spf::host::PlannerProcess& host, const Frames& frames, ParameterStore& store,
                       Refuse refuse)
    : frame_{config.frame},
      host_{host},
      frames_{frames},
      refuse_{std::move(refuse)},
      goal_timeout_{config.file.host.goal_patience},
      supervisor_{config.agent, config.file.host},
      memory_{own, store, config.frame, config.file.host.goal_memory},
      server_{node, "move_base", [this](Handle handle) { on_action_goal(std::move(handle)); },
              [this](Handle handle) { on_action_cancel(std::move(handle)); }, false} {
  take_up_what_was_left();
  server_.start();
  subscribers_ = {node.subscribe("goal", 5, &GoalServer::on_goal, this),
                  node.subscribe("cancel", 5, &GoalServer::on_cancel, this)};
}

void GoalServer::take_up_what_was_left() {
  resumed_ = memory_.left();
  if (!resumed_) return memory_.forget();
  ROS_INFO("taking up the goal (%.2f, %.2f) again", resumed_->goal.position_world.x(),
           resumed_->goal.position_world.y());
  if (resumed_->id.id.empty())
    pursue({resumed_->goal, {}}, std::nullopt);
  else
    server_.resume(*resumed_);
  resumed_.reset();
}

void GoalServer::reconfigure(const spf::AgentParameters& agent, const spf::host::HostParameters& host) {
  goal_timeout_ = host.goal_patience;
  supervisor_.reconfigure(agent, host);
}

// ---- in ---------------------------------------------------------------------------------------------------

Converted<spf::host::Goal> GoalServer::in_fleets_frame(const geometry_msgs::PoseStamped& pose) const {
  std_msgs::Header header = pose.header;
  if (header.frame_id.empty()) header.frame_id = frame_;
  const Converted<spf::Pose2> converted = frames_.pose(header, pose.pose, frame_);
  if (!converted) return Converted<spf::host::Goal>::refused(converted.refusal);
  return {spf::host::Goal{converted->position_world, converted->heading}, {}};
}

void GoalServer::on_action_goal(Handle handle) {
  if (resumed_) {
    pursue({resumed_->goal, {}}, handle);
    return;
  }
  const Converted<spf::host::Goal> goal = in_fleets_frame(handle.getGoal()->target_pose);
  if (!pursue(goal, handle))
    handle.setRejected({}, goal ? "beyond all robots" : goal.refusal);
  else
    handle.setAccepted();
}

void GoalServer::on_goal(const ros::MessageEvent<geometry_msgs::PoseStamped const>& event) {
  if (memory_.heard_before(*event.getConstMessage(), event.getPublisherName())) return;
  pursue(in_fleets_frame(*event.getConstMessage()), std::nullopt);
}

void GoalServer::on_action_cancel(Handle handle) {
  if (handle_ && *handle_ == handle) on_cancel(nullptr);
}

void GoalServer::on_cancel(const std_msgs::Empty::ConstPtr&) {
  host_.planner().cancel();
  take_away(GoalOutcome::cancelled);
  memory_.forget();
}

bool GoalServer::pursue(const Converted<spf::host::Goal>& goal, std::optional<Handle> handle) {
  if (!goal) host_.planner().count_refused_input();
  if (!goal || !host_.planner().set_goal(*goal)) {
    refuse_("goal", goal ? "beyond all robots" : goal.refusal);
    return false;
  }
  take_away(GoalOutcome::preempted);
  handle_ = std::move(handle);
  memory_.keep({*goal, handle_ ? handle_->getGoalID() : actionlib_msgs::GoalID{}});
  supervisor_.begin(handle_ ? goal_timeout_ : GoalSupervisor::kForEver);
  return true;
}

/// Who sent it is told; the planner's goal is its caller's affair.
void GoalServer::take_away(GoalOutcome outcome) {
  supervisor_.end(outcome);
  if (handle_) handle_->setCanceled({}, to_string(outcome));
  handle_.reset();
}

// ---- out --------------------------------------------------------------------------------------------------

void GoalServer::step(double now) {
  if (supervisor_.outcome() != GoalOutcome::pursued) return;
  const spf::host::GoalFacts facts = goal_facts(host_.planner(), &host_.localiser(), now);
  if (supervisor_.step(facts, now) != GoalOutcome::pursued) return conclude();
  memory_.refresh();
  tell_feedback(now);
}

void GoalServer::conclude() {
  const GoalOutcome outcome = supervisor_.outcome();
  std::string text = to_string(outcome);
  if (outcome == GoalOutcome::no_path) text += " for " + spf::to_text(goal_timeout_) + " s";
  if (given_up(outcome)) {
    host_.planner().cancel();
    ROS_WARN("goal: %s", text.c_str());  // the planner's diagnostics show it too, until the next goal
    if (handle_) handle_->setAborted({}, text);
  } else if (handle_) {
    handle_->setSucceeded({}, text);
  }
  handle_.reset();
  memory_.forget();
}

void GoalServer::tell_feedback(double now) {
  const ros::Time time = ros::Time::now();
  const bool due = time >= next_feedback_ || next_feedback_ > time + kFeedbackPeriod;  // or the clock jumped
  if (!handle_ || !due) return;
  const spf::StateEstimate here = host_.localiser().estimate(now);
  if (!here.valid) return;
  next_feedback_ = time + kFeedbackPeriod;
  move_base_msgs::MoveBaseFeedback feedback;
  feedback.base_position.header.stamp = time;
  feedback.base_position.header.frame_id = frame_;
  feedback.base_position.pose = to_message(here.pose_world);
  handle_->publishFeedback(feedback);
}

}  // namespace spf_empc_ros
