#include "test/robot_world_test.hpp"

#include <arpa/inet.h>
#include <ros/master.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <thread>

namespace spf_empc_ros {
namespace {

/// One that nobody listens at now.
int free_port() {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  if (bind(listener, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
      getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error{"no port of this machine is free"};
  close(listener);
  return ntohs(address.sin_port);
}

/// A master for these tests alone, on the robots' simulated time, and the folder that logs go to.
class OwnMaster : public testing::Environment {
 public:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("spf_ros_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    const std::string port = std::to_string(free_port());
    setenv("ROS_MASTER_URI", ("http://localhost:" + port).c_str(), 1);
    setenv("ROS_HOSTNAME", "localhost", 1);
    unsetenv("ROS_IP");
    setenv("ROS_HOME", folder_.c_str(), 1);
    setenv("ROS_LOG_DIR", folder_.c_str(), 1);
    program_ = std::make_unique<Program>(std::vector<std::string>{"/usr/bin/rosmaster", "--core", "-p", port},
                                         std::vector<std::string>{});
    ros::init(ros::M_string{}, "world", ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
    for (int tenths = 0; !ros::master::check(); ++tenths) {
      ASSERT_LT(tenths, 200) << "the master does not answer";
      std::this_thread::sleep_for(std::chrono::milliseconds{100});
    }
    ros::start();  // by the wall's clock; those that join from now on follow /clock
    ros::param::set("/use_sim_time", true);
  }
  void TearDown() override {
    ros::shutdown();
    program_.reset();
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

 private:
  std::filesystem::path folder_;
  std::unique_ptr<Program> program_;
};

const testing::Environment* const own_master = testing::AddGlobalTestEnvironment(new OwnMaster);

}  // namespace

Program::Program(std::vector<std::string> arguments, const std::vector<std::string>& variables) {
  // Whatever ends this process ends it too.
  const std::vector<std::string> with_us{"/usr/bin/setpriv", "--pdeathsig", "KILL", "--"};
  arguments.insert(arguments.begin(), with_us.begin(), with_us.end());
  std::vector<char*> words, environment;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  for (const std::string& variable : variables) environment.push_back(const_cast<char*>(variable.data()));
  for (char** variable = environ; *variable != nullptr; ++variable) environment.push_back(*variable);
  environment.push_back(nullptr);
  EXPECT_EQ(posix_spawn(&id_, words[0], nullptr, nullptr, words.data(), environment.data()), 0) << words[0];
}

Program::~Program() {
  if (id_ != 0) kill();
}

void Program::kill() {
  ::kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
  id_ = 0;
}

}  // namespace spf_empc_ros
