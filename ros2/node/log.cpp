#include "ros2/node/log.hpp"

#include <algorithm>
#include <cstdio>
#include <ros2_messages/rcl_interfaces/Log.hpp>
#include <utility>

namespace ros2 {
namespace {

std::string with_dots(const std::string& name) {
  std::string result = name.substr(name.rfind('/', 0) == 0 ? 1 : 0);
  std::replace(result.begin(), result.end(), '/', '.');
  return result;
}

const char* word_for(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return "DEBUG";
    case LogLevel::info:
      return "INFO";
    case LogLevel::warn:
      return "WARN";
    case LogLevel::error:
      return "ERROR";
    case LogLevel::fatal:
      return "FATAL";
  }
  return "?";
}

}  // namespace

Log::Log(const std::string& name, LogLevel least, const Clock& clock, std::shared_ptr<Writer> rosout)
    : name_{with_dots(name)}, least_{least}, clock_{clock}, rosout_{std::move(rosout)} {}

void Log::operator()(LogLevel level, const std::string& text) const {
  if (level < least_) return;
  const builtin_interfaces::Time stamp = clock_.stamp();
  std::fprintf(stderr, "[%s] [%d.%09u] [%s]: %s\n", word_for(level), stamp.sec, stamp.nanosec, name_.c_str(),
               text.c_str());
  if (!rosout_) return;
  rcl_interfaces::Log message;
  message.stamp = stamp;
  message.level = static_cast<std::uint8_t>(level);
  message.name = name_;
  message.msg = text;
  rosout_->write(to_cdr(message));
}

void Log::warn_now_and_then(const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::seconds{1};
  warn(text);
}

}  // namespace ros2
