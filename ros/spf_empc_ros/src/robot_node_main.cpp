// robot_node: planner, tracker and perception of one robot in one process, each on a thread of its own, so
// that planning never holds up control. Only values pass between them, by the same topics as between
// processes.
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/spinner.h>

#include "spf_empc_ros/perception_node.hpp"
#include "spf_empc_ros/planner_node.hpp"
#include "spf_empc_ros/tracker_node.hpp"

namespace {

/// A node handle whose callbacks run on one thread of their own. Declared before the node that uses it.
class OwnThread {
 public:
  OwnThread() : spinner_{1, &queue_} { node_.setCallbackQueue(&queue_); }
  [[nodiscard]] ros::NodeHandle node() const { return node_; }
  void start() { spinner_.start(); }
  void stop() { spinner_.stop(); }

 private:
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::AsyncSpinner spinner_;
};

void run(const spf_empc_ros::RobotConfig& config) {
  const ros::Time start = spf_empc_ros::first_time();
  if (!ros::ok()) return;
  OwnThread control;
  OwnThread planning;
  OwnThread sensing;
  const spf_empc_ros::TrackerNode tracker{control.node(), config, start};
  const spf_empc_ros::PlannerNode planner{planning.node(), config, start};
  const spf_empc_ros::PerceptionNode perception{sensing.node(), config, start};
  for (OwnThread* thread : {&control, &planning, &sensing}) thread->start();
  ros::waitForShutdown();
  for (OwnThread* thread : {&control, &planning, &sensing}) thread->stop();
}

}  // namespace

int main(int argc, char** argv) {
  return spf_empc_ros::run_node(argc, argv, "robot", run);
}
