// What a node is told by its command line: everything between --ros-args and -- (or the end) is for ROS.
//   -r, --remap FROM:=TO (or NODE:FROM:=TO)    -p, --param NAME:=VALUE (or NODE:NAME:=VALUE)
//   --params-file FILE                         --log-level LEVEL
//   -e, --enclave PATH (taken and not used)    --enable-..., --disable-... of rosout, stdout and external
//   libraries' logs
#pragma once

#include <string>
#include <vector>

#include "ros2/node/names.hpp"
#include "ros2/node/parameter_file.hpp"

namespace ros2 {

enum class LogLevel : std::uint8_t { debug = 10, info = 20, warn = 30, error = 40, fatal = 50 };

struct Arguments {
  std::vector<RemapRule> remaps;
  std::vector<ParameterRule> parameters;  ///< of files and of the command line; later ones win
  LogLevel log_level = LogLevel::info;
  bool rosout = true;
  std::vector<std::string> others;  ///< what is not for ROS, the program's name first

  /// Throws std::invalid_argument with the argument and what is wrong with it.
  [[nodiscard]] static Arguments parse(const std::vector<std::string>& arguments);

  /// The values for a node by its full name, the last of each name.
  [[nodiscard]] std::vector<std::pair<std::string, ParameterValue>> parameters_for(
      const std::string& node) const;
};

}  // namespace ros2
