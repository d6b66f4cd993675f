// Everything that a replay of a trial shows, in frames of 0.1 s: the ground truth, every robot's beliefs and
// plans, and events. Plain data. Frame: world, SI.
#pragma once

#include <string>
#include <vector>

#include "sim/scenario.hpp"
#include "spf/team/robot_agent.hpp"

namespace spf::sim {

/// Gap to the nearest thing of one kind, radii subtracted; `other` is its id, -1 = none. Infinite when there
/// is none.
struct RecordedClearance {
  double distance = 0.0;  ///< [m]
  int other = -1;
};

struct RecordedTrack {
  int id = 0;
  ObstacleState state;  ///< as believed, at the frame's time
  double sigma = 0.0;   ///< [m] of the position, per axis
};

struct RecordedRobot {
  Pose2 pose;                                                ///< ground truth
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();  ///< [m/s]
  AgentEstimate estimate;
  DriveInput wheel_speeds;    ///< true
  DriveInput wheel_commands;  ///< as commanded
  AgentStatus status;
  bool wrecked = false;
  bool broken = false;  ///< down, until it is repaired
  bool gone = false;    ///< not in the scene
  RecordedClearance to_dynamic, to_peer, to_static;
  double control_us = 0.0;  ///< [us] of the last control tick, 0 without a clock
  std::vector<RecordedTrack> tracks;
};

struct RecordedDynamicObstacle {
  int id = 0;
  bool person = false;
  ObstacleState state;
};

struct RecordedFrame {
  double time = 0.0;  ///< [s]
  std::vector<RecordedRobot> robots;
  std::vector<RecordedDynamicObstacle> dynamic_obstacles;
};

struct RecordedPoint {
  double time = 0.0;  ///< [s]
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();
};

struct RecordedCandidate {
  Candidate::Kind kind = Candidate::Kind::optimised;
  double cost = 0.0;
  double risk = 0.0;
  bool chosen = false;
  std::vector<RecordedPoint> points;
};

/// One planning call, or what was done without one.
struct RecordedPlan {
  double time = 0.0;  ///< [s]
  int robot = 0;
  StopCause stop = StopCause::none;  ///< the planner was not asked, for this: no outcome, risk, statistics
  PlanOutcome outcome = PlanOutcome::success;
  double risk = 0.0;
  PlanStats stats;
  double plan_ms = 0.0;               ///< [ms] 0 without a clock
  std::vector<RecordedPoint> points;  ///< of the committed trajectory, from the present on
  std::vector<RecordedCandidate> candidates;
};

/// Cells of a robot's own map, by their indices in its grid.
struct RecordedCells {
  double time = 0.0;  ///< [s]
  int robot = 0;
  std::vector<Eigen::Vector2i> added, removed;
};

struct RecordedEvent {
  enum class Kind { contact, hit_while_standing, stop, go, arrival, order };
  double time = 0.0;  ///< [s]
  int robot = -1;
  Kind kind = Kind::stop;
  std::string text;                                          ///< the stop cause, or what was touched
  int other = -1;                                            ///< id of what blocks or was touched, -1 = none
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m] of the robot
};

/// Another goal of a robot from a time on.
struct RecordedGoal {
  double time = 0.0;  ///< [s]
  int robot = 0;
  std::optional<host::Goal> goal;  ///< none: it is to go nowhere
};

/// When a recording ends before its trial does, so that a long one does not fill the memory.
struct RecordLimit {
  double always = 300.0;          ///< [s] that are recorded in any case
  std::size_t records = 200'000;  ///< frames of one robot, about 4 kB each
};

struct Recording {
  Scenario scenario;
  double frame_interval = 0.1;  ///< [s]
  GridFrame map_frame;          ///< of the robots' maps; a cell is centred on its node
  std::vector<RecordedFrame> frames;
  std::vector<RecordedPlan> plans;    ///< by time
  std::vector<RecordedCells> cells;   ///< by time
  std::vector<RecordedEvent> events;  ///< by time
  std::vector<RecordedGoal> goals;    ///< by time, after the first ones
};

}  // namespace spf::sim
