// Simulated sensors of the robots (docs/protocol.md): own pose with noise and seams, moving obstacles in
// range and line of sight, range scans. Every kind of noise has a random stream of its own per robot. Frame:
// world.
#pragma once

#include <vector>

#include "sim/dynamic_obstacles.hpp"
#include "sim/range_sensor.hpp"
#include "sim/robot_truth.hpp"
#include "sim/uniform_grid.hpp"
#include "spf/math/random_stream.hpp"
#include "spf/world/observation.hpp"

namespace spf::sim {

/// Detections of other robots (SensingParameters::peer_detection_range) have this plus the robot's number as
/// id.
inline constexpr int kPeerDetectionId = 1'000'000;

/// The true surroundings at one instant.
struct Surroundings {
  double time = 0.0;   ///< [s]
  double share = 0.0;  ///< of the obstacles' current step, in [0, 1)
  const std::vector<DynamicObstacle>* dynamic_obstacles = nullptr;
  const std::vector<Eigen::Vector2d>* robots = nullptr;  ///< [m] centres
  const UniformGrid* robot_grid = nullptr;               ///< over `robots`
  const std::vector<int>* broken = nullptr;              ///< robots that nobody hears of, sorted; null: none
  const std::vector<RobotTruth>* bodies = nullptr;       ///< of the robots; null: all are discs
};

class Sensing {
 public:
  explicit Sensing(const Scenario& scenario);

  /// From now on with these static shapes.
  void change_shapes(const Scenario& scenario) { range_sensor_ = RangeSensor{scenario}; }

  /// The measured pose of a robot whose true pose is given. Call it once per robot and pose tick.
  [[nodiscard]] PoseMeasurement measure_pose(int robot, double time, const Pose2& true_pose_world);

  /// What the robot senses from its true pose, into `observation`, whose memory is reused.
  void observe(int robot, const Pose2& true_pose_world, const Surroundings& surroundings,
               Observation& observation);

 private:
  struct PoseChannel {
    RandomStream noise;
    RandomStream seam_noise;
    bool started = false;
    Eigen::Vector2d last_position = Eigen::Vector2d::Zero();  // [m] true
    Eigen::Vector2d jump = Eigen::Vector2d::Zero();           // [m] at jump_time
    double jump_time = 0.0;                                   // [s]
  };
  [[nodiscard]] Eigen::Vector2d seam_offset(PoseChannel& channel, double time,
                                            const Eigen::Vector2d& position);
  [[nodiscard]] Detection detect(int robot, int id, const Eigen::Vector2d& position,
                                 const Eigen::Vector2d& velocity, double radius) const;
  void detect_all(int robot, const Eigen::Vector2d& from, const Surroundings& surroundings,
                  Observation& observation);
  void detect_peer(int robot, int peer, const Eigen::Vector2d& from, const Surroundings& surroundings,
                   Observation& observation);
  void gather_bodies(int robot, const Eigen::Vector2d& from, const Surroundings& surroundings);
  void scan(int robot, const Pose2& true_pose_world, RangeScan& scan);

  SensingParameters parameters_;
  PoseNoiseParameters pose_noise_;
  std::vector<Segment> seams_;
  std::vector<double> radii_;  // [m] by robot
  double largest_radius_;      // [m] of them
  RangeSensor range_sensor_;
  std::vector<PoseChannel> pose_channels_;      // by robot
  std::vector<std::uint64_t> detection_seeds_;  // by robot
  std::vector<RandomStream> scan_noise_;        // by robot
  std::vector<std::uint64_t> observations_;     // made so far, by robot
  std::vector<SeenDisc> bodies_;                // that block sight in the current observation; reused
};

}  // namespace spf::sim
