// Perception from scans: the cost of a sweep, and its quality in simulated trials of the experiment protocol
// (docs/perception.md). The robots of a trial drive with exact detections; beside each of them a scanner (720
// beams, 2 cm noise, 10 Hz) and a ScanPerception look on, whose tracks are compared with the truth. PED needs
// recordings below SPF_DATA_DIR. Counters:
//   position_cm, velocity_cm_s  median errors of confirmed tracks with 5 returns; velocity after 1 s
//   believed_*                  the same of an ObstacleTracker that gets the detections
//   missed_pct                  no confirmed track, of obstacles with 5 returns for 0.4 s
//   false_per_min               confirmed tracks of nothing that moves, per robot-minute
//   ghost_s_per_min             seconds of such tracks out of sight, per robot-minute
//   static_s_per_min            seconds of reported tracks of nothing that moves, per robot-minute
//   first_s, first_p95_s        from the first sweep with 5 returns to the confirmed track
//   switches_per_min            changes of an obstacle's track, per minute in sight, if hidden for 2 s at
//   most
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "sim/families.hpp"
#include "sim/range_sensor.hpp"
#include "sim/simulation.hpp"
#include "spf/math/angles.hpp"
#include "spf/perception/scan_perception.hpp"
#include "spf/world/obstacle_tracker.hpp"

namespace {

using spf::kPi;

constexpr int kFirstTrial = 10000;  // those below are for claims
constexpr double kRangeSigma = 0.02;
constexpr double kSameObject = 0.5;  // [m] from a track's centre to the truth
constexpr int kVisibleReturns = 5;
constexpr double kForgotten = 2.0;  // [s] hidden for longer, an obstacle may get a new track

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

struct Quality {
  std::vector<double> position, velocity, believed_position, believed_velocity, first;
  double expected = 0.0, missed = 0.0;  // obstacles times sweeps
  double obstacle_minutes = 0.0, switches = 0.0;
  double robot_minutes = 0.0, false_tracks = 0.0, ghosts = 0.0, reported = 0.0;
};

/// One robot's record of one obstacle.
struct Acquaintance {
  double visible_since = -1.0;
  double confirmed_since = -1.0;
  double last_shown = -1.0;
  int track = -1;
};

/// One robot's scanner and perception, and how it compares with the truth.
class Onlooker {
 public:
  Onlooker(const spf::sim::Scenario& scenario, int robot, double field_of_view)
      : sensor_{scenario},
        map_{robot_map(scenario)},
        robot_{robot},
        field_of_view_{field_of_view},
        mapped_{scenario.simulation.sensing.map == spf::sim::MapKnowledge::sensed},
        radius_{scenario.robot.radius},
        noise_{spf::mix(scenario.seed, static_cast<std::uint64_t>(scenario.trial * 100 + robot))},
        perception_{parameters(mapped_)} {}

  void look(const spf::sim::TrialFrame& frame, Quality& quality) {
    const spf::sim::RobotTruth& self = (*frame.robots)[static_cast<std::size_t>(robot_)];
    if (!self.active()) return;
    see(frame, self);
    spf::SensorSweep sweep;
    sweep.scan = &scan_;
    sweep.time = frame.time;
    sweep.pose_world = self.pose;
    perception_.update(sweep, map_, peers_);
    if (mapped_) map_.integrate(scan_, self.pose, {}, &perception_.kept_out());
    spf::Observation observation;
    observation.time = frame.time;
    perception_.detections(frame.time, observation.detections);
    believed_.update(observation);
    compare(frame, quality);
  }

 private:
  static spf::PerceptionParameters parameters(bool mapped) {
    spf::PerceptionParameters parameters;
    parameters.map_scans = mapped;
    return parameters;
  }
  void see(const spf::sim::TrialFrame& frame, const spf::sim::RobotTruth& self) {
    discs_.clear();
    peers_.clear();
    for (const spf::sim::DynamicObstacle& obstacle : *frame.dynamic_obstacles)
      discs_.push_back({obstacle.motion.at(frame.share), obstacle.radius});
    const std::size_t obstacles = discs_.size();
    for (std::size_t k = 0; k < frame.robots->size(); ++k) {
      if (k == static_cast<std::size_t>(robot_) || (*frame.robots)[k].gone) continue;
      const Eigen::Vector2d position = (*frame.robots)[k].pose.position_world;
      discs_.push_back({position, radius_});
      peers_.push_back({position, 1.5 * radius_});
    }
    sensor_.sweep(self.pose, discs_, scan_);
    const auto outside = static_cast<std::size_t>(
        std::lround(0.5 * (1.0 - field_of_view_ / (2.0 * kPi)) * static_cast<double>(scan_.ranges.size())));
    scan_.ranges.erase(scan_.ranges.end() - static_cast<std::ptrdiff_t>(outside), scan_.ranges.end());
    scan_.ranges.erase(scan_.ranges.begin(), scan_.ranges.begin() + static_cast<std::ptrdiff_t>(outside));
    scan_.angle_min += static_cast<double>(outside) * scan_.angle_increment;

    shown_.assign(obstacles, 0);
    for (std::size_t beam = 0; beam < scan_.ranges.size(); ++beam) {
      double& range = scan_.ranges[beam];
      if (!std::isfinite(range)) continue;
      const double angle =
          self.pose.heading + scan_.angle_min + static_cast<double>(beam) * scan_.angle_increment;
      const Eigen::Vector2d end =
          self.pose.position_world + range * Eigen::Vector2d{std::cos(angle), std::sin(angle)};
      for (std::size_t k = 0; k < obstacles; ++k)
        if (std::abs((end - discs_[k].position_world).norm() - discs_[k].radius) < 1e-6) ++shown_[k];
      range = std::max(range + kRangeSigma * noise_.normal(), 1e-3);
    }
  }

  void compare(const spf::sim::TrialFrame& frame, Quality& quality) {
    quality.robot_minutes += 0.1 / 60.0;
    explained_.assign(perception_.tracks().size(), 0);
    for (std::size_t k = 0; k < shown_.size(); ++k)
      compare_obstacle((*frame.dynamic_obstacles)[k], k, frame.time, quality);
    count_others(quality);
  }

  /// The confirmed track of an obstacle: its last one while it is near, otherwise the nearest.
  const spf::ScanTrack* track_of(const Eigen::Vector2d& position, double radius, int last) {
    const spf::ScanTrack* best = nullptr;
    double nearest = kSameObject;
    for (std::size_t t = 0; t < perception_.tracks().size(); ++t) {
      const spf::ScanTrack& track = perception_.tracks()[t];
      const double distance = (track.position() - position).norm();
      if (distance < kSameObject + radius) explained_[t] = 1;
      if (!track.confirmed || distance >= kSameObject) continue;
      if (track.id != last && distance >= nearest) continue;
      nearest = track.id == last ? -1.0 : distance;
      best = &track;
    }
    return best;
  }

  void compare_obstacle(const spf::sim::DynamicObstacle& truth, std::size_t k, double time,
                        Quality& quality) {
    const Eigen::Vector2d position = discs_[k].position_world;
    Acquaintance& known = known_[truth.id];
    if (shown_[k] > 0) known.last_shown = time;
    if (time - known.last_shown > kForgotten) known.track = -1;
    const spf::ScanTrack* track = track_of(position, truth.radius, known.track);
    if (shown_[k] < kVisibleReturns) {
      known.visible_since = -1.0;
      return;
    }
    if (known.visible_since < 0.0) known.visible_since = time;
    quality.obstacle_minutes += 0.1 / 60.0;
    if (time - known.visible_since > 0.4 - 1e-6) {
      quality.expected += 1.0;
      if (track == nullptr) quality.missed += 1.0;
    }
    if (track == nullptr) return;
    if (known.confirmed_since < 0.0) {
      known.confirmed_since = time;
      quality.first.push_back(time - known.visible_since);
    }
    if (known.track >= 0 && known.track != track->id) {
      quality.switches += 1.0;
      known.confirmed_since = time;
    }
    known.track = track->id;
    const bool old = time - known.confirmed_since > 1.0;
    quality.position.push_back((track->position() - position).norm());
    if (old) quality.velocity.push_back((track->velocity() - truth.velocity_world).norm());
    for (const spf::ObstacleTrack& believed : believed_.tracks()) {
      if (believed.id != track->id) continue;
      quality.believed_position.push_back((believed.state.position_world - position).norm());
      if (old)
        quality.believed_velocity.push_back((believed.state.velocity_world - truth.velocity_world).norm());
    }
  }

  /// Tracks of nothing that moves.
  void count_others(Quality& quality) {
    for (std::size_t t = 0; t < perception_.tracks().size(); ++t) {
      const spf::ScanTrack& track = perception_.tracks()[t];
      if (explained_[t] != 0) continue;
      if (track.reported) quality.reported += 0.1;
      if (!track.confirmed || (mapped_ && !track.dynamic)) continue;
      if (track.sight != spf::ScanTrack::Sight::seen) {
        quality.ghosts += 0.1;
      } else if (false_.insert(track.id).second) {
        quality.false_tracks += 1.0;
      }
    }
  }

  spf::sim::RangeSensor sensor_;
  spf::OccupancyMap map_;
  int robot_;
  double field_of_view_;
  bool mapped_;
  double radius_;
  spf::RandomStream noise_;
  spf::ScanPerception perception_;
  spf::ObstacleTracker believed_;
  spf::RangeScan scan_;
  std::vector<spf::sim::SeenDisc> discs_;
  std::vector<spf::MaskedDisc> peers_;
  std::vector<int> shown_;       // returns of each obstacle
  std::vector<char> explained_;  // tracks near any obstacle
  std::map<int, Acquaintance> known_;
  std::set<int> false_;
};

class Audience : public spf::sim::TrialListener {
 public:
  Audience(const spf::sim::Scenario& scenario, double field_of_view, Quality& quality) : quality_{quality} {
    for (std::size_t k = 0; k < scenario.robots.size(); ++k)
      onlookers_.push_back(std::make_unique<Onlooker>(scenario, static_cast<int>(k), field_of_view));
  }
  void frame(const spf::sim::TrialFrame& frame) override {
    for (const auto& onlooker : onlookers_) onlooker->look(frame, quality_);
  }

 private:
  std::vector<std::unique_ptr<Onlooker>> onlookers_;
  Quality& quality_;
};

std::shared_ptr<const spf::sim::CrowdRecording> recorded_crowd() {
  const char* folder = std::getenv("SPF_DATA_DIR");
  if (folder == nullptr) return nullptr;
  std::ifstream file{std::string{folder} + "/pedestrians/zara01.csv"};
  std::vector<spf::sim::CrowdSample> samples;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields{line};
    spf::sim::CrowdSample sample;
    if (fields >> sample.time >> sample.id >> sample.position_world.x() >> sample.position_world.y())
      samples.push_back(sample);
  }
  if (samples.empty()) return nullptr;
  return std::make_shared<spf::sim::CrowdRecording>(std::move(samples));
}

void quality_in(benchmark::State& state, spf::sim::Family family, double level, double field_of_view,
                int beams = 720) {
  spf::sim::FamilySetup setup = spf::sim::family_setup(family);
  setup.simulation.noise.model = spf::sim::NoiseModel::walk;
  setup.simulation.noise.level = level;
  setup.simulation.sensing.beams = beams;
  setup.simulation.trial.tracking = spf::sim::TrackingMode::ideal;
  setup.simulation.trial.after_contact = spf::sim::AfterContact::go_on;
  setup.simulation.trial.time_limit = 25.0;
  if (family == spf::sim::Family::ped) {
    setup.crowd = recorded_crowd();
    if (!setup.crowd) {
      for (auto _ : state) state.SetLabel("no recorded people: set SPF_DATA_DIR");
      return;
    }
  }
  Quality quality;
  int trial = kFirstTrial;
  for (auto _ : state) {
    const spf::sim::Scenario scenario =
        make_scenario(setup, spf::sim::kDefaultSeed,
                      family == spf::sim::Family::ped ? 5 * (trial++ - kFirstTrial) : trial++);
    Audience audience{scenario, field_of_view * kPi / 180.0, quality};
    spf::sim::SimulationOptions options;
    options.listener = &audience;
    static_cast<void>(spf::sim::Simulation{scenario, spf::AgentParameters{}, options}.run());
  }
  state.counters["robot_min"] = quality.robot_minutes;
  state.counters["position_cm"] = 100.0 * quantile(quality.position, 0.5);
  state.counters["position_p95_cm"] = 100.0 * quantile(quality.position, 0.95);
  state.counters["velocity_cm_s"] = 100.0 * quantile(quality.velocity, 0.5);
  state.counters["believed_cm"] = 100.0 * quantile(quality.believed_position, 0.5);
  state.counters["believed_cm_s"] = 100.0 * quantile(quality.believed_velocity, 0.5);
  state.counters["missed_pct"] = 100.0 * quality.missed / std::max(quality.expected, 1.0);
  state.counters["false_per_min"] = quality.false_tracks / std::max(quality.robot_minutes, 1e-9);
  state.counters["ghost_s_per_min"] = quality.ghosts / std::max(quality.robot_minutes, 1e-9);
  state.counters["static_s_per_min"] = quality.reported / std::max(quality.robot_minutes, 1e-9);
  state.counters["first_s"] = quantile(quality.first, 0.5);
  state.counters["first_p95_s"] = quantile(quality.first, 0.95);
  state.counters["switches_per_min"] = quality.switches / std::max(quality.obstacle_minutes, 1e-9);
}

#define SPF_QUALITY(name, family, level, ...)                                       \
  BENCHMARK_CAPTURE(quality_in, name, spf::sim::Family::family, level, __VA_ARGS__) \
      ->Iterations(3)                                                               \
      ->Unit(benchmark::kSecond)

SPF_QUALITY(t2_steady, t2, 0.0, 360.0);
SPF_QUALITY(t2, t2, 1.0, 360.0);
SPF_QUALITY(t2_270, t2, 1.0, 270.0);
SPF_QUALITY(t2_hard, t2_hard, 1.0, 360.0);
SPF_QUALITY(ped, ped, 1.0, 360.0);
SPF_QUALITY(f7, f7, 1.0, 360.0);
SPF_QUALITY(f7_180_beams, f7, 1.0, 360.0, 180);

/// One sweep of 720 beams in a room with 20 moving objects.
void sweep_cost(benchmark::State& state) {
  spf::sim::Scenario scenario;
  scenario.border = spf::sim::Box{{-7.0, -7.0}, {7.0, 7.0}};
  scenario.robots.resize(1);
  scenario.simulation.sensing.beams = 720;
  const spf::sim::RangeSensor sensor{scenario};
  const spf::OccupancyMap map = robot_map(scenario);
  spf::RandomStream random{4};
  std::vector<spf::sim::SeenDisc> discs;
  std::vector<Eigen::Vector2d> velocities;
  for (int k = 0; k < 20; ++k) {
    const double bearing = 2.0 * kPi * k / 20.0;
    const double distance = k % 2 == 0 ? 2.5 : 4.5;
    discs.push_back({distance * Eigen::Vector2d{std::cos(bearing), std::sin(bearing)}, 0.25});
    velocities.push_back(0.3 * random.normal2());
  }
  constexpr int kSweeps = 20;
  std::vector<spf::RangeScan> scans(kSweeps);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    sensor.sweep({}, discs, scans[static_cast<std::size_t>(sweep)]);
    for (double& range : scans[static_cast<std::size_t>(sweep)].ranges)
      range += kRangeSigma * random.normal();
    for (std::size_t k = 0; k < discs.size(); ++k) discs[k].position_world += 0.1 * velocities[k];
  }
  const std::vector<spf::MaskedDisc> peers(10, spf::MaskedDisc{{6.0, 6.0}, 0.45});
  spf::ScanPerception perception;
  spf::SensorSweep sweep;
  long number = 0;
  for (auto _ : state) {
    // To and fro, so that nothing jumps.
    const long phase = number % (2 * kSweeps - 2);
    sweep.scan = &scans[static_cast<std::size_t>(phase < kSweeps ? phase : 2 * kSweeps - 2 - phase)];
    sweep.time = 0.1 * static_cast<double>(number++);
    benchmark::DoNotOptimize(perception.update(sweep, map, peers));
  }
  state.counters["tracks"] = static_cast<double>(perception.tracks().size());
}
BENCHMARK(sweep_cost)->Unit(benchmark::kMicrosecond);

}  // namespace
