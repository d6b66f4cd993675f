// One simulated run as plain data: what the replay page and the still picture draw.
// Units: m, s, rad, m/s. Frame: world everywhere. Any values are legal, except as require_consistent()
// refuses; a NaN or infinite number means "not known" and is simply not drawn.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spf {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct ReplayPoint {
  double x = 0.0;  ///< [m]
  double y = 0.0;  ///< [m]
};
struct ReplayPose {
  double x = 0.0, y = 0.0;  ///< [m]
  double heading = 0.0;     ///< [rad]
};
struct ReplayTimedPoint {
  double time = 0.0;        ///< [s] since the start of the run
  double x = 0.0, y = 0.0;  ///< [m]
};
struct ReplayBox {
  ReplayPoint low, high;  ///< [m] corners of an axis-parallel box
};
struct ReplayDisc {
  ReplayPoint center;
  double radius = 0.0;  ///< [m]
};
struct ReplayCovariance {
  double xx = kUnknown, xy = 0.0, yy = kUnknown;  ///< [m^2] of a position
};
struct ReplayEllipse {
  ReplayPoint center;
  double half_axis_long = 0.0, half_axis_short = 0.0;  ///< [m] 0 = there is none
  double angle = 0.0;                                  ///< [rad] of the long axis
};

/// How a state is painted; its words are free.
enum class ReplayStateKind { moving, braking, waiting, arrived, trouble };
struct ReplayState {
  std::string text;  ///< "moving", "no plan: boxed in by robot 4", ...
  ReplayStateKind kind = ReplayStateKind::moving;
};

/// Gap to the nearest thing of one kind, radii taken off; index is its id, -1 = none or nameless.
struct ReplayClearance {
  double distance = kUnknown;  ///< [m]
  int index = -1;
};

/// A moving obstacle as the robot believes it to be.
struct ReplayTrack {
  int id = 0;
  double x = 0.0, y = 0.0;  ///< [m]
  double sigma = 0.0;       ///< [m] standard deviation of the position, its larger axis
};

struct ReplayRobotFrame {
  ReplayPose pose;                                    ///< the truth
  ReplayPose estimate{kUnknown, kUnknown, kUnknown};  ///< what the observer says
  ReplayCovariance estimate_covariance;               ///< of the estimated position
  int state = 0;                                      ///< index into ReplayData::states
  std::array<double, 6> wheel_speeds{};               ///< [m/s] at the rims of the first `wheels`
  ReplayClearance to_obstacle, to_peer, to_static;    ///< [m]
  double control_time = kUnknown;                     ///< [s] of computing, one control tick
  std::vector<ReplayTrack> tracks;                    ///< perceived moving obstacles
};

struct ReplayCandidate {
  std::string label;  ///< "left", "right", "wait", ...
  std::vector<ReplayPoint> points;
  bool chosen = false;
  double cost = kUnknown;  ///< [1]
  double risk = kUnknown;  ///< [1]
};

struct ReplayPlan {
  double time = 0.0;                     ///< [s] when it was committed (or given up)
  std::vector<ReplayTimedPoint> points;  ///< sampled positions, times ascending; empty: the old plan stays
  std::vector<ReplayCandidate> candidates;
  std::string outcome;              ///< "planned", "no plan: ...", ...
  double planning_time = kUnknown;  ///< [s] of computing
  int evaluations = 0;              ///< of the cost
};

struct ReplayCell {
  int x = 0, y = 0;  ///< the cell's low corner is cell_origin + cell_size * (x, y)
};
/// Cells that became occupied, or free again, in a robot's own map.
struct ReplayCellUpdate {
  double time = 0.0;  ///< [s]
  std::vector<ReplayCell> added, removed;
};

/// Where a robot is to go from a time on; unknown: nowhere.
struct ReplayGoal {
  double time = 0.0;  ///< [s]
  ReplayPoint position;
};

struct ReplayRobot {
  int id = 0;
  double radius = 0.3;                   ///< [m]
  std::vector<ReplayPoint> corners;      ///< [m] in the body frame, of a robot that has them
  ReplayPoint goal;                      ///< the first
  std::vector<ReplayGoal> goals;         ///< further ones, times ascending
  std::size_t wheels = 3;                ///< at most 6; of a car 1: its rear axle
  double wheel_speed_limit = kUnknown;   ///< [m/s]
  double sensing_range = kUnknown;       ///< [m]
  std::vector<ReplayRobotFrame> frames;  ///< one per frame_interval, the first at time 0
  std::vector<ReplayPlan> plans;         ///< times ascending
  double cell_size = 0.1;                ///< [m]
  ReplayPoint cell_origin;
  std::vector<ReplayCellUpdate> cells;  ///< times ascending
};

struct ReplayObstacleFrame {
  ReplayPoint position;
  ReplayPoint velocity;  ///< [m/s]
  ReplayEllipse field;   ///< outline of the field at ReplayData::field_threshold
};
struct ReplayObstacle {
  int id = 0;
  double radius = 0.4;  ///< [m]
  std::vector<ReplayObstacleFrame> frames;
};

enum class ReplayEventKind { contact, stop, arrival, note };
struct ReplayEvent {
  double time = 0.0;  ///< [s]
  int robot = -1;     ///< its id, -1 = none
  ReplayEventKind kind = ReplayEventKind::note;
  std::string text;                     ///< the reason, in words
  std::string other;                    ///< whom or what it was with: "obstacle 0", "robot 4", "border"
  std::optional<ReplayPoint> position;  ///< where it happened; marked in the scene for contacts
};

/// What stands.
struct ReplayShapes {
  std::vector<ReplayBox> boxes;
  std::vector<ReplayDisc> discs;
  std::vector<std::vector<ReplayPoint>> polygons;  ///< filled, each by its corners
  std::vector<std::array<ReplayPoint, 4>> blocks;  ///< of a map of cells: filled, without an outline
};

struct ReplayData {
  std::string title, family, method, noise, tracking;
  double level = 0.0;  ///< [1] noise level, in units of Sigma
  std::uint64_t seed = 0;
  int trial = 0;
  std::string outcome;  ///< "success", "collision", "overtime", ...
  bool success = false;
  double frame_interval = 0.1;  ///< [s]
  ReplayBox bounds{{-15.0, -15.0}, {15.0, 15.0}};
  ReplayShapes shapes;
  double field_threshold = 1.2;  ///< [1] Mahalanobis distance of the drawn outlines
  std::vector<ReplayState> states{{"moving", ReplayStateKind::moving}};
  std::vector<ReplayRobot> robots;
  std::vector<ReplayObstacle> obstacles;
  std::vector<ReplayEvent> events;                           ///< times ascending
  std::vector<std::pair<std::string, std::string>> summary;  ///< name, value with unit
};

/// Index of this state in data.states; added when new.
[[nodiscard]] int state_index(ReplayData& data, std::string_view text, ReplayStateKind kind);

/// Throws std::invalid_argument, with all reasons, when: frame_interval is not positive, bounds span no area,
/// robot ids repeat, a state is not in the table, robots or obstacles have different numbers of frames.
void require_consistent(const ReplayData& data);

/// Where the robot is to go at a time [s]; unknown: nowhere.
[[nodiscard]] ReplayPoint goal_at(const ReplayRobot& robot, double time);

/// Frames of the longest robot or obstacle.
[[nodiscard]] std::size_t frame_count(const ReplayData& data);

}  // namespace spf
