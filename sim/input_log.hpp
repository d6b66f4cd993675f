// Everything that one robot of a trial was given and what it did, as a value: to play it again through
// another composition of the same robot.
#pragma once

#include <vector>

#include "sim/trial_listener.hpp"

namespace spf::sim {

struct LoggedTick {
  double time = 0.0;  ///< [s]
  RobotInput input;
  RobotAction action;
};

class InputLog : public TrialListener {
 public:
  explicit InputLog(int robot) : robot_{robot} {}

  void thought(double time, int robot, const RobotInput& input, const RobotAction& action) override {
    if (robot == robot_) ticks_.push_back({time, input, action});
  }
  [[nodiscard]] const std::vector<LoggedTick>& ticks() const { return ticks_; }

 private:
  int robot_;
  std::vector<LoggedTick> ticks_;
};

}  // namespace spf::sim
