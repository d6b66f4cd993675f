#include "spf/perception/segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "spf/perception/test/scan_scene.hpp"

namespace spf {
namespace {

using Beams = std::set<int>;

std::set<Beams> beams_of(const Segmentation& segmentation) {
  std::set<Beams> all;
  for (const Segment& segment : segmentation.segments()) {
    Beams beams;
    for (int k = 0; k < segment.count; ++k)
      beams.insert(segmentation.returns()[static_cast<std::size_t>(segment.first + k)].beam);
    all.insert(beams);
  }
  return all;
}

/// Joins whatever pairs of returns hang together, among all pairs, until nothing changes.
std::set<Beams> brute_force(const SensorSweep& sweep, const std::vector<ScanReturn>& returns,
                            const PerceptionParameters& parameters) {
  std::vector<std::size_t> group(returns.size());
  for (std::size_t k = 0; k < group.size(); ++k) group[k] = k;
  const int count = sweep.beams();
  for (std::size_t a = 0; a < returns.size(); ++a) {
    for (std::size_t b = 0; b < returns.size(); ++b) {
      if (a == b) continue;
      const int steps = ((returns[b].beam - returns[a].beam) % count + count) % count;
      const bool over_the_seam = returns[b].beam < returns[a].beam;
      if (steps > 3 || (over_the_seam && !sweep.closed())) continue;
      const bool neighbours = std::none_of(returns.begin(), returns.end(), [&](const ScanReturn& between) {
        const int offset = ((between.beam - returns[a].beam) % count + count) % count;
        return offset > 0 && offset < steps;
      });
      const double limit = Segmentation::link_distance(
          parameters, std::min(returns[a].range, returns[b].range), steps * sweep.scan->angle_increment);
      if (!neighbours || (returns[a].position_world - returns[b].position_world).norm() >= limit) continue;
      const std::size_t from = group[b];
      for (std::size_t& one : group)
        if (one == from) one = group[a];
    }
  }
  std::map<std::size_t, Beams> members;
  for (std::size_t k = 0; k < returns.size(); ++k) members[group[k]].insert(returns[k].beam);
  std::set<Beams> all;
  for (const auto& [root, beams] : members) all.insert(beams);
  return all;
}

TEST(Segmentation, PartsReturnsAsJoiningAllPairsDoes) {
  RandomStream random{21};
  PerceptionParameters parameters;
  parameters.split_depth = 9.0;  // dents are for another test
  Segmentation segmentation{parameters};
  std::vector<ScanReturn> returns;
  for (int round = 0; round < 60; ++round) {
    ScanScene scene;
    scene.beams = 180;
    scene.field_of_view = round % 2 == 0 ? 2.0 * kPi : 1.5 * kPi;
    for (int k = 0; k < 8; ++k) scene.discs.push_back({5.0 * random.normal2(), random.uniform(0.1, 0.6)});
    scene.walls.push_back({6.0 * random.normal2(), 6.0 * random.normal2()});
    SensorSweep sweep;
    sweep.pose_world.heading = random.uniform(-3.0, 3.0);
    RangeScan scan;
    scene.scan(sweep, scan, random);
    for (double& range : scan.ranges)
      if (random.uniform() < 0.1) range = std::numeric_limits<double>::quiet_NaN();
    collect_returns(sweep, returns);
    segmentation.run(sweep, returns, std::vector<std::uint8_t>(returns.size(), 0));
    ASSERT_EQ(beams_of(segmentation), brute_force(sweep, returns, parameters)) << "round " << round;
  }
}

struct Lone {
  RangeScan scan;
  SensorSweep sweep;
  Segmentation segmentation{PerceptionParameters{}};
  std::vector<ScanReturn> returns;

  explicit Lone(const ScanScene& scene) {
    RandomStream random{4};
    scene.scan(sweep, scan, random);
    collect_returns(sweep, returns);
    segmentation.run(sweep, returns, std::vector<std::uint8_t>(returns.size(), 0));
  }
};

TEST(Segmentation, JoinsWhatTheSeamCuts) {
  ScanScene scene;
  scene.discs = {{{-3.0, 0.0}, 0.4}};  // the seam is straight behind
  const Lone lone{scene};
  ASSERT_EQ(lone.segmentation.segments().size(), 1U);
  EXPECT_EQ(lone.segmentation.segments()[0].first_edge, SegmentEdge::free);
  EXPECT_EQ(lone.segmentation.segments()[0].last_edge, SegmentEdge::free);
  EXPECT_GT(lone.segmentation.returns().front().beam, lone.segmentation.returns().back().beam);
}

TEST(Segmentation, KnowsOutlinesFromWhatIsHidden) {
  ScanScene scene;
  scene.discs = {{{3.0, 0.0}, 0.4}, {{5.0, 0.5}, 0.4}};  // the second looks out to the left
  const Lone lone{scene};
  ASSERT_EQ(lone.segmentation.segments().size(), 2U);
  EXPECT_EQ(lone.segmentation.segments()[0].last_edge, SegmentEdge::free);
  EXPECT_EQ(lone.segmentation.segments()[1].first_edge, SegmentEdge::occluded);
  EXPECT_EQ(lone.segmentation.segments()[1].last_edge, SegmentEdge::free);
}

TEST(Segmentation, PartsTwoThatTouch) {
  ScanScene scene;
  scene.discs = {{{3.0, 0.4}, 0.4}, {{3.0, -0.4}, 0.4}};
  const Lone lone{scene};
  ASSERT_EQ(lone.segmentation.segments().size(), 2U);
  for (const Segment& segment : lone.segmentation.segments())
    for (int k = 0; k < segment.count; ++k) {
      const ScanReturn& one = lone.segmentation.returns()[static_cast<std::size_t>(segment.first + k)];
      const double side = segment.first == 0 ? -1.0 : 1.0;
      EXPECT_GT(side * one.position_world.y(), -0.03);
    }
}

TEST(Segmentation, BridgesBeamsThatWereLost) {
  ScanScene scene;
  scene.discs = {{{2.0, 0.0}, 0.4}};
  Lone lone{scene};
  const std::size_t middle = 360;
  lone.scan.ranges[middle] = std::numeric_limits<double>::infinity();
  lone.scan.ranges[middle + 1] = 0.0;
  collect_returns(lone.sweep, lone.returns);
  lone.segmentation.run(lone.sweep, lone.returns, std::vector<std::uint8_t>(lone.returns.size(), 0));
  EXPECT_EQ(lone.segmentation.segments().size(), 1U);
}

}  // namespace
}  // namespace spf
