// Stands for robots, sensors and surroundings: serves a sim::World over topics, and is the fleet's clock.
// Robots' nodes cannot tell it from hardware. Topics and parameters: docs/ros2.md.
#pragma once

#include <optional>
#include <ros2_messages/geometry_msgs/PoseStamped.hpp>
#include <ros2_messages/nav_msgs/OccupancyGrid.hpp>
#include <ros2_messages/nav_msgs/Odometry.hpp>
#include <ros2_messages/rosgraph_msgs/Clock.hpp>
#include <ros2_messages/sensor_msgs/LaserScan.hpp>
#include <ros2_messages/spf_empc_msgs/ObstacleTracks.hpp>
#include <ros2_messages/spf_empc_msgs/TrialOutcome.hpp>
#include <ros2_messages/std_msgs/Bool.hpp>
#include <ros2_messages/std_msgs/Empty.hpp>
#include <ros2_messages/tf2_msgs/TFMessage.hpp>
#include <ros2_messages/visualization_msgs/MarkerArray.hpp>
#include <string>
#include <vector>

#include "mcap/world_recorder.hpp"
#include "ros2/node/node.hpp"
#include "ros2/robot/clock_edge.hpp"
#include "simulator/server.hpp"
#include "simulator/world_messages.hpp"

namespace spf_ros2 {

class SimulatorNode : public spf::simulator::Outlet {
 public:
  /// `node` is in the fleet's namespace (usually the root); `executor` serves it until `stop`. What goes out,
  /// and what robots show of themselves, is recorded into `mcap`, a file; empty: nothing is. Throws
  /// std::exception when scenario or file are of no use.
  SimulatorNode(ros2::Node& node, ros2::Executor& executor, const ros2::StopSwitch& stop,
                const spf::simulator::Settings& settings, const std::string& mcap = "");
  SimulatorNode(const SimulatorNode&) = delete;
  SimulatorNode& operator=(const SimulatorNode&) = delete;

  /// Until the trial has ended (quit_when_done) or somebody stops it. Returns the program's exit status: 0
  /// unless the trial failed, or was to end and did not. Throws std::runtime_error when the recording could
  /// not be written.
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
  void begin(const spf::sim::World& world) override;
  void say(const std::string& text) override { node_.log().info(text); }

 private:
  struct Robot {
    ros2::Publisher<ros2::nav_msgs::Odometry> odom;
    ros2::Publisher<ros2::sensor_msgs::LaserScan> scan;
    ros2::Publisher<ros2::spf_empc_msgs::ObstacleTracks> obstacles;
    ros2::Publisher<ros2::geometry_msgs::PoseStamped> goal;
    ros2::Publisher<ros2::std_msgs::Empty> cancel;
    ros2::Publisher<ros2::std_msgs::Bool> pause, emergency_stop;
    const ros2::Reader* command = nullptr;
  };
  using Stamp = spf::simulator::Stamp<ros2::builtin_interfaces::Time>;
  void connect(int robot);
  void record(const std::string& mcap);
  /// Messages of a topic that somebody else publishes.
  template <class Message>
  void record_topic(const std::string& topic, const ros2::Qos& qos) {
    node_.subscribe<Message>(topic, qos, [this, topic](const Message& message) {
      recording_->add(topic, server_.world().time(), message);
    });
  }
  [[nodiscard]] const spf::simulator::Settings& settings() const { return server_.settings(); }
  [[nodiscard]] Stamp stamp() const { return {settings().frame, clock_.time(server_.world().time())}; }

  ros2::Node& node_;
  ros2::Executor& executor_;
  const ros2::StopSwitch& stop_;
  spf::simulator::Server server_;
  ClockEdge clock_;  // its epoch is the whole second of the start
  std::vector<Robot> robots_;
  ros2::Publisher<ros2::rosgraph_msgs::Clock> clock_publisher_;
  ros2::Publisher<ros2::nav_msgs::OccupancyGrid> map_;
  ros2::Publisher<ros2::tf2_msgs::TFMessage> transforms_;
  ros2::Publisher<ros2::visualization_msgs::MarkerArray> markers_;
  ros2::Publisher<ros2::spf_empc_msgs::TrialOutcome> outcome_;
  std::optional<spf::mcap::Recording> recording_;
  std::optional<spf::mcap::WorldRecorder> recorder_;
};

}  // namespace spf_ros2
