// The program spf-ros2 as a process of its own, over loopback.
#pragma once

#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "ros2/node/bench_test.hpp"

namespace spf_ros2 {

[[nodiscard]] std::string program_path();

class Program {
 public:
  /// In the tests' domain.
  explicit Program(std::vector<std::string> arguments) {
    const ros2::DomainOptions options = ros2::test_domain();
    setenv("ROS_DOMAIN_ID", std::to_string(options.domain_id).c_str(), 1);
    setenv("ROS_LOCALHOST_ONLY", "1", 1);
    arguments.insert(arguments.begin(), program_path());
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    EXPECT_EQ(posix_spawn(&id_, words[0], nullptr, nullptr, words.data(), environ), 0);
  }
  ~Program() {
    if (id_ != 0) (void)end(SIGKILL);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Ends it by a signal (0: it ends by itself); its exit status, or -1 when it ended by a signal.
  int end(int signal) {
    if (signal != 0) kill(id_, signal);
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t id_ = 0;
};

}  // namespace spf_ros2
