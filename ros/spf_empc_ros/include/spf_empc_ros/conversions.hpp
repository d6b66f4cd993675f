// Messages to values and back. What comes from outside is a value, or a refusal with its reason; nothing
// throws. Frames: the caller says which one the fleet uses; times are the host's [s] on the value side.
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>
#include <spf_empc_msgs/Observation.h>
#include <spf_empc_msgs/ObstacleTracks.h>
#include <spf_empc_msgs/Trajectory.h>
#include <spf_empc_msgs/WheelSpeeds.h>

#include <optional>
#include <string>
#include <vector>

#include "host/driver_scan.hpp"
#include "host/planner_host.hpp"
#include "spf/world/obstacle_track.hpp"
#include "spf/world/occupancy_map.hpp"
#include "spf/world/trajectory_message.hpp"
#include "spf_empc_ros/clock_edge.hpp"

namespace spf_empc_ros {

/// A value, or why there is none.
template <class Value>
struct Converted {
  std::optional<Value> value;
  std::string refusal;

  [[nodiscard]] static Converted refused(std::string why) { return {std::nullopt, std::move(why)}; }
  explicit operator bool() const { return value.has_value(); }
  const Value& operator*() const { return *value; }
  const Value* operator->() const { return &*value; }
};

/// "/map" and "map" are the same.
[[nodiscard]] std::string plain_frame(const std::string& frame);

// ---- trajectories of the fleet
struct StampedTrajectory {
  spf::TrajectoryMessage message;
  std::optional<double> observed;  ///< [s] when the newest observation behind it was made
};
[[nodiscard]] spf_empc_msgs::Trajectory to_message(const StampedTrajectory& stamped, const ClockEdge& clock,
                                                   const std::string& frame);
[[nodiscard]] Converted<StampedTrajectory> from_message(const spf_empc_msgs::Trajectory& message,
                                                        const ClockEdge& clock, const std::string& frame);

// ---- what the wheels are told: rim speeds [m/s], wheel 1 first
[[nodiscard]] spf_empc_msgs::WheelSpeeds to_message(const spf::DriveInput& wheel_speeds, double limit);
/// Refused unless there is one for each of the drive's `inputs`.
[[nodiscard]] Converted<spf::DriveInput> from_message(const spf_empc_msgs::WheelSpeeds& message, int inputs);

// ---- what is sensed. Positions are moved by `fleet_from_message`, the pose of the message's frame in the
// fleet's.
[[nodiscard]] Converted<spf::Pose2> from_message(const geometry_msgs::Pose& pose);
[[nodiscard]] geometry_msgs::Pose to_message(const spf::Pose2& pose);
[[nodiscard]] spf::Pose2 compose(const spf::Pose2& outer, const spf::Pose2& inner);

/// Readings as they come.
[[nodiscard]] Converted<spf::RangeScan> from_message(const sensor_msgs::LaserScan& scan);
/// With the pose of its frame in the body's.
[[nodiscard]] Converted<spf::host::DriverScan> driver_scan(const sensor_msgs::LaserScan& scan,
                                                           const geometry_msgs::Pose& scanner_in_body);
[[nodiscard]] sensor_msgs::LaserScan to_message(const spf::RangeScan& scan);

[[nodiscard]] Converted<std::vector<spf::Detection>> from_message(const spf_empc_msgs::ObstacleTracks& tracks,
                                                                  const spf::Pose2& fleet_from_message);
[[nodiscard]] spf_empc_msgs::ObstacleTracks to_message(const std::vector<spf::ObstacleTrack>& tracks,
                                                       const ClockEdge& clock, const std::string& frame);

[[nodiscard]] spf_empc_msgs::Observation to_message(const spf::host::SensedWorld& sensed,
                                                    const ClockEdge& clock, const std::string& frame);
[[nodiscard]] Converted<spf::host::SensedWorld> from_message(const spf_empc_msgs::Observation& message,
                                                             const ClockEdge& clock,
                                                             const std::string& frame);

// ---- maps: cells of 50 or more are occupied, unknown ones are free, and the world ends at the edges.
[[nodiscard]] Converted<spf::OccupancyMap> from_message(const nav_msgs::OccupancyGrid& grid,
                                                        const std::string& frame,
                                                        const spf::host::HostParameters& host);
[[nodiscard]] nav_msgs::OccupancyGrid to_message(const spf::OccupancyMap& map, const std::string& frame);

}  // namespace spf_empc_ros
