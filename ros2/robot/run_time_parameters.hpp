// What may change while the robot drives, as parameters of the planner's node: the fields of
// config/run_time_values.hpp with the ranges of the robot's file, and `pause`. A change with a value beyond
// its limits is refused as a whole.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "config/run_time_values.hpp"
#include "ros2/node/node.hpp"

namespace spf_ros2 {

struct RunTimeSettings {
  spf::RobotFile file;  ///< with the present values
  bool paused = false;
};

class RunTimeParameters {
 public:
  using Apply = std::function<void(const RunTimeSettings& settings)>;

  /// Begins with what the node was given for them, and applies it. Throws std::invalid_argument when that is
  /// out of range.
  RunTimeParameters(ros2::Node& node, const spf::RobotFile& file, Apply apply);
  RunTimeParameters(const RunTimeParameters&) = delete;
  RunTimeParameters& operator=(const RunTimeParameters&) = delete;

 private:
  /// Why not, or nothing: then the changes hold.
  [[nodiscard]] std::string change(const std::vector<ros2::Parameters::Named>& changes);

  spf::RobotFile file_;  // as it was read
  Apply apply_;
  std::map<std::string, spf::RunTimeValue> values_;
  bool paused_ = false;
};

}  // namespace spf_ros2
