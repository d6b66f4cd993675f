// Messages of peers, and forged messages of the robot's own planner: to the agent, and through the hosts'
// input checks.
#include <cmath>

#include "fuzz/robot_world.hpp"

namespace {

using namespace spf;

Trajectory trajectory_of(fuzz::Bytes& bytes, double now) {
  Trajectory trajectory{bytes.up_to(3) > 0 ? now : bytes.number()};
  const int pieces = bytes.up_to(4);
  for (int k = 0; k < pieces; ++k) {
    QuinticPiece piece;
    const int rows = bytes.up_to(6);
    for (int row = 0; row < rows && row < 6; ++row) piece.coefficients.row(row) = bytes.pair().transpose();
    piece.duration = std::abs(bytes.number());
    if (piece.duration > 0.0) trajectory.append(piece);  // conversions refuse others
  }
  if (bytes.up_to(3) == 0) {
    HeadingPhases phases;
    phases.initial_heading = bytes.number();
    phases.cruise_rate = bytes.number();
    phases.cruise = std::abs(bytes.number());
    phases.target_heading = bytes.number();
    trajectory.set_heading(HeadingProfile::from_phases(phases).value_or(HeadingProfile{bytes.number()}));
  }
  return trajectory;
}

TrajectoryMessage message_of(fuzz::Bytes& bytes, double now) {
  const auto mostly = [&bytes](double sane) { return bytes.up_to(7) > 0 ? sane : bytes.number(); };
  TrajectoryMessage message;
  message.robot_id = bytes.up_to(7) > 0 ? bytes.up_to(5) : bytes.whole<std::int32_t>();
  message.sequence = bytes.up_to(3) > 0 ? bytes.byte() : bytes.whole<std::uint32_t>();
  message.sent_time = mostly(now);
  message.expiry_time = mostly(now + 1.5);
  message.radius = mostly(0.3);
  message.position_sigma = mostly(0.02);
  message.state = static_cast<PeerState>(bytes.up_to(3));
  message.trajectory = trajectory_of(bytes, now);
  if (message.sequence % 8 == 7) {
    const Eigen::Vector2d entry{bytes.number(), bytes.number()};
    const Eigen::Vector2d exit{bytes.number(), bytes.number()};
    message.claim = PassageClaim{entry, exit, mostly(now), bytes.up_to(1) > 0, bytes.up_to(1) > 0};
  }
  return message;
}

void tell_table(fuzz::Bytes bytes) {
  PeerTable table{0};
  double now = 100.0;
  while (!bytes.empty()) {
    const TrajectoryMessage message = message_of(bytes, now);
    table.receive(message, now);
    now += 0.02 * bytes.up_to(100);
    const std::vector<Peer>& peers = table.peers(now);
    fuzz::require(peers.size() <= kMostPeers, "peers are bounded");
    for (const Peer& peer : peers)
      for (const double time : {-1e9, now, now + 0.5, 1e9}) fuzz::require_finite(peer, time);
  }
}

void tell_agent(fuzz::Bytes bytes) {
  host::RobotHost robot = fuzz::trusting_robot(fuzz::agent_of(bytes));
  for (int i = 0; i < 6; ++i) {
    const double now = 0.1 * i;
    robot.add_pose({now, Pose2{}}, now);
    const int count = bytes.up_to(3);
    for (int k = 0; k < count; ++k) robot.add_message(message_of(bytes, now), now);
    fuzz::step(robot, now);
  }
}

void tell_hosts(fuzz::Bytes bytes) {
  host::HostParameters parameters;
  parameters.relies_on_scan = parameters.relies_on_obstacles = false;
  const AgentParameters agent = fuzz::agent_of(bytes);
  host::PlannerProcess planner{0, agent, parameters};
  host::TrackerProcess tracker{0, agent, parameters};
  planner.planner().set_map(fuzz::small_map());
  planner.planner().set_goal({{3.0, 0.0}, std::nullopt});
  for (int i = 0; i < 60; ++i) {
    const double now = 10.0 + 0.02 * i;
    planner.add_pose({now, Pose2{}}, now);
    tracker.add_pose({now, Pose2{}}, now);
    if (i > 30 && i % 3 == 0) {
      const TrajectoryMessage message = message_of(bytes, now);
      planner.add_message(message, now);
      TrajectoryMessage own = message;
      own.robot_id = 0;
      tracker.add_plan(own, now);
    }
    planner.step(now);
    fuzz::require(tracker.step(now).wheel_speeds.allFinite(), "wheel speeds are numbers");
  }
  if (planner.planner().agent() != nullptr) fuzz::require_sound(*planner.planner().agent());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::give({data, size}, tell_agent, tell_hosts, tell_table);
  return 0;
}
