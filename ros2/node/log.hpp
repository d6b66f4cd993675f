// What a node says: on standard error, and on /rosout.
#pragma once

#include <memory>
#include <string>

#include "ros2/node/arguments.hpp"
#include "ros2/node/participant.hpp"
#include "ros2/node/time.hpp"

namespace ros2 {

class Log {
 public:
  /// `name` is the node's full one; what is below `least` is not said. Without a writer there is no /rosout.
  Log(const std::string& name, LogLevel least, const Clock& clock, std::shared_ptr<Writer> rosout);

  void operator()(LogLevel level, const std::string& text) const;
  void info(const std::string& text) const { (*this)(LogLevel::info, text); }
  void warn(const std::string& text) const { (*this)(LogLevel::warn, text); }
  void error(const std::string& text) const { (*this)(LogLevel::error, text); }
  /// A warning that may come often: at most one each second; what comes between is left out.
  void warn_now_and_then(const std::string& text);

 private:
  std::string name_;  // with dots
  LogLevel least_;
  const Clock& clock_;
  std::shared_ptr<Writer> rosout_;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace ros2
