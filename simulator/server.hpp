// Serves a sim::World to robots elsewhere: what is sensed goes out, commands come in, and the world moves on
// when it is time on the wall's clock. Knows no ROS: an Outlet carries everything. Frame: world, SI.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/world.hpp"
#include "simulator/pace.hpp"
#include "simulator/settings.hpp"
#include "simulator/simulated_bases.hpp"

namespace spf::simulator {

/// Told what a world is like; what it makes of that changes nothing in the world. Times are the world's own.
class WorldListener {
 public:
  virtual ~WorldListener() = default;

  virtual void clock(const sim::World& world) = 0;
  /// A robot is sent to a goal; where any heading will do it may have `any_heading` [rad].
  virtual void goal(const sim::World& world, int robot, const host::Goal& goal, double any_heading) = 0;
  /// cancel, pause, resume, stop or release; goals come by goal().
  virtual void order(const sim::World& world, const sim::FleetOrder& order) = 0;
  virtual void pose(const sim::World& world, int robot, const Pose2& measured) = 0;
  /// The true poses of all robots.
  virtual void truth(const sim::World& world) = 0;
  virtual void obstacles(const sim::World& world, int robot, const std::vector<Detection>& detections) = 0;
  virtual void scan(const sim::World& world, int robot, const RangeScan& scan) = 0;
  /// Everything as it truly is may be shown.
  virtual void scene(const sim::World& world) = 0;
  virtual void outcome(const sim::World& world, const sim::TrialResult& result, bool finished) = 0;
};

/// The way to the robots and back. Commands are given to the Server's bases while it serves.
class Outlet : public WorldListener {
 public:
  /// [s], of any zero
  [[nodiscard]] virtual double wall() const = 0;
  /// Takes what comes in until a time on the wall [s]. False when the program is to end.
  virtual bool serve_until(double wall) = 0;
  /// Whether a robot listens and commands.
  [[nodiscard]] virtual bool is_there(int robot) const = 0;
  /// All of them are, and their clock is about to run.
  virtual void begin(const sim::World& /*world*/) {}
  /// For people, on the way.
  virtual void say(const std::string& text) = 0;
};

class Server {
 public:
  /// The settings must have been checked. Throws std::invalid_argument when the scenario cannot be used.
  explicit Server(const Settings& settings);

  [[nodiscard]] const sim::World& world() const { return world_; }
  [[nodiscard]] const Settings& settings() const { return settings_; }
  /// Commands of the robots, at the world's present time.
  void command_twist(int robot, const Eigen::Vector3d& twist_body) {
    bases_.command_twist(robot, twist_body, world_.time());
  }
  void command_wheels(int robot, const std::vector<double>& wheel_speeds) {
    bases_.command_wheels(robot, wheel_speeds, world_.time());
  }

  /// Of whatever goes out. Must outlive the server.
  void record_by(WorldListener& recorder) { recorder_ = &recorder; }
  /// Until the trial has ended (quits_when_done) or the outlet says so. Returns the program's exit status: 0
  /// unless the trial failed, or was to end and did not.
  int run(Outlet& outlet);
  /// "trial 0: success after 31.20 s, 5 of 5 robots at goal, 0 contacts"
  [[nodiscard]] std::string summary() const;
  /// How well the clock was kept, and how regularly robots commanded; lines.
  [[nodiscard]] std::string timing() const;

 private:
  /// By a member function of WorldListener.
  template <class... Parameters, class... Arguments>
  void tell(Outlet& outlet, void (WorldListener::*what)(Parameters...), const Arguments&... arguments) const {
    (outlet.*what)(world_, arguments...);
    if (recorder_ != nullptr) (recorder_->*what)(world_, arguments...);
  }
  [[nodiscard]] bool wait_for_robots(Outlet& outlet);
  [[nodiscard]] std::string missing(const Outlet& outlet) const;
  [[nodiscard]] bool tick(Outlet& outlet);
  void tell_orders(Outlet& outlet) const;
  void tell_poses(Outlet& outlet);
  void tell_observations(Outlet& outlet);
  void tell_outcome(Outlet& outlet);
  void note_end(Outlet& outlet);
  [[nodiscard]] bool dropped(FaultyTopic topic, int robot) const;
  [[nodiscard]] int count() const { return static_cast<int>(world_.robots().size()); }

  Settings settings_;
  sim::World world_;
  SimulatedBases bases_;
  Pace pace_;
  Observation observation_;  // kept for its memory
  std::optional<sim::TrialResult> end_;
  WorldListener* recorder_ = nullptr;
  struct {
    double began = 0.0;  // [s] on the wall
    double ended = 0.0;  // [s] likewise, so far
  } wall_;
  double next_truth_ = 0.0;    // [s]
  double next_outcome_ = 0.0;  // [s]
};

}  // namespace spf::simulator
