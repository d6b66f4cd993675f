// Two processes' worth of a graph in one, over loopback alone.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "ros2/node/node.hpp"

namespace ros2 {

inline constexpr double kPatience = 10.0;  // [s] for what takes milliseconds on an idle machine

/// While it lives, settings of CycloneDDS for what is started, beside those of the tests.
class MoreSettings {
 public:
  explicit MoreSettings(const std::string& settings) { value() = "," + settings; }
  ~MoreSettings() { value().clear(); }
  MoreSettings(const MoreSettings&) = delete;
  MoreSettings& operator=(const MoreSettings&) = delete;
  static std::string& value() {
    static std::string settings;
    return settings;
  }
};

/// A domain that no robot uses, with a tag by which tests that run at the same time do not hear each other.
inline DomainOptions test_domain() {
  const std::string tag = "spf_test_" + std::to_string(getpid());
  const std::string settings = "<CycloneDDS><Domain><Discovery><Tag>" + tag +
                               "</Tag></Discovery></Domain></CycloneDDS>" + MoreSettings::value();
  setenv("CYCLONEDDS_URI", settings.c_str(), 1);
  DomainOptions options;
  options.domain_id = 211;
  options.localhost_only = true;
  return options;
}

/// One participant with its thread of execution.
struct Process {
  explicit Process(const std::vector<std::string>& arguments = {},
                   const DomainOptions& options = test_domain())
      : context{Arguments::parse(arguments), options}, executor{context.participant} {}
  Context context;
  Executor executor;
};

/// Lets all go on until `done`.
template <class Done>
[[nodiscard]] bool run_until(const std::vector<Process*>& processes, Done done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>{kPatience};
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    for (Process* process : processes) process->executor.spin_once(0.001);
  }
  return true;
}

}  // namespace ros2
