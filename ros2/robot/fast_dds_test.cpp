// Every topic of the nodes to a peer on Fast DDS and back: another implementation of DDS, on the same wire.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <ros2_messages/diagnostic_msgs/DiagnosticArray.hpp>
#include <ros2_messages/geometry_msgs/PoseStamped.hpp>
#include <ros2_messages/geometry_msgs/Twist.hpp>
#include <ros2_messages/geometry_msgs/TwistStamped.hpp>
#include <ros2_messages/nav2_msgs/SpeedLimit.hpp>
#include <ros2_messages/nav_msgs/OccupancyGrid.hpp>
#include <ros2_messages/nav_msgs/Odometry.hpp>
#include <ros2_messages/nav_msgs/Path.hpp>
#include <ros2_messages/rcl_interfaces/Log.hpp>
#include <ros2_messages/rcl_interfaces/ParameterEvent.hpp>
#include <ros2_messages/rosgraph_msgs/Clock.hpp>
#include <ros2_messages/sensor_msgs/LaserScan.hpp>
#include <ros2_messages/spf_empc_msgs/Observation.hpp>
#include <ros2_messages/spf_empc_msgs/ObstacleTracks.hpp>
#include <ros2_messages/spf_empc_msgs/RobotStatus.hpp>
#include <ros2_messages/spf_empc_msgs/TrackerStatus.hpp>
#include <ros2_messages/spf_empc_msgs/Trajectory.hpp>
#include <ros2_messages/spf_empc_msgs/TrialOutcome.hpp>
#include <ros2_messages/spf_empc_msgs/WheelSpeeds.hpp>
#include <ros2_messages/std_msgs/Bool.hpp>
#include <ros2_messages/std_msgs/Empty.hpp>
#include <ros2_messages/tf2_msgs/TFMessage.hpp>
#include <ros2_messages/visualization_msgs/MarkerArray.hpp>
#include <thread>

#include "ros2/robot/program_test.hpp"

namespace spf_ros2 {

[[nodiscard]] std::string fast_dds_program();

namespace {

/// Gives every field a value of its own, and every list three elements.
class Filler {
 public:
  template <class Value>
  void operator()(const char* /*name*/, Value& value) {
    fill(value);
  }
  template <class Value>
  void fill(Value& value) {
    if constexpr (std::is_same_v<Value, bool>)
      value = true;
    else if constexpr (std::is_arithmetic_v<Value>)
      value = static_cast<Value>(++count_ % 100);
    else
      Value::visit_fields(value, *this);
  }
  void fill(std::string& text) { text = "text " + std::to_string(++count_); }
  void fill(std::vector<bool>& values) { values.assign(3, true); }
  template <class Value>
  void fill(std::vector<Value>& values) {
    values.resize(3);
    for (Value& value : values) fill(value);
  }
  template <class Value, std::size_t N>
  void fill(std::array<Value, N>& values) {
    for (Value& value : values) fill(value);
  }

 private:
  int count_ = 0;
};

class Crossing {
 public:
  virtual ~Crossing() = default;
  virtual void send() const = 0;
  bool back = false;
};

template <class Message>
class CrossingOf : public Crossing {
 public:
  CrossingOf(ros2::Node& node, int number) {
    Filler{}.fill(message_);
    publisher_ = node.advertise<Message>("/to/t" + std::to_string(number));
    node.subscribe<Message>("/back/t" + std::to_string(number), ros2::Qos::keep_last(10),
                            [this](const Message& message) { back = back || message == message_; });
  }
  void send() const override {
    if (!back && publisher_.subscribers() > 0) publisher_.publish(message_);
  }

 private:
  Message message_;
  ros2::Publisher<Message> publisher_;
};

template <class... Messages>
struct All {
  static std::vector<std::string> types() { return {ros2::dds_type_name<Messages>()...}; }
  static std::vector<std::unique_ptr<Crossing>> crossings(ros2::Node& node) {
    std::vector<std::unique_ptr<Crossing>> all;
    (all.push_back(std::make_unique<CrossingOf<Messages>>(node, static_cast<int>(all.size()))), ...);
    return all;
  }
};

/// The peer, until the end of the test.
class FastDdsPeer {
 public:
  FastDdsPeer(int domain, const std::vector<std::string>& types) {
    std::vector<std::string> arguments{fast_dds_program(), std::to_string(domain)};
    arguments.insert(arguments.end(), types.begin(), types.end());
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    EXPECT_EQ(posix_spawn(&id_, words[0], nullptr, nullptr, words.data(), environ), 0);
  }
  ~FastDdsPeer() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  FastDdsPeer(const FastDdsPeer&) = delete;
  FastDdsPeer& operator=(const FastDdsPeer&) = delete;

 private:
  pid_t id_ = 0;
};

TEST(FastDds, GetsEveryTopicAndSendsItBack) {
  if (fast_dds_program().empty()) GTEST_SKIP() << "built without Fast DDS (Debian 12: libfastrtps-dev)";
  using namespace ros2;
  unsetenv("CYCLONEDDS_URI");  // a tag is CycloneDDS's own
  DomainOptions options;
  options.domain_id = 1 + getpid() % 90;
  options.localhost_only = true;
  using Topics = All<nav_msgs::Odometry, sensor_msgs::LaserScan, spf_empc_msgs::ObstacleTracks,
                     nav_msgs::OccupancyGrid, tf2_msgs::TFMessage, geometry_msgs::PoseStamped,
                     std_msgs::Empty, std_msgs::Bool, rosgraph_msgs::Clock, spf_empc_msgs::Trajectory,
                     spf_empc_msgs::Observation, geometry_msgs::Twist, geometry_msgs::TwistStamped,
                     spf_empc_msgs::WheelSpeeds, spf_empc_msgs::RobotStatus, spf_empc_msgs::TrackerStatus,
                     spf_empc_msgs::TrialOutcome, nav_msgs::Path, visualization_msgs::MarkerArray,
                     diagnostic_msgs::DiagnosticStatus, diagnostic_msgs::DiagnosticArray,
                     nav2_msgs::SpeedLimit, rcl_interfaces::Log, rcl_interfaces::ParameterEvent>;
  // The peer first: it is heard at once by whoever comes, and looks for those before it only now and then.
  const FastDdsPeer peer{options.domain_id, Topics::types()};
  std::this_thread::sleep_for(std::chrono::seconds{1});
  Process process{{}, options};
  Node node{process.context, process.executor, {"people"}};
  const auto all = Topics::crossings(node);
  // Until it has found all readers the peer may lose what it sends back: then it takes another.
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds{40};
  const auto done = [&] {
    return std::all_of(all.begin(), all.end(), [](const auto& crossing) { return crossing->back; });
  };
  while (!done() && std::chrono::steady_clock::now() < end) {
    for (const auto& crossing : all) crossing->send();
    (void)process.executor.spin_until(done, 0.2);
  }
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_TRUE(all[i]->back) << Topics::types()[i];
}

}  // namespace
}  // namespace spf_ros2
