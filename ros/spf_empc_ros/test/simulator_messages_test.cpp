#include "spf_empc_ros/simulator_messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/families.hpp"
#include "sim/geometry.hpp"
#include "spf_empc_ros/conversions.hpp"

namespace spf_empc_ros {
namespace {

using spf::sim::Scenario;
using spf::sim::World;

const Stamp kStamp{"map", ros::Time{7, 250000000}};

Scenario scenario_with_shapes() {
  Scenario scenario;
  scenario.border = spf::sim::Box{{-4.0, -3.0}, {6.0, 3.0}};
  scenario.boxes = {{{0.02, 0.01}, {1.03, 0.98}}};
  scenario.discs = {{{-2.0, 1.0}, 0.4}};
  scenario.walls = {{{2.0, -2.0}, {5.0, -1.0}}};
  spf::sim::RobotTask task;
  task.start = {{-3.0, -2.0}, 0.4};
  task.goal_world = {5.0, 2.0};
  scenario.robots = {task};
  return scenario;
}

bool occupied_at(const nav_msgs::OccupancyGrid& grid, const Eigen::Vector2d& position) {
  const auto i =
      static_cast<std::size_t>((position.x() - grid.info.origin.position.x) / grid.info.resolution);
  const auto j =
      static_cast<std::size_t>((position.y() - grid.info.origin.position.y) / grid.info.resolution);
  return grid.data.at(j * grid.info.width + i) >= 50;
}

TEST(MapMessage, ShowsTheKnownShapesToHalfACell) {
  const Scenario scenario = scenario_with_shapes();
  const nav_msgs::OccupancyGrid grid = map_message(scenario, 0.05, kStamp);
  EXPECT_EQ(grid.header.frame_id, "map");
  EXPECT_EQ(grid.info.width, 200U);
  EXPECT_EQ(grid.info.height, 120U);
  EXPECT_EQ(grid.data.size(), 200U * 120U);
  EXPECT_TRUE(occupied_at(grid, {0.5, 0.5}));
  EXPECT_TRUE(occupied_at(grid, {-2.0, 1.37}));
  EXPECT_FALSE(occupied_at(grid, {-2.0, 1.46}));
  EXPECT_FALSE(occupied_at(grid, {1.1, 0.5}));
  for (double share = 0.0; share <= 1.0; share += 0.001)  // no hole in a thin wall
    EXPECT_TRUE(
        occupied_at(grid, scenario.walls[0].from + share * (scenario.walls[0].to - scenario.walls[0].from)));
}

TEST(MapMessage, GivesARobotTheDistancesOfTheTruth) {
  const Scenario scenario = scenario_with_shapes();
  const auto map = from_message(map_message(scenario, 0.05, kStamp), "map", {});
  ASSERT_TRUE(map) << map.refusal;
  for (const Eigen::Vector2d& position :
       {Eigen::Vector2d{-0.5, 0.5}, {1.6, 0.5}, {-2.0, 0.0}, {-3.5, -2.0}, {3.5, -0.9}, {0.5, 1.9}}) {
    double truth = std::min({spf::sim::depth_inside(position, *scenario.border),
                             spf::sim::distance_to_box(position, scenario.boxes[0]),
                             (position - scenario.discs[0].center).norm() - scenario.discs[0].radius,
                             spf::distance_to_segment(position, scenario.walls[0])});
    truth = std::min(truth, map->max_distance());
    // A cell's corner stands out by at most its half diagonal, a wall's cells by one more.
    EXPECT_NEAR(map->distance(position), truth, 0.05 * 1.5) << position.transpose();
  }
}

TEST(MapMessage, IsOnlyTheBorderWhenTheMapIsToBeSensed) {
  Scenario scenario = scenario_with_shapes();
  scenario.simulation.sensing.map = spf::sim::MapKnowledge::sensed;
  const nav_msgs::OccupancyGrid grid = map_message(scenario, 0.05, kStamp);
  EXPECT_EQ(std::count(grid.data.begin(), grid.data.end(), 0), static_cast<long>(grid.data.size()));
}

TEST(MapMessage, HasRoomAroundAnOpenScenario) {
  Scenario scenario = scenario_with_shapes();
  scenario.border.reset();
  const nav_msgs::OccupancyGrid grid = map_message(scenario, 0.1, kStamp);
  EXPECT_LT(grid.info.origin.position.x, -10.0);
  EXPECT_GT(grid.info.origin.position.x + 0.1 * grid.info.width, 12.0);
  EXPECT_TRUE(occupied_at(grid, {0.5, 0.5}));
}

TEST(OdometryMessage, CarriesPoseBodyMotionAndNoise) {
  Scenario scenario = scenario_with_shapes();
  scenario.simulation.pose_noise.position_sigma = 0.02;
  scenario.simulation.pose_noise.heading_sigma = 0.01;
  World world{scenario};
  const Eigen::Vector3d twist{0.3, 0.1, 0.0};
  world.command(0, world.plant(0).drive().input_for({0.3, 0.1, 0.0}));
  for (int i = 0; i < 400; ++i) {
    world.begin_tick();
    world.end_tick();
  }
  const spf::Pose2 measured{{1.25, -0.5}, -2.0};
  const nav_msgs::Odometry message = odometry_message(world, 0, measured, kStamp);
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp, kStamp.time);
  EXPECT_EQ(message.child_frame_id, "robot0/base_link");
  const auto pose = from_message(message.pose.pose);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->position_world, measured.position_world);
  EXPECT_NEAR(pose->heading, measured.heading, 1e-12);
  EXPECT_NEAR(message.twist.twist.linear.x, twist.x(), 1e-3);
  EXPECT_NEAR(message.twist.twist.linear.y, twist.y(), 1e-3);
  EXPECT_NEAR(message.pose.covariance[0], 4e-4, 1e-12);
  EXPECT_NEAR(message.pose.covariance[7], 4e-4, 1e-12);
  EXPECT_NEAR(message.pose.covariance[35], 1e-4, 1e-12);
}

TEST(ObstaclesMessage, ComesBackAsTheDetectionsItWasMadeOf) {
  spf::Detection exact;
  exact.id = 3;
  exact.position_world = {1.0, -2.0};
  exact.velocity_world = Eigen::Vector2d{0.5, 0.25};
  exact.radius = 0.4;
  spf::Detection noisy = exact;
  noisy.id = 4;
  noisy.velocity_world.reset();
  noisy.position_sigma = 0.05;
  const auto back = from_message(obstacles_message({exact, noisy}, kStamp), spf::Pose2{});
  ASSERT_TRUE(back) << back.refusal;
  ASSERT_EQ(back->size(), 2U);
  EXPECT_EQ((*back)[0].id, 3);
  EXPECT_EQ((*back)[0].position_world, exact.position_world);
  EXPECT_EQ((*back)[0].velocity_world, exact.velocity_world);
  EXPECT_EQ((*back)[0].radius, 0.4);
  EXPECT_EQ((*back)[0].position_sigma, 0.0);
  EXPECT_FALSE((*back)[1].velocity_world);
  EXPECT_NEAR((*back)[1].position_sigma, 0.05, 1e-12);
}

TEST(GoalMessage, KeepsTheHeadingWhereAnyWillDo) {
  Scenario scenario = scenario_with_shapes();
  const auto any = from_message(goal_message(scenario.robots[0], kStamp).pose);
  EXPECT_EQ(any->position_world, scenario.robots[0].goal_world);
  EXPECT_NEAR(any->heading, 0.4, 1e-12);
  scenario.robots[0].goal_heading = -1.0;
  EXPECT_NEAR(from_message(goal_message(scenario.robots[0], kStamp).pose)->heading, -1.0, 1e-12);
}

TEST(OutcomeMessage, TellsHowATrialStandsAndEnds) {
  using Message = spf_empc_msgs::TrialOutcome;
  spf::sim::TrialResult result;
  result.robots.resize(2);
  result.robots[0].arrived = true;
  result.robots[0].travel_time = 12.5;
  Message message = outcome_message(result, false, kStamp);
  EXPECT_EQ(message.outcome, Message::RUNNING);
  EXPECT_EQ(message.arrived, 1U);
  EXPECT_EQ(message.arrival_times, (std::vector<double>{12.5, -1.0}));
  message = outcome_message(result, true, kStamp);
  EXPECT_EQ(message.outcome, Message::TIMEOUT);
  EXPECT_NE(message.cause.find("robots 1"), std::string::npos) << message.cause;
  result.outcome = spf::sim::TrialOutcome::success;
  EXPECT_EQ(outcome_message(result, true, kStamp).outcome, Message::SUCCESS);
  spf::sim::Contact contact;
  contact.robot = 1;
  contact.with = spf::sim::ContactWith::moving;
  contact.other = 2;
  contact.time = 3.25;
  result.contacts = {contact};
  message = outcome_message(result, false, kStamp);
  EXPECT_EQ(message.outcome, Message::COLLISION);
  EXPECT_NE(message.cause.find("robot 1 touched disc 2 at 3.25 s"), std::string::npos) << message.cause;
}

TEST(WorldMarkers, ShowEveryBodyWhereItIs) {
  World world{
      spf::sim::make_scenario(spf::sim::family_setup(spf::sim::Family::t2), spf::sim::kDefaultSeed, 10000)};
  world.begin_tick();
  const visualization_msgs::MarkerArray array = world_markers(world, kStamp);
  const auto count_of = [&](const char* name) {
    return std::count_if(array.markers.begin(), array.markers.end(),
                         [&](const visualization_msgs::Marker& marker) { return marker.ns == name; });
  };
  EXPECT_EQ(count_of("robot"), 5);
  EXPECT_EQ(count_of("goal"), 5);
  EXPECT_EQ(count_of("disc"), 4);
  EXPECT_EQ(count_of("box"), 6);
  EXPECT_EQ(count_of("border"), 1);
  for (const visualization_msgs::Marker& marker : array.markers) {
    if (marker.ns != "disc") continue;
    const spf::sim::DynamicObstacle& obstacle =
        world.dynamic_obstacles()[static_cast<std::size_t>(marker.id)];
    EXPECT_EQ(marker.pose.position.x, obstacle.motion.from.x());
    EXPECT_EQ(marker.scale.x, 2.0 * obstacle.radius);
  }
}

}  // namespace
}  // namespace spf_empc_ros
