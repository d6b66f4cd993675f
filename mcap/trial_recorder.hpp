// Records a trial whose robots run in the simulation itself (spf run): what they measure and scan, their
// maps, plans and health as messages of ROS 2, and their planners' own numbers as JSON. Time 0 is that of the
// trial.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mcap/recording.hpp"
#include "sim/scenario.hpp"
#include "sim/trial_listener.hpp"

namespace spf::mcap {

class TrialRecorder : public sim::TrialListener {
 public:
  /// Throws std::runtime_error when the file cannot be written.
  TrialRecorder(const std::string& path, const sim::Scenario& scenario);

  void frame(const sim::TrialFrame& frame) override;
  void thought(double time, int robot, const sim::RobotInput& input, const sim::RobotAction& action) override;
  void planned(double time, const RobotAgent& agent, double plan_ms) override;
  void controlled(double time, int robot, double control_us) override;
  void stopped(double time, const RobotAgent& agent) override;
  void contact(const sim::Contact& contact) override;
  void hit_while_standing(const sim::Contact& contact) override;
  void ordered(double time, const sim::FleetOrder& order, const Eigen::Vector2d& position_world) override;
  void arrived(double time, int robot, const Eigen::Vector2d& position_world) override;

  /// Throws std::runtime_error when something could not be written.
  void close() { recording_.close(); }

 private:
  struct Robot {
    std::uint64_t map_revision = 0;
    double next_map = 0.0;  // [s]
    bool map_shown = false;
  };
  void add_robot(double time, int number, const host::RobotHost& host, Robot& robot);
  void add_map(double time, int number, const OccupancyMap& map, Robot& robot);
  void add_health(const sim::TrialFrame& frame);
  void add_event(double time, int robot, const std::string& kind, const std::string& text);

  sim::Scenario scenario_;
  Recording recording_;
  std::vector<Robot> robots_;
  double next_health_ = 0.0;  // [s]
};

}  // namespace spf::mcap
