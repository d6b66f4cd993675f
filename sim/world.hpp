// The ground truth of one trial, tick by tick, for any host of robots: sim::Simulation runs agents in it, the
// ROS simulator serves it over topics. Independent of agents. Deterministic: noise depends on the scenario
// alone, as long as poses and observations are taken at the same ticks. Frame: world, SI.
#pragma once

#include <vector>

#include "sim/contact_monitor.hpp"
#include "sim/dynamic_obstacles.hpp"
#include "sim/fleet_life.hpp"
#include "sim/robot_truth.hpp"
#include "sim/sensing.hpp"
#include "sim/trial_meter.hpp"
#include "spf/math/index.hpp"
#include "spf/robot/drive_dynamics.hpp"

namespace spf::sim {

class World {
 public:
  /// Throws std::invalid_argument with all reasons when the scenario cannot be used.
  explicit World(const Scenario& scenario);

  // One tick, in the order of docs/protocol.md: begin_tick(); robots obey orders(); whatever is due is sensed
  // and commanded; end_tick(). A host may go on after finished().
  void begin_tick();
  /// Moves the robots, checks for contacts, records arrivals and advances the time by one tick. Throws
  /// std::runtime_error when a robot's position is no longer finite.
  void end_tick();

  [[nodiscard]] double time() const { return static_cast<double>(tick_) / plant_rate_; }           ///< [s]
  [[nodiscard]] double next_time() const { return static_cast<double>(tick_ + 1) / plant_rate_; }  ///< [s]
  /// Whether the dynamic obstacles begin a step of 0.1 s with this tick.
  [[nodiscard]] bool step_due() const { return tick_ % ticks_.step == 0; }
  [[nodiscard]] bool pose_due() const { return tick_ % ticks_.pose == 0; }
  /// Of all robots at the start, then each at its own instants of the period (phase_of), as scanners do.
  [[nodiscard]] bool observation_due(int robot) const { return observation_due_[as_index(robot)]; }
  [[nodiscard]] double pose_interval() const {
    return static_cast<double>(ticks_.pose) / plant_rate_;
  }  ///< [s]
  /// Share of the obstacles' step at the beginning of the tick, in [0, 1).
  [[nodiscard]] double share() const { return share_at(tick_); }

  /// Call it once per robot in each tick in which it is due: every call draws noise.
  [[nodiscard]] PoseMeasurement measure_pose(int robot);
  /// Likewise, into `observation`, whose memory is reused.
  void observe(int robot, Observation& observation);

  /// Commanded wheel speeds [m/s], held until the next call (TrackingMode::full). A robot that is not active
  /// takes none.
  void command(int robot, const DriveInput& wheel_speeds) {
    if (robots_[as_index(robot)].active()) commands_[as_index(robot)] = wheel_speeds;
  }
  /// Sets the robot's pose and velocity at the end of the tick (TrackingMode::ideal).
  void place(int robot, const Pose2& pose_world, const Eigen::Vector2d& velocity_world);

  // What somebody may change while it runs, between two ticks: a trial that was changed is no trial of its
  // scenario.
  /// Passed on like an event of the scenario, when poses are due next.
  void tell(const FleetOrder& order) { life_.events.add({order, time()}); }
  /// Takes over static shapes, the ways of people, further people, and where robots join. Throws
  /// std::invalid_argument, with all reasons, when the changed scenario cannot be used or has other robots;
  /// nothing is then changed.
  void change(const Scenario& changed);
  /// Where a robot that has left joins.
  void set_start(int robot, const Pose2& pose_world) { scenario_.robots[as_index(robot)].start = pose_world; }
  /// Puts a moving disc or a person with waypoints elsewhere [m], by the id that detections have.
  void place_moving(int id, const Eigen::Vector2d& position_world) {
    dynamic_obstacles_.place(id, position_world);
  }

  /// True when a contact ends the trial, all robots have arrived or are wrecks, or time is up.
  [[nodiscard]] bool finished() const;
  /// The result so far, without what only a host of agents knows (plans, messages, timings).
  [[nodiscard]] TrialResult result() const;

  [[nodiscard]] const Scenario& scenario() const { return scenario_; }
  [[nodiscard]] const std::vector<RobotTruth>& robots() const { return robots_; }
  [[nodiscard]] const std::vector<DynamicObstacle>& dynamic_obstacles() const {
    return dynamic_obstacles_.all();
  }
  [[nodiscard]] const StaticShapes& shapes() const { return monitor_.shapes(); }
  [[nodiscard]] const std::vector<DriveInput>& commands() const { return commands_; }  ///< [m/s] by robot
  [[nodiscard]] const DriveDynamics& plant(int robot) const { return plants_[as_index(robot)]; }
  [[nodiscard]] const std::vector<Eigen::Vector2d>& positions() const {
    return positions_;
  }  ///< [m] of robots
  [[nodiscard]] const UniformGrid& robot_grid() const {
    return grid_;
  }  ///< over positions(), since a pose tick

  /// What robots are told, or befalls them, at the beginning of this tick (fleet_order.hpp); only where poses
  /// are due.
  [[nodiscard]] const std::vector<FleetOrder>& orders() const { return life_.orders; }
  /// Where the robot is to go, or has arrived; none when it is to go nowhere.
  [[nodiscard]] const std::optional<host::Goal>& goal(int robot) const {
    return meter_.goals()[as_index(robot)];
  }

  // Events by time; arrivals are those of the last tick.
  [[nodiscard]] const std::vector<Contact>& contacts() const { return monitor_.contacts(); }
  [[nodiscard]] const std::vector<Contact>& hits_while_standing() const {
    return monitor_.hits_while_standing();
  }
  [[nodiscard]] const std::vector<int>& arrivals() const { return meter_.arrivals(); }

 private:
  struct Placement {
    Pose2 pose_world;
    Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();  // [m/s]
  };
  [[nodiscard]] double share_at(long tick) const {
    return static_cast<double>(tick % ticks_.step) / static_cast<double>(ticks_.step);
  }
  void obey(const FleetOrder& order);
  void note_broken();
  [[nodiscard]] bool possible(const FleetOrder& order) const;
  void move();
  void move(std::size_t robot);
  void check();

  Scenario scenario_;
  double plant_rate_;  // [Hz]
  struct {
    long step;  // of the dynamic obstacles
    long pose;
    long observation;
  } ticks_;
  double time_limit_;  // [s]

  long tick_ = 0;
  std::vector<long> next_observation_tick_;  // by robot: on the first pose tick from here
  std::vector<char> observation_due_;        // by robot
  std::size_t contacts_seen_ = 0;
  std::vector<RobotTruth> robots_;
  std::vector<DriveDynamics> plants_;
  std::vector<DriveInput> commands_;   // by robot
  std::vector<Placement> placements_;  // by robot, of TrackingMode::ideal
  std::vector<Eigen::Vector2d> positions_;
  UniformGrid grid_;
  DynamicObstacles dynamic_obstacles_;
  Sensing sensing_;
  ContactMonitor monitor_;
  TrialMeter meter_;
  struct {
    FleetLife events;
    std::vector<FleetOrder> orders = {};  // of this tick
    std::vector<int> broken = {};         // robots, sorted
  } life_;
};

}  // namespace spf::sim
