// Writes a Recording while a trial runs. Looks on only: a recorded trial goes the same way as an unrecorded
// one.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_set>
#include <vector>

#include "sim/contact_monitor.hpp"
#include "sim/recording.hpp"
#include "sim/robot_truth.hpp"

namespace spf::sim {

class Recorder {
 public:
  Recorder(const Scenario& scenario, const GridFrame& map_frame);

  /// What a frame is made of, beside the agents.
  struct View {
    double time = 0.0;
    double share = 0.0;  ///< of the movers' step
    const std::vector<RobotTruth>* robots = nullptr;
    const std::vector<Mover>* movers = nullptr;
    const std::vector<RobotAgent>* agents = nullptr;
    const std::vector<Eigen::Vector3d>* wheel_speeds = nullptr;    ///< [m/s] true
    const std::vector<Eigen::Vector3d>* wheel_commands = nullptr;  ///< [m/s]
    const std::vector<double>* control_us = nullptr;
    const StaticShapes* shapes = nullptr;
  };
  void frame(const View& view);
  void plan(double time, const RobotAgent& agent, double plan_ms);
  void contact(const Contact& contact, RecordedEvent::Kind kind);
  void arrival(double time, int robot, const Eigen::Vector2d& position_world);

  [[nodiscard]] std::shared_ptr<const Recording> take() { return std::move(recording_); }

 private:
  void note_status(double time, int robot, const AgentStatus& status, const Eigen::Vector2d& position_world);
  void note_cells(double time, int robot, const OccupancyMap& map);

  std::shared_ptr<Recording> recording_;
  std::vector<StandReason> last_reason_;                  // by robot
  std::vector<std::uint64_t> last_revision_;              // of the maps, by robot
  std::vector<std::unordered_set<std::uint64_t>> cells_;  // occupied, by robot
};

}  // namespace spf::sim
