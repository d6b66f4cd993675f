#include "apps/progress_line.hpp"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <iostream>

namespace spf {

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string clock_text(double seconds) {
  const long whole = std::isfinite(seconds) && seconds > 0.0 ? std::lround(seconds) : 0;
  const auto two = [](long value) { return (value < 10 ? "0" : "") + std::to_string(value); };
  if (whole < 3600) return std::to_string(whole / 60) + ":" + two(whole % 60);
  return std::to_string(whole / 3600) + ":" + two(whole / 60 % 60) + ":" + two(whole % 60);
}

ProgressLine::ProgressLine(bool quiet) : quiet_{quiet}, terminal_{::isatty(STDERR_FILENO) == 1} {}

ProgressLine::~ProgressLine() {
  end();
}

void ProgressLine::show(const std::string& text) {
  constexpr double kOnTerminal = 0.2;  // [s]
  constexpr double kElsewhere = 10.0;  // [s] keeps a log readable
  const double now = steady_seconds();
  if (quiet_) return;
  if (next_ == 0.0 && !terminal_) next_ = now + kElsewhere;  // short work leaves no line in a log
  if (now < next_) return;
  next_ = now + (terminal_ ? kOnTerminal : kElsewhere);
  if (terminal_)
    std::cerr << "\r\033[K" << text << std::flush;
  else
    std::cerr << text << std::endl;
  open_ = terminal_;
}

void ProgressLine::end() {
  if (open_) std::cerr << "\r\033[K" << std::flush;
  open_ = false;
}

}  // namespace spf
