#include "spf/perception/scan_perception.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>

#include "spf/perception/test/scan_scene.hpp"
#include "spf/testing/allocation_guard.hpp"

namespace spf {
namespace {

OccupancyMap empty_map() {
  return {GridFrame::covering({-12.0, -12.0}, {12.0, 12.0}, 0.1), 2.0};
}

/// A scene, its scanner and the perception of what it shows, ten times a second.
struct Watch {
  explicit Watch(bool map_scans = false) : maps{map_scans}, perception{parameters(map_scans)} {}
  static PerceptionParameters parameters(bool map_scans) {
    PerceptionParameters parameters;
    parameters.map_scans = map_scans;
    return parameters;
  }

  ScanScene scene;
  OccupancyMap map = empty_map();
  bool maps;  // enters its sweeps into the map
  std::vector<MaskedDisc> peers;
  ScanPerception perception;
  SensorSweep sweep;
  RangeScan scan;
  RandomStream random{8};
  double time = 0.0;

  void look() {
    sweep.time = time;
    scene.scan(sweep, scan, random);
    ASSERT_TRUE(perception.update(sweep, map, peers));
    if (maps) map.integrate(scan, sweep.pose_world, {}, &perception.kept_out());
    time += 0.1;
  }
  void look_for(double seconds) {
    for (double end = time + seconds; time < end - 1e-9;) look();
  }
  [[nodiscard]] Eigen::Vector2d truth(std::size_t disc) const {
    return scene.discs[disc].centre + perception.tracks()[0].time * scene.discs[disc].velocity;
  }
  /// The confirmed track nearest to a point.
  [[nodiscard]] const ScanTrack* nearest(const Eigen::Vector2d& point) const {
    const ScanTrack* best = nullptr;
    for (const ScanTrack& track : perception.tracks())
      if (track.confirmed && (!best || (track.position() - point).norm() < (best->position() - point).norm()))
        best = &track;
    return best;
  }
};

TEST(ScanPerception, FollowsOneDisc) {
  Watch watch;
  watch.scene.discs = {{{4.0, -3.0}, 0.4, {0.0, 1.0}}};
  watch.look_for(0.3);
  ASSERT_EQ(watch.perception.tracks().size(), 1U);
  EXPECT_TRUE(watch.perception.tracks()[0].confirmed);
  watch.look_for(1.7);
  ASSERT_EQ(watch.perception.tracks().size(), 1U);
  const ScanTrack& track = watch.perception.tracks()[0];
  EXPECT_TRUE(track.dynamic);
  EXPECT_LT((track.position() - watch.truth(0)).norm(), 0.04);
  EXPECT_LT((track.velocity() - watch.scene.discs[0].velocity).norm(), 0.15);
  EXPECT_NEAR(track.radius, 0.4, 0.05);
  std::vector<Detection> detections;
  watch.perception.detections(track.time, detections);
  ASSERT_EQ(detections.size(), 1U);
  EXPECT_LT((detections[0].position_world - watch.truth(0)).norm(), 0.08);
  EXPECT_FALSE(detections[0].velocity_world);
}

TEST(ScanPerception, SeesNothingWhereTheMapExplainsEverything) {
  Watch watch;
  watch.map.add_disc({3.0, 0.0}, 0.5);
  watch.map.add_box({-4.0, 2.0}, {4.0, 3.0});
  watch.scene.discs = {{{3.0, 0.0}, 0.5}, {{-3.0, -1.0}, 0.3}};
  watch.scene.walls = {{{-4.0, 2.0}, {4.0, 2.0}}};
  watch.peers = {{{-3.0, -1.05}, 0.5}};
  watch.look_for(2.0);
  EXPECT_TRUE(watch.perception.tracks().empty());
  EXPECT_EQ(watch.perception.tracker_stats().confirmed, 0U);
}

TEST(ScanPerception, SeesAPersonBeforeAWall) {
  Watch watch;
  watch.map.add_box({-8.0, 3.0}, {8.0, 4.0});
  watch.scene.walls = {{{-8.0, 3.0}, {8.0, 3.0}}};
  watch.scene.discs = {{{-2.0, 2.7}, 0.25, {0.8, 0.0}}};  // 5 cm before it
  watch.look_for(3.0);
  const ScanTrack* track = watch.nearest(watch.truth(0));
  ASSERT_NE(track, nullptr);
  EXPECT_LT((track->position() - watch.truth(0)).norm(), 0.08);
  EXPECT_EQ(watch.perception.tracker_stats().confirmed, 1U);
}

TEST(ScanPerception, KeepsTheNumberOfWhatPassesBehindAPillar) {
  Watch watch;
  watch.map.add_disc({2.0, 0.0}, 0.5);
  watch.scene.discs = {{{4.0, -2.5}, 0.3, {0.0, 1.0}}, {{2.0, 0.0}, 0.5}};
  watch.look_for(1.0);
  ASSERT_EQ(watch.perception.tracks().size(), 1U);
  const int id = watch.perception.tracks()[0].id;
  bool hidden = false;
  for (int k = 0; k < 40; ++k) {
    watch.look();
    ASSERT_FALSE(watch.perception.tracks().empty()) << "lost at " << watch.time;
    hidden = hidden || watch.perception.tracks()[0].sight == ScanTrack::Sight::hidden;
  }
  EXPECT_TRUE(hidden);
  ASSERT_EQ(watch.perception.tracks().size(), 1U);
  EXPECT_EQ(watch.perception.tracks()[0].id, id);
  EXPECT_LT((watch.perception.tracks()[0].position() - watch.truth(0)).norm(), 0.06);
}

TEST(ScanPerception, KeepsTheNumbersOfTwoThatCross) {
  Watch watch;
  watch.scene.discs = {{{3.0, -2.0}, 0.3, {0.0, 0.8}}, {{4.0, 2.0}, 0.3, {0.0, -0.8}}};
  watch.look_for(1.0);
  ASSERT_EQ(watch.perception.tracks().size(), 2U);
  const int near = watch.nearest(watch.truth(0))->id;
  const int far = watch.nearest(watch.truth(1))->id;
  watch.look_for(3.5);
  ASSERT_EQ(watch.perception.tracks().size(), 2U);
  EXPECT_EQ(watch.nearest(watch.truth(0))->id, near);
  EXPECT_EQ(watch.nearest(watch.truth(1))->id, far);
}

TEST(ScanPerception, EndsTheTrackOfWhatHasGone) {
  Watch watch;
  watch.scene.discs = {{{3.0, 0.0}, 0.3}};
  watch.look_for(1.0);
  ASSERT_EQ(watch.perception.tracks().size(), 1U);
  watch.scene.discs.clear();
  watch.look_for(0.5);
  EXPECT_TRUE(watch.perception.tracks().empty());
  EXPECT_EQ(watch.perception.tracker_stats().missed, 1U);
}

TEST(ScanPerception, TakesTwoLegsForOnePerson) {
  Watch watch;
  watch.scene.discs = {{{2.0, -1.5}, 0.06, {0.0, 0.9}}, {{2.0, -1.15}, 0.06, {0.0, 0.9}}};
  watch.look_for(2.0);
  ASSERT_EQ(watch.perception.tracks().size(), 1U);
  const ScanTrack& track = watch.perception.tracks()[0];
  EXPECT_TRUE(track.dynamic);
  EXPECT_LT((track.position() - 0.5 * (watch.truth(0) + watch.truth(1))).norm(), 0.08);
  EXPECT_GT(track.radius, 0.2);
}

TEST(ScanPerception, FollowsAWideFlatFrontThatComesNearer) {
  Watch watch{true};
  watch.scene.walls = {{{6.0, -1.2}, {6.0, 1.2}}};
  for (int k = 0; k < 30; ++k) {
    watch.scene.walls = {{{6.0 - 0.1 * k, -1.2}, {6.0 - 0.1 * k, 1.2}}};
    watch.look();
    if (k < 8) continue;
    // Every return of it belongs to something that is known to move.
    for (const double y : {-1.0, 0.0, 1.0}) {
      const Eigen::Vector2d position{6.0 - 0.1 * k, y};
      const bool covered = std::any_of(
          watch.perception.tracks().begin(), watch.perception.tracks().end(), [&](const ScanTrack& track) {
            return track.dynamic && (track.position() - position).norm() < track.radius + 0.1;
          });
      EXPECT_TRUE(covered) << "sweep " << k << ", y " << y;
    }
  }
  for (const ScanTrack& track : watch.perception.tracks())
    if (track.confirmed) {
      EXPECT_NEAR(track.velocity().x(), -1.0, 0.2);
    }
}

TEST(ScanPerception, LeavesToTheMapWhatNeverMoves) {
  Watch watch{true};
  watch.scene.walls = {{{-5.0, 3.0}, {5.0, 3.0}}, {{3.0, -5.0}, {3.0, 3.0}}};
  watch.scene.discs = {{{-2.0, 0.5}, 0.3}};
  watch.look_for(2.5);
  EXPECT_TRUE(watch.perception.tracks().empty());
  EXPECT_LT(watch.map.distance({0.0, 3.0}), 0.1);
  EXPECT_LT(watch.map.distance({-1.7, 0.5}), 0.1);
}

TEST(ScanPerception, KeepsOutOfTheMapWhatHasStoppedAndKnowsItAgain) {
  Watch watch{true};
  watch.scene.walls = {{{-7.0, 4.0}, {7.0, 4.0}}};
  watch.scene.discs = {{{3.0, -2.0}, 0.3, {0.0, 1.0}}};
  watch.look_for(2.0);
  const Eigen::Vector2d stop = watch.truth(0);
  const ScanTrack* track = watch.nearest(stop);
  ASSERT_NE(track, nullptr);
  const int id = track->id;
  const SceneDisc disc = watch.scene.discs[0];
  watch.scene.discs[0] = {stop, 0.3};
  watch.look_for(4.0);
  track = watch.nearest(stop);
  ASSERT_NE(track, nullptr);
  EXPECT_EQ(track->id, id);
  EXPECT_LT(track->velocity().norm(), 0.1);
  EXPECT_GT(watch.map.distance(stop - Eigen::Vector2d{0.3, 0.0}), 0.15);  // its front is not in the map
  watch.scene.discs[0] = {stop - watch.time * disc.velocity, 0.3, disc.velocity};
  watch.look_for(1.0);
  track = watch.nearest(watch.truth(0));
  ASSERT_NE(track, nullptr);
  EXPECT_EQ(track->id, id);
}

TEST(ScanPerception, LeavesToTheMapWhatHasStoppedWhereOthersTellOfPeople) {
  Watch watch{true};
  PerceptionParameters parameters = Watch::parameters(true);
  parameters.moving_alone = true;
  watch.perception = ScanPerception{parameters};
  watch.scene.walls = {{{-7.0, 4.0}, {7.0, 4.0}}};
  watch.scene.discs = {{{3.0, -2.0}, 0.3, {0.0, 1.0}}};
  watch.look_for(2.0);
  const Eigen::Vector2d stop = watch.truth(0);
  const auto reported = [&] {
    std::vector<Detection> detections;
    watch.perception.detections(watch.time, detections);
    return detections.size();
  };
  EXPECT_EQ(reported(), 1U);
  const SceneDisc disc = watch.scene.discs[0];
  watch.scene.discs[0] = {stop, 0.3};
  watch.look_for(2.0);
  EXPECT_EQ(reported(), 1U);
  watch.look_for(3.0);
  EXPECT_EQ(reported(), 0U);
  EXPECT_LT(watch.map.distance(stop - Eigen::Vector2d{0.3, 0.0}), 0.1);
  watch.scene.discs[0] = {stop - watch.time * disc.velocity, 0.3, disc.velocity};
  watch.look_for(0.8);
  EXPECT_EQ(reported(), 1U);
}

/// Pillars that hide each other: which parts of them show changes as the scanner moves, but nothing moves.
TEST(ScanPerception, TakesNothingForMovingAmongPillars) {
  RandomStream random{5};
  for (int scene = 0; scene < 10; ++scene) {
    Watch watch{true};
    PerceptionParameters parameters = Watch::parameters(true);
    parameters.moving_alone = true;
    watch.perception = ScanPerception{parameters};
    for (int k = 0; k < 30; ++k)
      watch.scene.discs.push_back(
          {{random.uniform(-4.0, 4.0), random.uniform(-1.0, 6.0)}, random.uniform(0.1, 0.3)});
    watch.sweep.pose_world = {{0.0, -3.0}, 0.0};
    int moving = 0;
    for (int k = 0; k < 60; ++k) {
      watch.sweep.pose_world.position_world.x() = 2.0 * std::sin(0.1 * k);
      watch.look();
      for (const ScanTrack& track : watch.perception.tracks()) moving += track.dynamic ? 1 : 0;
    }
    EXPECT_EQ(moving, 0) << scene;
  }
}

TEST(ScanPerception, SeesStraightWhileItTurnsAndDrives) {
  Watch watch;
  watch.map.add_box({-8.0, 3.0}, {8.0, 4.0});
  watch.scene.walls = {{{-8.0, 3.0}, {8.0, 3.0}}};
  watch.scene.discs = {{{3.0, -1.0}, 0.3, {0.0, 0.5}}};
  watch.sweep.duration = 0.1;
  watch.sweep.yaw_rate = 2.0;
  watch.sweep.velocity_world = {0.5, 0.0};
  for (int k = 0; k < 30; ++k) {
    watch.sweep.pose_world.position_world = watch.time * watch.sweep.velocity_world;
    watch.sweep.pose_world.heading = wrap_angle(watch.time * watch.sweep.yaw_rate);
    watch.look();
  }
  ASSERT_EQ(watch.perception.tracks().size(), 1U);
  const ScanTrack& track = watch.perception.tracks()[0];
  EXPECT_LT((track.position() - watch.truth(0)).norm(), 0.05);
  EXPECT_LT((track.velocity() - watch.scene.discs[0].velocity).norm(), 0.15);
  EXPECT_EQ(watch.perception.tracker_stats().confirmed, 1U);
}

TEST(ScanPerception, LosesNoReturnBetweenMapAndTracks) {
  Watch watch{true};
  RandomStream random{31};
  for (int k = 0; k < 12; ++k)
    watch.scene.discs.push_back({3.5 * random.normal2(), random.uniform(0.1, 0.6), 0.7 * random.normal2()});
  watch.scene.walls = {{{-7.0, 5.0}, {7.0, 5.0}}};
  for (int k = 0; k < 60; ++k) {
    const OccupancyMap before = watch.map;
    watch.look();
    std::vector<ScanReturn> returns;
    collect_returns(watch.sweep, returns);
    for (const ScanReturn& one : returns) {
      if (before.distance(one.position_world) < 0.15) continue;
      if (watch.perception.kept_out()[static_cast<std::size_t>(one.beam)] == 0) continue;
      const bool followed = std::any_of(
          watch.perception.tracks().begin(), watch.perception.tracks().end(), [&](const ScanTrack& track) {
            return (track.position() - one.position_world).norm() < track.radius + 0.3;
          });
      EXPECT_TRUE(followed) << "sweep " << k << ", beam " << one.beam;
    }
  }
}

TEST(ScanPerception, AllocatesNothingOnceItHasSeenTheScene) {
  Watch watch;
  RandomStream random{17};
  for (int k = 0; k < 20; ++k) {
    const double bearing = 0.314 * k;
    watch.scene.discs.push_back({(2.0 + 0.25 * k) * Eigen::Vector2d{std::cos(bearing), std::sin(bearing)},
                                 0.3, 0.5 * random.normal2()});
  }
  watch.look_for(2.0);
  std::vector<RangeScan> scans(10);
  for (RangeScan& scan : scans) {
    watch.sweep.time = watch.time;
    watch.scene.scan(watch.sweep, scan, watch.random);
    watch.time += 0.1;
  }
  std::vector<Detection> detections;
  detections.reserve(100);
  const AllocationGuard guard;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    watch.sweep.scan = &scans[k];
    watch.sweep.time = watch.time + 0.1 * static_cast<double>(k) - 1.0;
    ASSERT_TRUE(watch.perception.update(watch.sweep, watch.map, {}));
    watch.perception.detections(watch.time, detections);
  }
  EXPECT_EQ(guard.allocations(), 0);
  EXPECT_GE(watch.perception.tracks().size(), 10U);
}

TEST(ScanPerception, SurvivesWhateverAScanMayHold) {
  RandomStream random{77};
  const OccupancyMap map = empty_map();
  const std::vector<double> nasty{0.0,
                                  -1.0,
                                  std::numeric_limits<double>::quiet_NaN(),
                                  std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity(),
                                  1e300,
                                  1e-300,
                                  1e18,
                                  5.0};
  const auto nasty_number = [&] {
    return nasty[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(nasty.size())))];
  };
  ScanPerception perception;
  for (int round = 0; round < 300; ++round) {
    RangeScan scan;
    scan.angle_min = random.uniform() < 0.2 ? nasty_number() : -kPi;
    scan.angle_increment = random.uniform() < 0.2 ? nasty_number() : 2.0 * kPi / 360;
    scan.max_range = random.uniform() < 0.2 ? nasty_number() : 8.0;
    for (int k = 0; k < 360; ++k)
      scan.ranges.push_back(random.uniform() < 0.3 ? nasty_number() : random.uniform(0.0, 9.0));
    SensorSweep sweep;
    sweep.scan = &scan;
    sweep.time = 0.1 * round;
    if (random.uniform() < 0.2) sweep.pose_world.position_world.x() = nasty_number();
    if (random.uniform() < 0.2) sweep.yaw_rate = nasty_number();
    if (random.uniform() < 0.2) sweep.duration = nasty_number();
    static_cast<void>(perception.update(sweep, map, {{{nasty_number(), 0.0}, nasty_number()}}));
    for (const ScanTrack& track : perception.tracks()) {
      EXPECT_TRUE(track.state.allFinite());
      EXPECT_TRUE(track.covariance.allFinite());
      EXPECT_TRUE(std::isfinite(track.radius));
    }
  }
  EXPECT_GT(perception.stats().sweeps, 50U);
}

TEST(ScanPerception, EndsInBoundedTimeOnTheLargestScanOfNothingButEdges) {
  RandomStream random{78};
  const OccupancyMap map = empty_map();
  ScanPerception perception;
  RangeScan scan;
  scan.angle_min = -kPi;
  scan.angle_increment = 2.0 * kPi / static_cast<double>(kMostBeams);
  for (std::size_t k = 0; k < kMostBeams; ++k) scan.ranges.push_back(random.uniform(0.5, 8.0));
  SensorSweep sweep;
  sweep.scan = &scan;
  const auto started = std::chrono::steady_clock::now();
  for (int k = 0; k < 3; ++k) {
    sweep.time = 0.1 * k;
    ASSERT_TRUE(perception.update(sweep, map, {}));
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - started;
  EXPECT_LT(taken.count(), 6.0);  // [s]; takes a small part of it, sanitizers and busy machines included
}

}  // namespace
}  // namespace spf
