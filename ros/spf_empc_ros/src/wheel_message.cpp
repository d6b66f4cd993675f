#include "spf_empc_ros/conversions.hpp"

namespace spf_empc_ros {

spf_empc_msgs::WheelSpeeds to_message(const spf::DriveInput& wheel_speeds, double limit) {
  spf_empc_msgs::WheelSpeeds message;
  message.speeds.assign(wheel_speeds.begin(), wheel_speeds.end());
  message.limit = limit;
  return message;
}

Converted<spf::DriveInput> from_message(const spf_empc_msgs::WheelSpeeds& message, int inputs) {
  using Result = Converted<spf::DriveInput>;
  if (message.speeds.size() != static_cast<std::size_t>(inputs))
    return Result::refused("speeds has " + std::to_string(message.speeds.size()) + " entries, not " +
                           std::to_string(inputs));
  const spf::DriveInput speeds = Eigen::Map<const Eigen::VectorXd>(message.speeds.data(), inputs);
  if (!speeds.allFinite()) return Result::refused("a speed is not finite");
  return {speeds, {}};
}

}  // namespace spf_empc_ros
