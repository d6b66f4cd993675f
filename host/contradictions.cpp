#include "host/contradictions.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "host/robot_map.hpp"
#include "spf/planning/planner_parameters.hpp"
#include "spf/robot/drive_dynamics.hpp"

namespace spf::host {
namespace {

/// "1.5 m/s"
std::string quantity(double value, const char* unit) {
  std::ostringstream text;
  text.precision(4);
  text << value;
  if (*unit != '\0') text << " " << unit;
  return text.str();
}

/// A setting by its key in files.
struct Named {
  const char* key;
  double value;
  const char* unit;
};

/// "host.plan_silence = 0.5 s"
std::string shown(const Named& setting) {
  return std::string{setting.key} + " = " + quantity(setting.value, setting.unit);
}

/// Whether a value is more than a limit, beyond rounding.
bool exceeds(double value, double limit) {
  constexpr double kRounding = 1e-9;
  return value > limit + kRounding * std::abs(limit);
}

class Rules {
 public:
  Rules(const AgentParameters& agent, const HostParameters& host, const OperatingConditions& conditions)
      : agent_{agent}, robot_{agent.robot}, host_{host}, conditions_{conditions} {}

  std::vector<Contradiction> take() {
    if (conditions_.by_wheels) {
      check_drive();
      check_control();
      check_poses();
    }
    check_footprint();
    check_observations();
    check_sight();
    check_map();
    check_broadcasts();
    check_encounters();
    return std::move(found_);
  }

 private:
  void add(Severity severity, const Named& setting, const Named& other, std::string sentence) {
    found_.push_back(
        {severity, setting.key, other.key, quantity(setting.value, setting.unit), std::move(sentence)});
  }
  /// A warning when the setting exceeds a limit that follows from another one.
  void warn_above(const Named& setting, double limit, const Named& other, const std::string& what) {
    if (exceeds(setting.value, limit))
      add(Severity::warning, setting, other,
          "is more than " + what + ": " + quantity(limit, setting.unit) + " (" + shown(other) + ")");
  }
  /// One that is longer than another one.
  void check_longer(Severity severity, const Named& setting, const Named& other, const std::string& so) {
    if (exceeds(setting.value, other.value))
      add(severity, setting, other, "is longer than " + shown(other) + ": " + so);
  }

  void check_drive();
  void check_control();
  void check_poses();
  void check_footprint();
  void check_observations();
  void check_sight();
  void check_map();
  void check_broadcasts();
  void check_encounters();

  /// [m] driven from full speed until the robot stands, from when something could first have been sensed.
  [[nodiscard]] double stopping_distance() const {
    const double reaction = 1.0 / conditions_.sensing_rate + conditions_.computing_delay +
                            agent_.team.plan_period + agent_.tracker.control_period + robot_.motor_lag;
    return robot_.max_speed * (reaction + 0.5 * robot_.max_speed / robot_.max_acceleration);
  }
  [[nodiscard]] Named stale_time() const { return {"agent.team.stale_time", agent_.team.stale_time, "s"}; }
  [[nodiscard]] Named radius() const { return {"robot.radius", robot_.radius, "m"}; }
  [[nodiscard]] Named max_speed() const { return {"robot.max_speed", robot_.max_speed, "m/s"}; }
  [[nodiscard]] Named pose_sigma() const {
    return {"agent.tracker.observer.pose_sigma", agent_.tracker.observer.pose_sigma, "m"};
  }

  const AgentParameters& agent_;
  const RobotParameters& robot_;
  const HostParameters& host_;
  const OperatingConditions& conditions_;
  std::vector<Contradiction> found_;
};

/// What is planned, against what the wheels can do in the worst direction.
void Rules::check_drive() {
  const DriveDynamics drive{robot_};
  const auto& wheels = drive.drive().wheel_from_body();
  const Named rim{"robot.max_wheel_speed", robot_.max_wheel_speed, "m/s"};
  const Named torque{"robot.max_wheel_torque", robot_.max_wheel_torque, "N m"};
  // A wheel turns fastest in a motion along its own rim.
  double speed = std::numeric_limits<double>::infinity();
  for (int wheel = 0; wheel < wheels.rows(); ++wheel)
    speed = std::min(speed, rim.value / wheels.row(wheel).head<2>().norm());
  warn_above(max_speed(), speed, rim, "the wheels reach in every direction");
  warn_above({"robot.max_acceleration", robot_.max_acceleration, "m/s^2"}, drive.max_acceleration_anywhere(),
             torque, "the wheels give in every direction, so that the robot brakes later than it plans");
  if (robot_.drive == DriveType::car) return;  // turns as it is steered
  warn_above({"robot.max_yaw_rate", robot_.max_yaw_rate, "rad/s"},
             rim.value / wheels.col(2).cwiseAbs().maxCoeff(), rim, "the wheels reach");
  warn_above({"robot.max_yaw_acceleration", robot_.max_yaw_acceleration, "rad/s^2"},
             drive.max_yaw_acceleration(), torque, "the wheels give");
}

/// Rates of planner and controller, against the silences that their watchdogs bear.
void Rules::check_control() {
  const Named control{"agent.tracker.control_period", agent_.tracker.control_period, "s"};
  check_longer(Severity::error, {"agent.team.plan_period", agent_.team.plan_period, "s"},
               {"host.plan_silence", host_.plan_silence, "s"},
               "the controller would brake between any two plans");
  check_longer(Severity::error, control, {"host.command_silence", host_.command_silence, "s"},
               "the wheels would be taken to stand between any two commands");
  check_longer(Severity::error, control, {"host.clock_jump", host_.clock_jump, "s"},
               "every control tick would count as a jump of the clock");
  check_longer(Severity::warning, {"agent.team.reanchor_distance", agent_.team.reanchor_distance, "m"},
               {"host.largest_plan_error", host_.largest_plan_error, "m"},
               "the controller stops a robot that is so far from its plan before the plan starts anew");
}

void Rules::check_poses() {
  constexpr double kSigmas = 6.0;  // of the difference of two poses
  const Named rate{"pose_noise.rate", conditions_.pose_rate, "Hz"};
  if (exceeds(1.0 / rate.value, stale_time().value))
    add(Severity::warning, rate, stale_time(),
        "leaves " + quantity(1.0 / rate.value, "s") + " between two poses, longer than " +
            shown(stale_time()) + ": the robot brakes between them");
  check_longer(Severity::warning, {"host.clock_error", host_.clock_error, "s"}, stale_time(),
               "a pose that is stamped so far ahead hides that no other follows");
  const Named jump{"host.jump_distance", host_.jump_distance, "m"};
  const Named turn{"host.jump_heading", host_.jump_heading, "rad"};
  const Named heading_sigma{"agent.tracker.observer.heading_sigma", agent_.tracker.observer.heading_sigma,
                            "rad"};
  const auto check_noise = [this](const Named& gate, const Named& sigma) {
    if (exceeds(kSigmas * sigma.value, gate.value))
      add(Severity::warning, gate, sigma,
          "is less than 6 times " + shown(sigma) + ": noise is taken for a jump of the pose");
  };
  check_noise(jump, pose_sigma());
  check_noise(turn, heading_sigma);
}

void Rules::check_footprint() {
  check_longer(Severity::warning, {"robot.wheel_arm", robot_.wheel_arm, "m"}, radius(),
               "the wheels stand out of the disc that is kept free");
}

/// Whether what is sensed arrives before it is too old.
void Rules::check_observations() {
  const Named delay{"trial.computing_delay", conditions_.computing_delay, "s"};
  if (exceeds(delay.value, stale_time().value))
    return check_longer(Severity::error, delay, stale_time(),
                        "whatever the robot senses would be too old to count");
  const Named rate{"sensing.rate", conditions_.sensing_rate, "Hz"};
  const double oldest = 1.0 / rate.value + delay.value;  // [s] just before the next one is taken in
  if ((host_.relies_on_scan || host_.relies_on_obstacles) && exceeds(oldest, stale_time().value))
    add(Severity::warning, rate, stale_time(),
        "lets observations grow " + quantity(oldest, "s") + " old, longer than " + shown(stale_time()) +
            ": the robot brakes between them");
}

void Rules::check_sight() {
  if (!host_.relies_on_obstacles && !agent_.perception.enabled && !conditions_.others_report)
    found_.push_back({Severity::warning, "agent.perception.enabled", "host.relies_on_obstacles", "false",
                      "together with host.relies_on_obstacles = false leaves nobody to tell of what moves"});
  const Named range{"sensing.range", conditions_.sensing_range, "m"};
  const double needed = robot_.radius + stopping_distance();
  if (exceeds(needed, range.value))
    add(Severity::warning, range, max_speed(),
        "is shorter than the " + quantity(needed, "m") + " that the robot needs to stop (" +
            shown(max_speed()) + ", " + shown({"robot.max_acceleration", robot_.max_acceleration, "m/s^2"}) +
            ")");
}

void Rules::check_map() {
  const Named reach{"host.map_reach", host_.map_grain.reach, "m"};
  const double least =
      robot_.radius + std::max(agent_.planner.static_margin, agent_.space_time.static_margin);
  if (!exceeds(std::max(reach.value, kLeastReach * host_.map_grain.resolution), least))
    add(Severity::error, reach, radius(),
        "does not reach beyond the robot and its margin, " + quantity(least, "m") + " (" + shown(radius()) +
            "): all ground would look blocked");
  check_longer(Severity::warning, {"host.map_resolution", host_.map_grain.resolution, "m"}, radius(),
               "gaps that the robot could pass vanish from its map");
}

/// Whether peers with the same parameters can rely on what this robot tells.
void Rules::check_broadcasts() {
  const Named lifetime{"agent.team.message_lifetime", agent_.team.message_lifetime, "s"};
  const Named period{"agent.team.message_period", agent_.team.message_period, "s"};
  const double gap = std::max(period.value, agent_.team.plan_period) + conditions_.message_delay;
  if (exceeds(gap, lifetime.value))
    add(Severity::warning, lifetime, period,
        "is shorter than the " + quantity(gap, "s") +
            " until the next broadcast is heard: peers no longer rely on this robot's plan by then");
  if (host_.trusts_peers) return;
  const auto check_peer = [this](const Named& own, double most, const Named& limit) {
    if (exceeds(most, limit.value))
      add(Severity::warning, own, limit,
          "goes beyond " + shown(limit) + ": peers with the same parameters refuse this robot's broadcasts");
  };
  check_peer(radius(), radius().value, {"host.largest_peer_radius", host_.largest_peer_radius, "m"});
  check_peer(pose_sigma(), pose_sigma().value, {"host.largest_peer_sigma", host_.largest_peer_sigma, "m"});
  check_peer(max_speed(), (1.0 + kSpeedTolerance) * max_speed().value,
             {"host.largest_peer_speed", host_.largest_peer_speed, "m/s"});
}

/// Whether two robots that drive towards each other know of each other in time to stop.
void Rules::check_encounters() {
  if (!conditions_.has_peers) return;
  const bool lost = conditions_.message_loss >= 1.0;
  const double heard = lost ? 0.0 : conditions_.message_range;
  const double needed = 2.0 * (robot_.radius + stopping_distance());
  if (!exceeds(needed, std::max(heard, conditions_.peer_sight))) return;
  const Named setting = lost ? Named{"radio.loss", conditions_.message_loss, ""}
                             : Named{"radio.range", conditions_.message_range, "m"};
  add(Severity::warning, setting, {"sensing.peer_detection_range", conditions_.peer_sight, "m"},
      "keeps robots from hearing of each other within the " + quantity(needed, "m") +
          " that two of them need to stop, and they sense each other within " +
          quantity(conditions_.peer_sight, "m") + " (sensing.peer_detection_range)");
}

}  // namespace

std::string to_text(const Contradiction& contradiction) {
  return contradiction.key + " = " + contradiction.value + " " + contradiction.sentence;
}

std::vector<Contradiction> contradictions(const AgentParameters& agent, const HostParameters& host,
                                          const OperatingConditions& conditions) {
  return Rules{agent, host, conditions}.take();
}

void refuse_contradictions(const std::vector<Contradiction>& found) {
  std::string reasons;
  for (const Contradiction& contradiction : found)
    if (contradiction.severity == Severity::error)
      reasons += (reasons.empty() ? "" : "; ") + to_text(contradiction);
  if (!reasons.empty()) throw std::invalid_argument(reasons);
}

}  // namespace spf::host
