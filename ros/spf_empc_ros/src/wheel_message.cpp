#include "spf_empc_ros/conversions.hpp"

namespace spf_empc_ros {

spf_empc_msgs::WheelSpeeds to_message(const Eigen::Vector3d& wheel_speeds, double limit) {
  spf_empc_msgs::WheelSpeeds message;
  message.speeds.assign(wheel_speeds.begin(), wheel_speeds.end());
  message.limit = limit;
  return message;
}

Converted<Eigen::Vector3d> from_message(const spf_empc_msgs::WheelSpeeds& message) {
  using Result = Converted<Eigen::Vector3d>;
  if (message.speeds.size() != 3)
    return Result::refused("speeds has " + std::to_string(message.speeds.size()) + " entries, not 3");
  const Eigen::Vector3d speeds{message.speeds[0], message.speeds[1], message.speeds[2]};
  if (!speeds.allFinite()) return Result::refused("a speed is not finite");
  return {speeds, {}};
}

}  // namespace spf_empc_ros
