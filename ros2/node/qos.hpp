// Qualities of service, as far as ROS 2's nodes set them.
#pragma once

namespace ros2 {

struct Qos {
  int depth = 10;                ///< of the history that is kept; 0: all
  bool reliable = true;          ///< else best effort
  bool transient_local = false;  ///< what was sent is kept for those who come later; else volatile
  double lifespan = 0.0;         ///< [s] after which a sample counts no more; 0: never

  /// Sensor data: the newest few, and none again that was lost.
  [[nodiscard]] static constexpr Qos sensor_data() { return {5, false, false, 0.0}; }
  /// What is told once and holds: maps, static transforms.
  [[nodiscard]] static constexpr Qos latched(int depth = 1) { return {depth, true, true, 0.0}; }
  [[nodiscard]] static constexpr Qos keep_last(int depth) { return {depth, true, false, 0.0}; }
  [[nodiscard]] static constexpr Qos clock() { return {1, false, false, 0.0}; }
  [[nodiscard]] static constexpr Qos services() { return {10, true, false, 0.0}; }
  [[nodiscard]] static constexpr Qos parameters() { return {1000, true, false, 0.0}; }
  [[nodiscard]] static constexpr Qos rosout() { return {1000, true, true, 10.0}; }
};

}  // namespace ros2
