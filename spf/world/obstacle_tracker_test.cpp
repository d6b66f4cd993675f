#include "spf/world/obstacle_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

constexpr double kStep = 0.1;  // [s] of the simulated obstacles

/// Obstacles with the noise of the experiments: every step the velocity gets N(0, 1e-2 level) and the
/// position N(0, 1e-4 level) per axis; a walk keeps the noisy velocity.
class Wanderer {
 public:
  Wanderer(bool walk, double level, std::uint64_t seed, const Eigen::Vector2d& velocity)
      : walk_{walk}, level_{level}, random_{seed}, nominal_{velocity}, velocity_{velocity} {}

  void move() {
    velocity_ = nominal_ + std::sqrt(level_ * 1e-2) * random_.normal2();
    if (walk_) nominal_ = velocity_;
    position_ += kStep * velocity_ + std::sqrt(level_ * 1e-4) * random_.normal2();
    time_ += kStep;
  }
  void turn_back() { nominal_ = velocity_ = -nominal_; }
  void set_level(double level) { level_ = level; }

  [[nodiscard]] Detection exact() const {
    Detection detection;
    detection.id = 7;
    detection.position_world = position_;
    detection.velocity_world = nominal_;
    return detection;
  }
  [[nodiscard]] Detection blurred(double sigma) {
    Detection detection;
    detection.id = 7;
    detection.position_world = position_ + sigma * random_.normal2();
    detection.position_sigma = sigma;
    return detection;
  }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] const Eigen::Vector2d& position() const { return position_; }
  [[nodiscard]] const Eigen::Vector2d& velocity() const { return velocity_; }

 private:
  bool walk_;
  double level_;
  RandomStream random_;
  Eigen::Vector2d nominal_, velocity_;
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();
  double time_ = 0.0;
};

void watch(ObstacleTracker& tracker, const Detection& detection, double time) {
  Observation observation;
  observation.time = time;
  observation.detections.push_back(detection);
  tracker.update(observation);
}

/// Mean square of (truth - prediction) / sigma per axis, `ahead` steps later, once `settling` steps have
/// passed.
struct Consistency {
  double sum = 0.0;
  int count = 0;
  [[nodiscard]] double ratio() const { return sum / count; }
};

enum class Sensor { exact, blurred };

Consistency consistency(bool walk, double level, Sensor sensor, int ahead) {
  Consistency result;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    ObstacleTracker tracker;
    Wanderer obstacle{walk, level, mix(500, seed), {0.7, 0.2}};
    std::vector<std::pair<ObstacleTrack, int>> pending;
    for (int k = 0; k < 300; ++k) {
      obstacle.move();
      watch(tracker, sensor == Sensor::exact ? obstacle.exact() : obstacle.blurred(0.05), obstacle.time());
      for (const auto& [track, made] : pending) {
        if (made + ahead != k) continue;
        const double time = ahead * kStep;
        const Eigen::Vector2d expected = track.state.position_world + time * track.state.velocity_world;
        result.sum +=
            0.5 * (obstacle.position() - expected).squaredNorm() / std::pow(track.position_sigma(time), 2);
        ++result.count;
      }
      if (k >= 150 && k % 10 == 0) pending.emplace_back(tracker.tracks().front(), k);
    }
  }
  return result;
}

double mean_learnt(bool walk, double level, Sensor sensor, double ObstacleTrack::*diffusion) {
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    ObstacleTracker tracker;
    Wanderer obstacle{walk, level, mix(900, seed), {0.6, -0.3}};
    for (int k = 0; k < 400; ++k) {
      obstacle.move();
      watch(tracker, sensor == Sensor::exact ? obstacle.exact() : obstacle.blurred(0.05), obstacle.time());
    }
    sum += tracker.tracks().front().*diffusion;
  }
  return sum / 20.0;
}

TEST(ObstacleTracker, LearnsTheDiffusionsOfExactSightings) {
  for (const double level : {0.25, 1.0, 2.0}) {
    SCOPED_TRACE(level);
    // 20 runs of some 200 samples leave 2 % of chance; the rest of the prior and the clipping take some more.
    EXPECT_NEAR(mean_learnt(true, level, Sensor::exact, &ObstacleTrack::velocity_diffusion), 0.1 * level,
                0.01 * level);
    EXPECT_NEAR(mean_learnt(false, level, Sensor::exact, &ObstacleTrack::position_diffusion), 2e-3 * level,
                2e-4 * level);
    // White noise leaves the nominal velocity as it is; only the rest of the prior is left.
    EXPECT_LT(mean_learnt(false, level, Sensor::exact, &ObstacleTrack::velocity_diffusion), 0.003);
  }
}

TEST(ObstacleTracker, OrdersProcessNoiseSeenThroughMeasurementNoise) {
  const double calm = mean_learnt(true, 0.25, Sensor::blurred, &ObstacleTrack::velocity_diffusion);
  const double usual = mean_learnt(true, 1.0, Sensor::blurred, &ObstacleTrack::velocity_diffusion);
  const double wild = mean_learnt(true, 2.0, Sensor::blurred, &ObstacleTrack::velocity_diffusion);
  EXPECT_LT(calm, 0.06);
  EXPECT_NEAR(usual, 0.1, 0.03);
  EXPECT_GT(wild, 0.14);
}

TEST(ObstacleTracker, SaysHowWrongItWillBe) {
  for (const bool walk : {false, true}) {
    for (const double level : {0.25, 1.0, 2.0}) {
      for (const Sensor sensor : {Sensor::exact, Sensor::blurred}) {
        for (const int ahead : {10, 20}) {
          SCOPED_TRACE(testing::Message() << "walk " << walk << " level " << level << " sensor "
                                          << static_cast<int>(sensor) << " steps " << ahead);
          const double ratio = consistency(walk, level, sensor, ahead).ratio();
          // Measured: walk 0.8 to 1.4; white 0.15 to 0.9, since a little of the prior's random walk stays
          // believed (too careful, not too bold).
          EXPECT_LT(ratio, 1.6);
          EXPECT_GT(ratio, walk ? 0.6 : 0.1);
        }
      }
    }
  }
}

TEST(ObstacleTracker, ABounceRaisesNoProcessNoise) {
  for (const Sensor sensor : {Sensor::exact, Sensor::blurred}) {
    ObstacleTracker tracker;
    Wanderer obstacle{false, 0.25, 4, {0.9, 0.0}};
    const auto run = [&](int steps) {
      for (int k = 0; k < steps; ++k) {
        obstacle.move();
        watch(tracker, sensor == Sensor::exact ? obstacle.exact() : obstacle.blurred(0.05), obstacle.time());
      }
    };
    run(200);
    const double before = tracker.tracks().front().velocity_diffusion;
    obstacle.turn_back();
    run(20);
    EXPECT_LT(tracker.tracks().front().velocity_diffusion, 1.5 * before);
    // 2 s later the new velocity is known: to three standard deviations of the filter, or 0.3 m/s.
    EXPECT_LT((tracker.tracks().front().state.velocity_world - obstacle.velocity()).norm(), 0.4);
    EXPECT_GT(tracker.stats().changes, 0u);
  }
}

TEST(ObstacleTracker, NoticesWhenTheProcessNoiseOfAnObstacleGrows) {
  ObstacleTracker tracker;
  Wanderer obstacle{true, 0.0, 5, {0.5, 0.5}};
  for (int k = 0; k < 600; ++k) {
    if (k == 400) obstacle.set_level(2.0);
    obstacle.move();
    watch(tracker, obstacle.exact(), obstacle.time());
    if (k != 399) continue;
    EXPECT_LT(tracker.tracks().front().velocity_diffusion, 0.003);
  }
  EXPECT_GT(tracker.tracks().front().velocity_diffusion, 0.08);  // the truth is 0.2, half of it after 14 s
}

TEST(ObstacleTracker, TellsNoiseOfTheReportedVelocityFromMotion) {
  ObstacleTracker tracker;
  RandomStream random{8};
  Detection detection;
  const Eigen::Vector2d velocity{0.8, 0.0};
  for (int k = 1; k <= 400; ++k) {
    detection.position_world = 0.1 * k * velocity;
    detection.velocity_world = velocity + 0.1 * random.normal2();
    watch(tracker, detection, 0.1 * k);
  }
  const ObstacleTrack& track = tracker.tracks().front();
  EXPECT_LT(track.velocity_diffusion, 0.05);  // taken at its word it would be 0.2
  EXPECT_LT((track.state.velocity_world - velocity).norm(), 0.1);
}

TEST(ObstacleTracker, PredictsUnseenTracksThenDropsThem) {
  ObstacleTracker tracker;
  Detection detection;
  detection.id = 3;
  detection.velocity_world = Eigen::Vector2d{1.0, 0.0};
  watch(tracker, detection, 0.0);
  Observation nothing;
  nothing.time = 1.5;
  tracker.update(nothing);
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_NEAR(tracker.tracks().front().state.position_world.x(), 1.5, 1e-12);
  // Grown by the priors: 2e-3 * 1.5 + 0.1 * 1.5^3 / 3.
  EXPECT_NEAR(tracker.tracks().front().position_variance, 2e-3 * 1.5 + 0.1 * 3.375 / 3.0, 1e-6);
  nothing.time = 2.1;
  tracker.update(nothing);
  EXPECT_TRUE(tracker.tracks().empty());
  EXPECT_EQ(tracker.stats().dropped, 1u);
}

TEST(ObstacleTracker, KeepsTracksSortedAndApart) {
  ObstacleTracker tracker;
  Observation observation;
  for (const int id : {5, -2, 9, 5}) {
    Detection detection;
    detection.id = id;
    detection.position_world = {1.0 * id, 0.0};
    observation.detections.push_back(detection);
  }
  tracker.update(observation);
  ASSERT_EQ(tracker.tracks().size(), 3u);
  EXPECT_EQ(tracker.tracks()[0].id, -2);
  EXPECT_EQ(tracker.tracks()[1].id, 5);
  EXPECT_EQ(tracker.tracks()[2].id, 9);
  EXPECT_EQ(tracker.stats().stale, 1u);  // the second 5
}

TEST(ObstacleTracker, CountsMalformedDetections) {
  ObstacleTracker tracker;
  const double nan = std::nan("");
  Detection detection;
  detection.position_world = {nan, 0.0};
  watch(tracker, detection, 0.0);
  detection = {};
  detection.velocity_world = Eigen::Vector2d{std::numeric_limits<double>::infinity(), 0.0};
  watch(tracker, detection, 0.0);
  detection = {};
  detection.radius = -1.0;
  watch(tracker, detection, 0.0);
  watch(tracker, Detection{}, nan);
  EXPECT_TRUE(tracker.tracks().empty());
  EXPECT_EQ(tracker.stats().malformed, 4u);
  ObstacleTrackerParameters parameters;
  parameters.diffusion.highest_factor = nan;
  EXPECT_THROW(ObstacleTracker{parameters}, std::invalid_argument);
}

TEST(ObstacleTracker, HoldsABoundedNumberOfTracks) {
  ObstacleTracker tracker;
  const int most = static_cast<int>(kMostTracks);
  Observation observation;
  for (int id = 3 * most; id > 0; --id) observation.detections.push_back({id, {1.0, 1.0}, {}, 0.3, 0.0});
  tracker.update(observation);
  EXPECT_EQ(tracker.tracks().size(), kMostTracks);
  EXPECT_EQ(tracker.stats().crowded, 2 * kMostTracks);
  // Known obstacles are still tracked, and there is room again when a track has timed out.
  observation.time = 0.1;
  observation.detections = {{3 * most, {1.1, 1.0}, {}, 0.3, 0.0}};
  tracker.update(observation);
  EXPECT_EQ(tracker.stats().accepted, kMostTracks + 1);
  observation.time = 1000.0;
  observation.detections.clear();
  tracker.update(observation);
  EXPECT_TRUE(tracker.tracks().empty());
}

TEST(ObstacleTracker, RefusesPositionsAndSpeedsBeyondAllNumbers) {
  ObstacleTracker tracker;
  Observation observation;
  observation.detections = {{1, {1e300, 0.0}, {}, 0.3, 0.0},
                            {2, {0.0, 0.0}, Eigen::Vector2d{0.0, -1e300}, 0.3, 0.0},
                            {3, {0.0, 0.0}, {}, 1e300, 0.0},
                            {4, {0.0, 0.0}, {}, 0.3, 1e300}};
  tracker.update(observation);
  EXPECT_TRUE(tracker.tracks().empty());
  EXPECT_EQ(tracker.stats().malformed, 4u);
}

/// Diffusion that is expected of a new obstacle after some that kept a velocity [m/s] for 20 s.
double expected_after(double speed) {
  ObstacleTracker tracker;
  Observation observation;
  for (int tick = 0; tick <= 200; ++tick) {
    observation.time = 0.1 * tick;
    observation.detections.clear();
    for (int id = 0; id < 4; ++id)
      observation.detections.push_back({id, {speed * observation.time, 2.0 * id}, std::nullopt, 0.3, 0.01});
    if (tick == 200) observation.detections.push_back({9, {0.0, -5.0}, std::nullopt, 0.3, 0.01});
    tracker.update(observation);
  }
  return tracker.tracks().back().velocity_diffusion;
}

TEST(ObstacleTracker, ExpectsOfNewObstaclesWhatThoseThatMovedDid) {
  const double prior = DiffusionParameters{}.prior_velocity_diffusion;
  EXPECT_LT(expected_after(0.8), 0.5 * prior);
  EXPECT_EQ(expected_after(0.0), prior);  // what stands tells nothing of how others move
}

TEST(ObstacleTracker, ForgetsWhatItIsToldToAndKeepsTheOthers) {
  ObstacleTracker tracker;
  Observation observation;
  observation.time = 1.0;
  for (const int id : {3, 5, 9})
    observation.detections.push_back({id, {1.0 * id, 0.0}, std::nullopt, 0.3, 0.05});
  tracker.update(observation);
  tracker.forget({3, 4, 9});
  ASSERT_EQ(tracker.tracks().size(), 1U);
  EXPECT_EQ(tracker.tracks()[0].id, 5);
  EXPECT_EQ(tracker.tracks()[0].state.position_world, Eigen::Vector2d(5.0, 0.0));
  EXPECT_EQ(tracker.stats().dropped, 0U);  // none has timed out
}

/// People walk by, each seen for three seconds by positions of 1 cm alone. They hardly change their velocity,
/// but three seconds of one of them do not tell that; what they have in common does.
TEST(ObstacleTracker, LearnsFromManyWhoAreSeenForAShortTimeWhatTheNextWillBeLike) {
  ObstacleTracker tracker;
  RandomStream random{5};
  const double sigma = 0.01;
  double time = 0.0;
  const auto walk_by = [&](int id, int looks) {
    const Eigen::Vector2d velocity = 1.2 * random.normal2().normalized();
    Eigen::Vector2d position = random.normal2();
    for (int k = 0; k < looks; ++k) {
      tracker.update({time, {{id, position + sigma * random.normal2(), {}, 0.3, sigma}}, {}});
      position += 0.1 * velocity;
      time += 0.1;
    }
  };
  for (int id = 0; id < 15; ++id) walk_by(id, 30);
  walk_by(100, 1);
  const ObstacleTrack& next = tracker.tracks().back();
  ASSERT_EQ(next.id, 100);
  const DiffusionParameters prior;
  EXPECT_LT(next.velocity_diffusion, 0.35 * prior.prior_velocity_diffusion);
  EXPECT_LT(next.position_diffusion, 0.35 * prior.prior_position_diffusion);
  EXPECT_GE(next.velocity_diffusion, 0.0);
}

}  // namespace
}  // namespace spf
