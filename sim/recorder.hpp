// Fills a Recording while a trial runs, from its beginning up to a limit.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_set>
#include <vector>

#include "sim/recording.hpp"
#include "sim/trial_listener.hpp"

namespace spf::sim {

class Recorder : public TrialListener {
 public:
  Recorder(const Scenario& scenario, const GridFrame& map_frame, const RecordLimit& limit);

  /// The scenario's static shapes are others from now on.
  void change(const Scenario& scenario) { recording_->scenario = scenario; }

  void frame(const TrialFrame& view) override;
  void planned(double time, const RobotAgent& agent, double plan_ms) override;
  void stopped(double time, const RobotAgent& agent) override;
  void contact(const Contact& contact) override;
  void hit_while_standing(const Contact& contact) override;
  void ordered(double time, const FleetOrder& order, const Eigen::Vector2d& position_world) override;
  void arrived(double time, int robot, const Eigen::Vector2d& position_world) override;

  [[nodiscard]] std::shared_ptr<const Recording> take() { return std::move(recording_); }
  /// What has been recorded since the last call, with the scenario that it began with; goes on recording.
  [[nodiscard]] std::shared_ptr<const Recording> take_so_far();

 private:
  void note_contact(const Contact& contact, RecordedEvent::Kind kind);
  void note_status(double time, int robot, const AgentStatus& status, const Eigen::Vector2d& position_world);
  void note_cells(double time, int robot, const OccupancyMap& map);

  RecordLimit limit_;
  std::shared_ptr<Recording> recording_;
  bool full_ = false;
  std::vector<StopCause> last_reason_;                    // by robot
  std::vector<std::uint64_t> last_revision_;              // of the maps, by robot
  std::vector<std::unordered_set<std::uint64_t>> cells_;  // occupied, by robot
};

}  // namespace spf::sim
