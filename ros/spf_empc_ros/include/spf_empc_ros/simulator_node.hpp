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

#include <optional>
#include <string>
#include <vector>

#include "sim/world.hpp"
#include "spf_empc_ros/clock_edge.hpp"
#include "spf_empc_ros/simulated_bases.hpp"
#include "spf_empc_ros/simulator_config.hpp"
#include "spf_empc_ros/simulator_messages.hpp"

namespace spf_empc_ros {

/// Simulated time against the wall's: a tick that cannot begin in time shifts all that follow, instead of
/// having them catch up in a burst that no robot could keep up with.
class Pace {
 public:
  explicit Pace(double speed) : speed_{speed} {}

  void start(double time, double wall);
  /// When a simulated time [s] is to be reached on the wall's clock [s].
  [[nodiscard]] double due(double time) const { return wall_ + (time - time_) / speed_; }
  /// It was reached at `wall`; shifts what follows when that is late.
  void reached(double time, double wall);

  [[nodiscard]] long shifts() const { return shifts_; }
  [[nodiscard]] double lost() const { return lost_; }  ///< [s] on the wall, by all shifts

 private:
  static constexpr double kTolerated = 0.01;  // [s] that are made up for
  double speed_;
  double time_ = 0.0;  // [s] simulated
  double wall_ = 0.0;  // [s] then
  long shifts_ = 0;
  double lost_ = 0.0;
};

class SimulatorNode {
 public:
  /// `node` is in the fleet's namespace (usually the root). The simulated epoch is the whole second of
  /// `epoch`.
  SimulatorNode(ros::NodeHandle node, const SimulatorConfig& config, const ros::Time& epoch);

  /// Until the trial has ended (quit_when_done) or ROS shuts down. Returns the program's exit status: 0
  /// unless the trial failed, or was to end and did not.
  int run();

 private:
  struct Robot {
    ros::Publisher odom, scan, obstacles, goal;
    ros::Publisher cancel, pause, emergency_stop;  // where the scenario has a use for them
    ros::Subscriber command;
  };
  void connect(int robot);
  /// False when ROS shuts down before all are there.
  bool wait_for_robots();
  [[nodiscard]] std::string missing() const;
  void tick();
  void publish_clock();
  void publish_orders();
  void publish_poses();
  void publish_observations();
  void publish_pictures();
  void publish_outcome();
  void serve_until(double wall);
  void note_end();
  void print_summary() const;
  [[nodiscard]] bool dropped(FaultyTopic topic, int robot) const;
  [[nodiscard]] Stamp stamp() const { return {config_.frame, clock_.time(world_.time())}; }
  [[nodiscard]] int count() const { return static_cast<int>(robots_.size()); }

  ros::NodeHandle node_;
  SimulatorConfig config_;
  ClockEdge clock_;
  spf::sim::World world_;
  SimulatedBases bases_;
  Pace pace_;
  ros::CallbackQueue queue_;  // of the commands
  std::vector<Robot> robots_;
  ros::Publisher clock_publisher_, map_, markers_, outcome_;
  tf2_ros::TransformBroadcaster transforms_;
  spf::Observation observation_;  // kept for its memory
  std::optional<spf::sim::TrialResult> end_;
  double started_ = 0.0;         // [s] on the wall
  double next_transform_ = 0.0;  // [s]
  double next_outcome_ = 0.0;    // [s]
};

}  // namespace spf_empc_ros
