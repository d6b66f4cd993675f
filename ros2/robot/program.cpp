#include "ros2/robot/program.hpp"

#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <map>
#include <memory>
#include <stdexcept>

#include "parallel/worker_pool.hpp"
#include "ros2/node/node.hpp"
#include "ros2/robot/perception_node.hpp"
#include "ros2/robot/planner_node.hpp"
#include "ros2/robot/simulator_config.hpp"
#include "ros2/robot/simulator_node.hpp"
#include "ros2/robot/tracker_node.hpp"
#include "simulator/robot_file.hpp"

namespace spf_ros2 {
namespace {

constexpr const char* kUsage =
    "usage: spf-ros2 planner | tracker | perception | robot | simulator [--ros-args ...]\n"
    "  robot is planner, tracker and perception in one process. Parameters: robot_id, frame, base_frame, "
    "config, map;\n"
    "  namespace: -r __ns:=/robot0. simulator stands for the world of a fleet: parameter scenario.\n"
    "spf-ros2 robot-file SCENARIO [--robot NUMBER] [KEY=VALUE...]\n"
    "  prints the parameter file of a scenario's robots, for `config`.\n"
    "  Topics and parameters: docs/ros2.md.\n";

/// SIGINT and SIGTERM, taken by whoever waits for them.
class EndSignals {
 public:
  EndSignals() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  }
  void wait() const {
    int received = 0;
    sigwait(&signals_, &received);
  }
  /// Has one come that nobody has waited for yet?
  [[nodiscard]] bool pending() const {
    sigset_t waiting;
    sigemptyset(&waiting);
    sigpending(&waiting);
    return sigismember(&waiting, SIGINT) == 1 || sigismember(&waiting, SIGTERM) == 1;
  }
  static void send() { kill(getpid(), SIGTERM); }

 private:
  sigset_t signals_{};
};

/// A node with its thread's executor and what it does; destroyed in the reverse order.
class Part {
 public:
  Part(ros2::Context& context, const std::string& name)
      : executor_{context.participant}, node_{context, executor_, {name}}, config_{read_config(node_)} {}
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;
  virtual ~Part() = default;

  /// Waits for the first ROS time: with use_sim_time, for a clock. False when the program is to end.
  [[nodiscard]] bool await_clock(const EndSignals& signals) {
    if (node_.clock().now() == 0) node_.log().info("waiting for /clock");
    while (node_.clock().now() == 0 && !signals.pending()) executor_.spin_once();
    return node_.clock().now() != 0;
  }
  virtual void start() = 0;
  void spin(const ros2::StopSwitch& stop) { executor_.spin(stop); }
  [[nodiscard]] ros2::Log& log() { return node_.log(); }
  [[nodiscard]] std::vector<std::string> unknown_parameters() const {
    return node_.parameters().unknown_given();
  }

 protected:
  ros2::Executor executor_;
  ros2::Node node_;
  RobotConfig config_;
};

template <class Work>
class PartOf : public Part {
 public:
  using Part::Part;
  ~PartOf() override { work_.reset(); }
  void start() override { work_ = std::make_unique<Work>(node_, config_, node_.clock().now()); }

 private:
  std::unique_ptr<Work> work_;
};

std::vector<std::unique_ptr<Part>> parts_of(const std::string& role, ros2::Context& context) {
  std::vector<std::unique_ptr<Part>> parts;
  const bool all = role == "robot";
  if (all || role == "tracker") parts.push_back(std::make_unique<PartOf<TrackerNode>>(context, "tracker"));
  if (all || role == "planner") parts.push_back(std::make_unique<PartOf<PlannerNode>>(context, "planner"));
  if (all || role == "perception")
    parts.push_back(std::make_unique<PartOf<PerceptionNode>>(context, "perception"));
  return parts;
}

/// Parameters that were given and that no part has: misspelt ones, mostly.
void warn_of_unknown(const std::vector<std::unique_ptr<Part>>& parts) {
  std::map<std::string, std::size_t> unknown_to;
  for (const std::unique_ptr<Part>& part : parts)
    for (const std::string& name : part->unknown_parameters()) ++unknown_to[name];
  for (const auto& [name, count] : unknown_to)
    if (count == parts.size()) parts.front()->log().warn("there is no parameter '" + name + "'");
}

/// One thread that waits for the end, begun first, and one for each part.
void run_parts(const std::vector<std::unique_ptr<Part>>& parts, const EndSignals& signals,
               ros2::StopSwitch& stop) {
  spf::WorkerPool threads{static_cast<int>(parts.size()) + 1};
  threads.for_each(parts.size() + 1, [&](std::size_t i) {
    if (i == 0) {
      signals.wait();
      return stop.stop();
    }
    try {
      parts[i - 1]->spin(stop);
    } catch (...) {
      EndSignals::send();  // the others end too
      throw;
    }
  });
}

int run_role(const std::string& role, const ros2::Arguments& arguments) {
  const EndSignals signals;
  ros2::Context context{arguments, ros2::DomainOptions::from_environment()};
  ros2::StopSwitch stop{context.participant};
  const std::vector<std::unique_ptr<Part>> parts = parts_of(role, context);
  for (const std::unique_ptr<Part>& part : parts) {
    if (!part->await_clock(signals)) return 0;
    part->start();
  }
  warn_of_unknown(parts);
  try {
    run_parts(parts, signals, stop);
  } catch (const std::exception& error) {
    parts.front()->log()(ros2::LogLevel::fatal, error.what());
    return 1;
  }
  return 0;
}

/// The world of a fleet, on a thread of its own beside the one that waits for the end.
int run_simulator(const ros2::Arguments& arguments) {
  const EndSignals signals;
  ros2::Context context{arguments, ros2::DomainOptions::from_environment()};
  ros2::StopSwitch stop{context.participant};
  ros2::Executor executor{context.participant};
  ros2::Node node{context, executor, {"simulator"}};
  const spf::simulator::Settings settings = read_simulator_config(node);
  const std::string mcap = node.parameters().declare_as("mcap", std::string{},
                                                        {"file for a recording; none: empty", true, {}, {}});
  for (const std::string& name : node.parameters().unknown_given())
    node.log().warn("there is no parameter '" + name + "'");
  SimulatorNode simulator{node, executor, stop, settings, mcap};
  int status = 1;
  spf::WorkerPool threads{2};
  threads.for_each(2, [&](std::size_t i) {
    if (i == 0) {
      signals.wait();
      return stop.stop();
    }
    try {
      status = simulator.run();
    } catch (const std::exception& error) {
      node.log()(ros2::LogLevel::fatal, error.what());
    }
    EndSignals::send();
  });
  return status;
}

}  // namespace

int run_program(const std::vector<std::string>& arguments) {
  try {
    if (arguments.size() > 1 && arguments[1] == "robot-file")
      return spf::simulator::print_robot_file("spf-ros2 robot-file",
                                              {arguments.begin() + 2, arguments.end()});
    const ros2::Arguments given = ros2::Arguments::parse(arguments);
    const std::string role = given.others.size() == 2 ? given.others[1] : "";
    if (role == "-h" || role == "--help") {
      std::fputs(kUsage, stdout);
      return 0;
    }
    if (role == "simulator") return run_simulator(given);
    if (role != "planner" && role != "tracker" && role != "perception" && role != "robot") {
      std::fputs(kUsage, stderr);
      return 2;
    }
    return run_role(role, given);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "spf-ros2: %s\n", error.what());
    return 2;
  }
}

}  // namespace spf_ros2
