// Pause and emergency stop, of one robot or (absolute topic) of the whole fleet: each is enough to stop, and
// a pause that was set by a parameter is one too.
#pragma once

#include <functional>
#include <ros2_messages/std_msgs/Bool.hpp>
#include <utility>

#include "ros2/node/node.hpp"

namespace spf_ros2 {

class BrakeSwitches {
 public:
  /// `changed` is called with (paused, emergency stop).
  BrakeSwitches(ros2::Node& node, std::function<void(bool, bool)> changed) : changed_{std::move(changed)} {
    listen(node, "pause", paused_);
    listen(node, "emergency_stop", robot_stop_);
    listen(node, "/emergency_stop", fleet_stop_);
  }
  BrakeSwitches(const BrakeSwitches&) = delete;
  BrakeSwitches& operator=(const BrakeSwitches&) = delete;

  void pause_by_parameter(bool paused) {
    paused_by_parameter_ = paused;
    tell();
  }

 private:
  void tell() { changed_(paused_ || paused_by_parameter_, robot_stop_ || fleet_stop_); }
  void listen(ros2::Node& node, const char* topic, bool& value) {
    node.subscribe_to_state<ros2::std_msgs::Bool>(topic, [this, &value](const ros2::std_msgs::Bool& message) {
      value = message.data;
      tell();
    });
  }

  std::function<void(bool, bool)> changed_;
  bool paused_ = false;
  bool paused_by_parameter_ = false;
  bool robot_stop_ = false;
  bool fleet_stop_ = false;
};

}  // namespace spf_ros2
