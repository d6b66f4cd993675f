// What a planner that was killed and started again must know of its goal: kept at the parameter server, and
// taken up again by a process that follows soon.
#pragma once

#include <actionlib_msgs/GoalID.h>
#include <geometry_msgs/PoseStamped.h>
#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <map>
#include <optional>
#include <string>

#include "host/planner_host.hpp"
#include "spf_empc_ros/parameter_store.hpp"

namespace spf_empc_ros {

struct RememberedGoal {
  spf::host::Goal goal;
  actionlib_msgs::GoalID id;  ///< of the action; empty when it came by topic
};

class GoalMemory {
 public:
  /// `frame` is the fleet's, in which goals are; `longest_absence` [s] that of HostParameters.
  GoalMemory(const ros::NodeHandle& own, ParameterStore& store, const std::string& frame,
             double longest_absence);

  /// The goal that the process before this one pursued, when that was alive a short while ago. Warns of one
  /// that is too old. Asked once, at the start.
  [[nodiscard]] std::optional<RememberedGoal> left() const;
  void keep(const RememberedGoal& remembered);
  void forget();
  /// Call it often while the goal is pursued: says that this process is alive.
  void refresh();

  /// Whether this message of the topic was heard by the process before this one: its publisher latches it,
  /// and it must not replace a newer goal, or one that was reached. Notes it.
  [[nodiscard]] bool heard_before(const geometry_msgs::PoseStamped& goal, const std::string& publisher);

 private:
  ParameterStore& store_;
  std::string frame_;
  double longest_absence_;                     // [s]
  XmlRpc::XmlRpcValue left_;                   // by the process before this one
  std::map<std::string, std::string> before_;  // by it of each publisher, until this one has heard of that
  std::map<std::string, std::string> heard_;   // by this one
  XmlRpc::XmlRpcValue kept_;                   // by this one; invalid: nothing
  ros::WallTime next_sign_of_life_;
};

}  // namespace spf_empc_ros
