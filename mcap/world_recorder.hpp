// Records a world that is served to robots elsewhere: what goes out to them, and everything as it truly is.
// Topics are those by which a simulator serves it.
#pragma once

#include <string>
#include <vector>

#include "mcap/recording.hpp"
#include "simulator/server.hpp"

namespace spf::mcap {

class WorldRecorder : public simulator::WorldListener {
 public:
  /// `recording` must outlive it.
  WorldRecorder(Recording& recording, const simulator::Settings& settings);

  void clock(const sim::World&) override {}
  void goal(const sim::World& world, int robot, const host::Goal& goal, double any_heading) override;
  void order(const sim::World& world, const sim::FleetOrder& order) override;
  void pose(const sim::World& world, int robot, const Pose2& measured) override;
  void truth(const sim::World& world) override;
  void obstacles(const sim::World& world, int robot, const std::vector<Detection>& detections) override;
  void scan(const sim::World& world, int robot, const RangeScan& scan) override;
  void scene(const sim::World& world) override;
  void outcome(const sim::World& world, const sim::TrialResult& result, bool finished) override;

 private:
  Recording& recording_;
  std::string frame_;
};

}  // namespace spf::mcap
