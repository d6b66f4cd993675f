#include "ros2/robot/goals.hpp"

#include <ros2_messages/std_msgs/Empty.hpp>
#include <utility>

namespace spf_ros2 {

using ros2::geometry_msgs::PoseStamped;
using spf::host::GoalOutcome;
using spf::host::GoalSupervisor;

Goals::Goals(ros2::Node& node, const RobotConfig& config, spf::host::PlannerProcess& host,
             const Frames& frames, Refuse refuse)
    : node_{node},
      frame_{config.frame},
      host_{host},
      frames_{frames},
      refuse_{std::move(refuse)},
      supervisor_{config.agent, config.file.host} {
  for (const char* topic : {"goal", "goal_pose"})
    node.subscribe<PoseStamped>(topic, ros2::Qos::keep_last(5),
                                [this](const PoseStamped& pose) { on_goal(pose); });
  node.subscribe<ros2::std_msgs::Empty>("cancel", ros2::Qos::keep_last(5),
                                        [this](const auto&) { on_cancel(); });
}

void Goals::on_goal(const PoseStamped& pose) {
  PoseStamped framed = pose;
  if (framed.header.frame_id.empty()) framed.header.frame_id = frame_;
  const Converted<spf::Pose2> goal = frames_.pose(framed.header, framed.pose, frame_);
  if (!goal) host_.planner().count_refused_input();
  if (!goal || !host_.planner().set_goal({goal->position_world, goal->heading}))
    return refuse_("goal", goal ? "beyond all robots" : goal.refusal);
  supervisor_.end(GoalOutcome::preempted);
  supervisor_.begin(GoalSupervisor::kForEver);
}

void Goals::on_cancel() {
  host_.planner().cancel();
  supervisor_.end(GoalOutcome::cancelled);
}

void Goals::step(double now) {
  if (supervisor_.outcome() != GoalOutcome::pursued) return;
  const spf::host::GoalFacts facts = goal_facts(host_.planner(), &host_.localiser(), now);
  const GoalOutcome outcome = supervisor_.step(facts, now);
  if (!given_up(outcome)) return;
  host_.planner().cancel();
  node_.log().warn(std::string{"goal: "} +
                   to_string(outcome));  // the diagnostics show it too, until the next goal
}

}  // namespace spf_ros2
