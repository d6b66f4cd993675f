// Pause and emergency stop, of one robot or (absolute topic) of the whole fleet: each is enough to stop, and
// a pause that was set by a parameter is one too.
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <std_msgs/Bool.h>

#include <functional>
#include <vector>

namespace spf_empc_ros {

class StopSwitch {
 public:
  /// `changed` is called with (paused, emergency stop).
  StopSwitch(ros::NodeHandle& node, std::function<void(bool, bool)> changed) : changed_{std::move(changed)} {
    listen(node, "pause", paused_);
    listen(node, "emergency_stop", robot_stop_);
    listen(node, "/emergency_stop", fleet_stop_);
  }
  StopSwitch(const StopSwitch&) = delete;
  StopSwitch& operator=(const StopSwitch&) = delete;

  void pause_by_parameter(bool paused) {
    paused_by_parameter_ = paused;
    tell();
  }

 private:
  void tell() { changed_(paused_ || paused_by_parameter_, robot_stop_ || fleet_stop_); }
  void listen(ros::NodeHandle& node, const char* topic, bool& value) {
    const boost::function<void(const std_msgs::Bool::ConstPtr&)> set =
        [this, &value](const std_msgs::Bool::ConstPtr& message) {
          value = message->data != 0;
          tell();
        };
    subscribers_.push_back(node.subscribe<std_msgs::Bool>(topic, 10, set));
  }

  std::function<void(bool, bool)> changed_;
  bool paused_ = false;
  bool paused_by_parameter_ = false;
  bool robot_stop_ = false;
  bool fleet_stop_ = false;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace spf_empc_ros
