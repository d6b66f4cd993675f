#include "experiments/replay_export.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "report/replay_page.hpp"

namespace spf {
namespace {

struct Exported {
  RunConfiguration config;
  FinishedTrial trial;
  ReplayData data;
};

Exported exported(const std::string& scene) {
  Exported result{run_configuration_from_text("family: explicit\n" + scene, "scene.yaml"), {}, {}};
  TrialOptions options;
  options.record = true;
  double seconds = 0.0;
  options.clock = [&seconds] { return seconds += 1e-6; };
  result.trial = run_trial(cell_of(result.config), 0, options);
  result.data = replay_data(result.config, result.trial);
  return result;
}

constexpr const char* kScene =
    "robots: [{start: [0, 0], goal: [3, 0]}, {start: [3, 2], goal: [0, 2]}]\n"
    "boxes: [{low: [1, 0.8], high: [1.5, 1.1]}]\n"
    "discs: [{center: [2, -1.5], radius: 0.3}]\n"
    "walls: [{from: [-1, -2], to: [0, -3]}, {from: [1, -3], to: [3, -3]}]\n"
    "moving: [{position: [4, 4], velocity: [-0.2, 0], radius: 0.35}]\n"
    "sensing: {map: sensed}\n";

TEST(ReplayExport, KeepsTheTruthOfEveryFrame) {
  const auto [config, trial, data] = exported(kScene);
  EXPECT_NO_THROW(require_consistent(data));
  const sim::Recording& recording = *trial.recording;
  ASSERT_EQ(data.robots.size(), 2u);
  ASSERT_EQ(data.obstacles.size(), 1u);
  ASSERT_EQ(frame_count(data), recording.frames.size());
  for (std::size_t k = 0; k < recording.frames.size(); ++k) {
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(data.robots[i].frames[k].pose.x, recording.frames[k].robots[i].pose.position_world.x());
      EXPECT_EQ(data.robots[i].frames[k].pose.heading, recording.frames[k].robots[i].pose.heading);
    }
    EXPECT_EQ(data.obstacles[0].frames[k].position.x,
              recording.frames[k].dynamic_obstacles[0].state.position_world.x());
  }
  EXPECT_EQ(data.robots[1].goal.y, 2.0);
  EXPECT_EQ(data.outcome, enum_name(trial.record.outcome));
}

// The outline must hold the obstacle, grown by the robot, now and after the stretch time.
TEST(ReplayExport, OutlinesTheFieldAroundTheObstacle) {
  const auto [config, trial, data] = exported(kScene);
  const ReplayObstacle& obstacle = data.obstacles[0];
  EXPECT_EQ(obstacle.radius, 0.35);
  for (const ReplayObstacleFrame& frame : obstacle.frames) {
    EXPECT_GE(frame.field.half_axis_long, frame.field.half_axis_short);
    EXPECT_GE(frame.field.half_axis_short, obstacle.radius + config.robot.radius - 1e-9);  // rounding
    const double ahead = (frame.field.center.x - frame.position.x) * frame.velocity.x +
                         (frame.field.center.y - frame.position.y) * frame.velocity.y;
    EXPECT_GE(ahead, 0.0);
  }
}

TEST(ReplayExport, DrawsEverythingThatStandsStill) {
  const auto [config, trial, data] = exported(kScene);
  ASSERT_EQ(data.shapes.discs.size(), 1u);
  EXPECT_EQ(data.shapes.discs[0].radius, 0.3);
  ASSERT_GE(data.shapes.boxes.size(), 3u);  // the box, the slanted wall in pieces, the straight wall in one
  for (const ReplayBox& box : data.shapes.boxes) {
    EXPECT_LT(box.low.x, box.high.x);
    EXPECT_LT(box.low.y, box.high.y);
  }
  EXPECT_LT(data.bounds.low.x, -1.0);
  EXPECT_GT(data.bounds.high.y, 4.0);
}

TEST(ReplayExport, DrawsPolygonsAndTheCellsOfAMap) {
  const std::string picture = testing::TempDir() + "spf_replay_map.pgm";
  {
    std::ofstream file{picture};
    file << "P2 80 60 255\n";
    for (int row = 0; row < 60; ++row)
      for (int column = 0; column < 80; ++column) file << (row > 20 && row < 24 ? "0 " : "255 ");
  }
  const auto [config, trial, data] =
      exported("robots: [{start: [0, 0], goal: [3, 0]}]\nmap: \"" + picture +
               "\"\nmap_settings: {image_resolution: 0.1, image_origin: [-1, -1], image_heading: 0.1}\n"
               "polygons: [{corners: [[1, 1], [2, 1], [1.5, 1.8]]}]\n");
  ASSERT_EQ(data.shapes.polygons.size(), 1u);
  EXPECT_EQ(data.shapes.polygons[0][2].y, 1.8);
  ASSERT_EQ(data.shapes.blocks.size(), 1u);  // a bar of three rows, 8 m long
  const auto& [a, b, c, d] = data.shapes.blocks[0];
  EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y), 8.0, 1e-9);
  EXPECT_NEAR(std::hypot(d.x - a.x, d.y - a.y), 0.3, 1e-9);
  EXPECT_NEAR(std::atan2(c.y - d.y, c.x - d.x), 0.1, 1e-9);
  EXPECT_LT(data.bounds.low.x, -1.0);  // around all of the map, which is turned
  EXPECT_NEAR(data.bounds.low.y, -1.0, 1e-9);
  std::filesystem::remove(picture);
}

TEST(ReplayExport, ShowsPlansTimesAndMaps) {
  const auto [config, trial, data] = exported(kScene);
  for (const ReplayRobot& robot : data.robots) {
    ASSERT_FALSE(robot.plans.empty());
    EXPECT_GT(robot.plans.front().planning_time, 0.0);
    EXPECT_FALSE(robot.plans.front().candidates.empty());
    EXPECT_FALSE(robot.cells.empty());  // the map is sensed
    EXPECT_EQ(robot.wheel_speed_limit, config.robot.max_wheel_speed);
    for (std::size_t k = 1; k < robot.plans.size(); ++k)
      EXPECT_GE(robot.plans[k].time, robot.plans[k - 1].time);
  }
  // A cell is centred on its node: the first cell seen of robot 0 lies at something that stands there.
  const ReplayRobot& robot = data.robots[0];
  const ReplayCell cell = robot.cells.front().added.front();
  const Eigen::Vector2d middle{robot.cell_origin.x + (cell.x + 0.5) * robot.cell_size,
                               robot.cell_origin.y + (cell.y + 0.5) * robot.cell_size};
  const Eigen::Vector2d node = trial.recording->map_frame.node_position(cell.x, cell.y);
  EXPECT_LT((middle - node).norm(), 1e-9);  // rounding
}

TEST(ReplayExport, MarksContactsAndArrivals) {
  const Exported good = exported(kScene);
  int arrivals = 0;
  for (const ReplayEvent& event : good.data.events)
    arrivals += event.kind == ReplayEventKind::arrival ? 1 : 0;
  EXPECT_EQ(arrivals, 2);
  EXPECT_TRUE(good.data.success);

  const Exported bad = exported(
      "robots: [{start: [0, 0], goal: [9, 0]}]\nborder: {low: [-1, -1], high: [10, 1]}\n"
      "moving: [{position: [8, 0], velocity: [-3, 0], radius: 0.9}]\n");
  EXPECT_FALSE(bad.data.success);
  ASSERT_FALSE(bad.data.events.empty());
  const ReplayEvent& last = bad.data.events.back();
  EXPECT_EQ(last.kind, ReplayEventKind::contact);
  EXPECT_EQ(last.other, "disc 0");
  EXPECT_EQ(last.robot, 0);
  EXPECT_TRUE(last.position.has_value());
}

TEST(ReplayExport, RendersToAPage) {
  const std::string page = render_replay(exported(kScene).data);
  EXPECT_EQ(page.rfind("<!", 0), 0u);
  EXPECT_GT(page.size(), 20000u);
}

}  // namespace
}  // namespace spf
