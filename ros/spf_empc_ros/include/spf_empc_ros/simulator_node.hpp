// Stands for robots, sensors and surroundings: serves a sim::World over topics, and is the fleet's clock.
// Robots' nodes cannot tell it from hardware. Topics and parameters: docs/ros.md.
#pragma once

#include <geometry_msgs/Twist.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <spf_empc_msgs/WheelSpeeds.h>
#include <tf2_ros/transform_broadcaster.h>

#include <string>
#include <vector>

#include "simulator/server.hpp"
#include "spf_empc_ros/clock_edge.hpp"
#include "spf_empc_ros/simulator_config.hpp"
#include "spf_empc_ros/simulator_messages.hpp"

namespace spf_empc_ros {

class SimulatorNode : public spf::simulator::Outlet {
 public:
  /// `node` is in the fleet's namespace (usually the root). The simulated epoch is the whole second of
  /// `epoch`.
  SimulatorNode(ros::NodeHandle node, const spf::simulator::Settings& settings, const ros::Time& epoch);

  /// Until the trial has ended (quit_when_done) or ROS shuts down. Returns the program's exit status: 0
  /// unless the trial failed, or was to end and did not.
  int run();

  void clock(const spf::sim::World& world) override;
  void goal(const spf::sim::World& world, int robot, const spf::host::Goal& goal,
            double any_heading) override;
  void order(const spf::sim::World& world, const spf::sim::FleetOrder& order) override;
  void pose(const spf::sim::World& world, int robot, const spf::Pose2& measured) override;
  void truth(const spf::sim::World& world) override;
  void obstacles(const spf::sim::World& world, int robot,
                 const std::vector<spf::Detection>& detections) override;
  void scan(const spf::sim::World& world, int robot, const spf::RangeScan& scan) override;
  void scene(const spf::sim::World& world) override;
  void outcome(const spf::sim::World& world, const spf::sim::TrialResult& result, bool finished) override;
  [[nodiscard]] double wall() const override;
  bool serve_until(double wall) override;
  [[nodiscard]] bool is_there(int robot) const override;
  void say(const std::string& text) override;

 private:
  struct Robot {
    ros::Publisher odom, scan, obstacles, goal;
    ros::Publisher cancel, pause, emergency_stop;  // where the scenario has a use for them
    ros::Subscriber command;
  };
  void connect(int robot);
  void listen(int robot, const std::string& name);
  [[nodiscard]] const spf::simulator::Settings& settings() const { return server_.settings(); }
  [[nodiscard]] Stamp stamp() const { return {settings().frame, clock_.time(server_.world().time())}; }

  ros::NodeHandle node_;
  spf::simulator::Server server_;
  ClockEdge clock_;
  ros::CallbackQueue queue_;  // of the commands
  std::vector<Robot> robots_;
  ros::Publisher clock_publisher_, map_, markers_, outcome_;
  tf2_ros::TransformBroadcaster transforms_;
};

}  // namespace spf_empc_ros
