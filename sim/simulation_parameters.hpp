// How a trial is run: obstacle noise, sensing, radio, and when it ends. Units SI. Everything that a scenario
// file may set besides the geometry; docs/protocol.md gives the defaults.
#pragma once

#include <array>
#include <limits>
#include <utility>

#include "host/map_grain.hpp"
#include "spf/math/parameters.hpp"

namespace spf::sim {

enum class NoiseModel {
  white,  ///< the nominal velocity stays, fresh noise each step (the paper's text as printed)
  walk,   ///< the velocity itself walks, its length clipped
};
enum class MapKnowledge {
  known,   ///< every robot is given the static map
  sensed,  ///< robots know only what their range sensor has seen
};
enum class DetectionQuality {
  exact,  ///< true position and velocity
  noisy,  ///< noisy position, no velocity
  scan,   ///< none: robots find what moves in their scans
};
enum class AfterContact {
  end,    ///< the trial ends
  wreck,  ///< the robot stays where it is, silent, and the others go on
  go_on,  ///< all go on; every contact is counted once while it lasts
};
enum class AfterArrival {
  stay,   ///< at its goal, and goes on dodging
  leave,  ///< the scene: the robot is gone
};
enum class GoalSupply {
  listed,    ///< each robot's list, then it has arrived
  repeated,  ///< the list again and again
  drawn,     ///< after the list places drawn anew, without end
};
enum class TrackingMode {
  ideal,  ///< the robot is at its trajectory's point
  full,   ///< observer, controller, wheel limits and motor lag
};

}  // namespace spf::sim

namespace spf {
template <>
struct EnumNames<sim::NoiseModel> {
  static constexpr std::array<std::pair<sim::NoiseModel, const char*>, 2> values{
      {{sim::NoiseModel::white, "white"}, {sim::NoiseModel::walk, "walk"}}};
};
template <>
struct EnumNames<sim::MapKnowledge> {
  static constexpr std::array<std::pair<sim::MapKnowledge, const char*>, 2> values{
      {{sim::MapKnowledge::known, "known"}, {sim::MapKnowledge::sensed, "sensed"}}};
};
template <>
struct EnumNames<sim::DetectionQuality> {
  static constexpr std::array<std::pair<sim::DetectionQuality, const char*>, 3> values{
      {{sim::DetectionQuality::exact, "exact"},
       {sim::DetectionQuality::noisy, "noisy"},
       {sim::DetectionQuality::scan, "scan"}}};
};
template <>
struct EnumNames<sim::AfterContact> {
  static constexpr std::array<std::pair<sim::AfterContact, const char*>, 3> values{
      {{sim::AfterContact::end, "end"},
       {sim::AfterContact::wreck, "wreck"},
       {sim::AfterContact::go_on, "go_on"}}};
};
template <>
struct EnumNames<sim::AfterArrival> {
  static constexpr std::array<std::pair<sim::AfterArrival, const char*>, 2> values{
      {{sim::AfterArrival::stay, "stay"}, {sim::AfterArrival::leave, "leave"}}};
};
template <>
struct EnumNames<sim::GoalSupply> {
  static constexpr std::array<std::pair<sim::GoalSupply, const char*>, 3> values{
      {{sim::GoalSupply::listed, "listed"},
       {sim::GoalSupply::repeated, "repeated"},
       {sim::GoalSupply::drawn, "drawn"}}};
};
template <>
struct EnumNames<sim::TrackingMode> {
  static constexpr std::array<std::pair<sim::TrackingMode, const char*>, 2> values{
      {{sim::TrackingMode::ideal, "ideal"}, {sim::TrackingMode::full, "full"}}};
};
}  // namespace spf

namespace spf::sim {

inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// Disturbance of the moving obstacles (docs/protocol.md).
struct ObstacleNoiseParameters {
  NoiseModel model = NoiseModel::white;
  double level = 0.0;        ///< [1] s: multiplies both covariances, 1 = "1 Sigma"
  double scale = 1.0;        ///< [1] further factor on both covariances (0.01 in P8)
  double speed_limit = 1.0;  ///< [m/s] clip of the walk

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("model", self.model, "white: nominal velocity with fresh noise; walk: the velocity itself walks");
    visit("level", self.level, "1", Range{0.0, 100.0}, "multiple of Sigma, the paper's noise level");
    visit("scale", self.scale, "1", Range{0.0, 100.0}, "further factor on the covariances, for small arenas");
    visit("speed_limit", self.speed_limit, "m/s", Range{0.0, 100.0}, "largest speed of a walking obstacle");
  }
};

/// What robots see (docs/protocol.md).
struct SensingParameters {
  double range = 8.0;  ///< [m] of the detector and of the range sensor
  MapKnowledge map = MapKnowledge::known;
  DetectionQuality detections = DetectionQuality::exact;
  double position_sigma = 0.05;       ///< [m] per axis, of noisy detections
  bool peers_block_beams = true;      ///< the range sensor sees other robots
  double peer_detection_range = 0.0;  ///< [m] other robots reported as discs of unknown intent, 0 = never
  int beams = 180;                    ///< [1] of a sweep
  double field_of_view = 360.0;       ///< [deg] of the range sensor, as much to the left as to the right
  double range_sigma = 0.0;           ///< [m] noise of one beam
  double rate = 10.0;                 ///< [Hz] of detections and scans
  bool guard = false;        ///< scans guard the robots' path, where there are any; off, since trials compare
                             ///< what planners do, while robots come with their guard on
  host::MapGrain map_grain;  ///< of the robots' maps (coarser where they had too many nodes)

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("range", self.range, "m", Range{0.1, 1000.0}, "how far detector and range sensor reach");
    visit("map", self.map, "static map known from the start, or only as sensed");
    visit("detections", self.detections,
          "exact: true position and velocity; noisy: position with noise only; scan: none, robots find what "
          "moves in "
          "their scans");
    visit("position_sigma", self.position_sigma, "m", Range{0.0, 10.0},
          "noise of a noisy detection, per axis");
    visit("peers_block_beams", self.peers_block_beams, "the range sensor sees other robots");
    visit("peer_detection_range", self.peer_detection_range, "m", Range{0.0, 1000.0},
          "other robots nearer than this are detected as discs of unknown intent (0 = never)");
    visit("beams", self.beams, "1", Range{3, 3600}, "beams of one sweep of the range sensor");
    visit("field_of_view", self.field_of_view, "deg", Range{10.0, 360.0},
          "angle that a sweep covers, its middle ahead");
    visit("range_sigma", self.range_sigma, "m", Range{0.0, 10.0}, "noise of one beam");
    visit("rate", self.rate, "Hz", Range{0.1, 200.0}, "rate of detections and scans");
    visit("guard", self.guard, "raw scans, where there are any, slow and stop robots before what is ahead");
    host::MapGrain::visit_fields_as("map_resolution", "map_max_distance", self.map_grain, visit);
  }
};

/// Noise of a robot's own pose (the paper's state deviation; seams as on its platform).
struct PoseNoiseParameters {
  double position_sigma = 0.0;  ///< [m] per axis and observation
  double heading_sigma = 0.0;   ///< [rad] per observation
  double rate = 100.0;          ///< [Hz]
  double seam_sigma = 0.0;      ///< [m] per axis, jump of the observed pose on crossing a seam

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("position_sigma", self.position_sigma, "m", Range{0.0, 100.0},
          "noise of an observed pose, per axis");
    visit("heading_sigma", self.heading_sigma, "rad", Range{0.0, 3.2}, "noise of an observed heading");
    visit("rate", self.rate, "Hz", Range{1.0, 200.0}, "rate of pose observations");
    visit("seam_sigma", self.seam_sigma, "m", Range{0.0, 10.0},
          "jump of the observed pose at a seam, per axis");
  }
};

/// The radio between robots.
struct RadioParameters {
  double delay = 0.05;        ///< [s]
  double loss = 0.0;          ///< [1] probability that one receiver misses one message
  double range = kUnlimited;  ///< [m]

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("delay", self.delay, "s", Range{0.0, 60.0}, "time from sending to hearing");
    visit("loss", self.loss, "1", Range{0.0, 1.0}, "probability that a receiver misses a message");
    visit("range", self.range, "m", Range{0.0, kUnlimited}, "how far a message carries");
  }
};

/// How motion is made, and how a trial ends (docs/protocol.md).
struct TrialParameters {
  TrackingMode tracking = TrackingMode::full;
  AfterContact after_contact = AfterContact::end;
  AfterArrival after_arrival = AfterArrival::stay;
  GoalSupply goals = GoalSupply::listed;
  double goal_pause = 0.0;        ///< [s] at a goal before the next one is given
  double plant_rate = 200.0;      ///< [Hz] base tick: plant steps and contact sweeps; a multiple of 10
  double computing_delay = 0.0;   ///< [s] what planning knows of obstacles and peers is older by this
  double time_limit = 0.0;        ///< [s] 0 = the protocol's: max(120 s, 4 times the obstacle-free time)
  double latest_arrival = 0.0;    ///< [1] times the obstacle-free time; a later one is none; 0 = any will do
  double arrival_distance = 0.1;  ///< [m]

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("tracking", self.tracking,
          "ideal: the robot is at its trajectory's point; full: controller and drive");
    visit("after_contact", self.after_contact,
          "a contact ends the trial, leaves wrecks behind, or is counted and all go on");
    visit("after_arrival", self.after_arrival, "robots stay at their goals, or leave the scene");
    visit(
        "goals", self.goals,
        "listed: every robot has arrived at the last of its goals; repeated: it begins with the first again; "
        "drawn: goals are drawn without end");
    visit("goal_pause", self.goal_pause, "s", Range{0.0, 10000.0},
          "time at a goal before the robot is told the next one");
    visit("plant_rate", self.plant_rate, "Hz", Range{50.0, 5000.0},
          "steps of the plant and of the contact sweep");
    visit("computing_delay", self.computing_delay, "s", Range{0.0, 5.0},
          "simulated time that a plan takes: it is committed by then, knowing what was sensed and heard "
          "before");
    visit(
        "time_limit", self.time_limit, "s", Range{0.0, 100000.0},
        "a trial that takes longer is over time; 0 = max(120 s, 4 times the obstacle-free time), in ped the "
        "window");
    visit("latest_arrival", self.latest_arrival, "1", Range{0.0, 1000.0},
          "a robot that takes longer than so many times its obstacle-free time counts as over time; 0 = any "
          "time within the trial will do");
    visit("arrival_distance", self.arrival_distance, "m", Range{0.001, 100.0},
          "nearer to the goal, and slower than 0.2 m/s, has arrived");
  }
};

struct SimulationParameters {
  ObstacleNoiseParameters noise;
  SensingParameters sensing;
  PoseNoiseParameters pose_noise;
  RadioParameters radio;
  TrialParameters trial;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.group("noise", self.noise);
    visit.group("sensing", self.sensing);
    visit.group("pose_noise", self.pose_noise);
    visit.group("radio", self.radio);
    visit.group("trial", self.trial);
  }
};

}  // namespace spf::sim
