// One call of a planner: a map, a person who crosses, a goal, and out comes a trajectory. The guide is the
// cost-to-go around what stands; the method is any of the table (docs/add_a_method.md).
#include <spf/planning/cost_to_go.hpp>
#include <spf/team/method_table.hpp>

#include <iostream>

#include "picture.hpp"

namespace {

void draw(Picture& picture, const spf::Trajectory& plan, const std::string& colour, double width) {
  std::vector<Eigen::Vector2d> path;
  for (double t = plan.start_time(); t <= plan.end_time(); t += 0.1) path.push_back(plan.position(t));
  picture.line(path, colour, width);
}

}  // namespace

int main() {
  const Eigen::Vector2d start{-3.0, 0.0}, goal{3.0, 0.5}, low{-1.0, -2.0}, high{0.0, 0.4};
  spf::OccupancyMap map{spf::GridFrame::covering({-4.0, -3.0}, {4.0, 3.0}, 0.1), 2.0};
  map.add_box(low, high);
  const std::vector<spf::ObstacleTrack> tracks{{7, 0.0, {{0.9, 2.6}, {0.0, -0.6}, 0.3}}};

  const spf::AgentParameters robot = spf::defaults_for(spf::RobotParameters{});
  spf::CostToGo guide{robot.guide, robot.robot.radius};
  guide.update(map, goal, start);

  const std::vector<spf::Peer> peers;
  spf::PlanRequest request;
  request.head.position_world = start;
  request.goal_world = goal;
  request.world.map = &map;
  request.world.tracks = &tracks;
  request.world.peers = &peers;
  request.guide = &guide;
  request.keep_candidates = true;
  spf::PlanResult result;
  spf::MethodTable{}.at("space_time").make_planner(robot)->plan(request, result);

  Picture picture{{-4.0, -2.5}, {4.0, 3.0}};
  picture.box(low, high, "wall");
  for (const spf::Candidate& candidate : result.candidates)
    draw(picture, candidate.trajectory, "control", 0.6);
  draw(picture, result.trajectory, "robot-0", 4.0);
  picture.disc(start, robot.robot.radius, "robot-0");
  picture.disc(goal, 0.1, "robot-0", 0.0);
  for (double ahead = 0.0; ahead <= 4.0; ahead += 1.0)  // where the person will be
    picture.disc(tracks[0].state.position_world + ahead * tracks[0].state.velocity_world, 0.3, "obstacle",
                 0.7 - 0.15 * ahead);
  picture.save("03_planning_once.svg");

  std::cout << to_string(result.outcome) << ": " << result.candidates.size()
            << " candidates, the chosen takes " << spf::fixed(result.trajectory.duration(), 2) << " s for "
            << spf::fixed(result.trajectory.length(), 2) << " m; shortest path around the box "
            << spf::fixed(guide.cost_to_go(start), 2) << " m\n";
  return succeeded(result.outcome) ? 0 : 1;
}
