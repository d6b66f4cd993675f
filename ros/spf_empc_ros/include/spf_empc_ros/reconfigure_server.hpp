// What may change while the robot drives, as dynamic_reconfigure's tools know it (rqt_reconfigure, dynparam,
// its clients): the fields of config/run_time_values.hpp with the ranges of the robot's file, and a pause.
// The fields are written down there once, so no generated header is used. A change with a value beyond its
// limits is refused as a whole: the service fails, nothing is repaired.
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "config/run_time_values.hpp"
#include "spf_empc_ros/parameter_store.hpp"

namespace spf_empc_ros {

struct RunTimeSettings {
  spf::RobotFile file;  ///< with the present values
  bool paused = false;
};

class ReconfigureServer {
 public:
  using Apply = std::function<void(const RunTimeSettings& settings)>;
  using Refuse = std::function<void(const char* what, const std::string& why)>;

  /// Begins with what the private parameters of these names say (`own`: the node's private namespace), as
  /// the process before this one has left them, and applies it. Throws std::invalid_argument when they are
  /// out of range.
  ReconfigureServer(const ros::NodeHandle& own, const spf::RobotFile& file, ParameterStore& store,
                    Apply apply, Refuse refuse);
  ReconfigureServer(const ReconfigureServer&) = delete;
  ReconfigureServer& operator=(const ReconfigureServer&) = delete;

 private:
  void read_parameters();
  bool on_set(dynamic_reconfigure::Reconfigure::Request& request,
              dynamic_reconfigure::Reconfigure::Response& response);
  /// Throws std::invalid_argument, and changes nothing then.
  void change(const dynamic_reconfigure::Config& asked);
  [[nodiscard]] dynamic_reconfigure::Config present() const;

  ros::NodeHandle own_;
  spf::RobotFile file_;  // as it was read
  std::vector<spf::RunTimeField> fields_;
  ParameterStore& store_;
  Apply apply_;
  Refuse refuse_;
  std::map<std::string, spf::RunTimeValue> values_;  // that differ from the file's
  bool paused_ = false;
  ros::Publisher descriptions_, updates_;
  ros::ServiceServer service_;
};

/// As a client sees the fields: names, limits, defaults, words.
[[nodiscard]] dynamic_reconfigure::ConfigDescription description_of(
    const std::vector<spf::RunTimeField>& fields);

}  // namespace spf_empc_ros
