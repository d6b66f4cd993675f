// The agent allocates nothing once it has run for a few seconds among the same surroundings.
#include <gtest/gtest.h>

#include "spf/math/random_stream.hpp"
#include "spf/team/ideal_host_test.hpp"
#include "spf/testing/allocation_guard.hpp"

namespace spf {
namespace {

struct Allocations {
  long receive = 0;
  long plan = 0;
};

class AllocationTest : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Methods, AllocationTest,
                         ::testing::Values("space_time", "spf_empc", "es2", "es2_constant_velocity", "orca"),
                         [](const auto& parameter) { return std::string{parameter.param}; });

/// Five obstacles that wander over the robot's path, four peers that cross it, boxes. The robot goes to and
/// fro.
TEST_P(AllocationTest, NoneAfterWarmUp) {
  const std::vector<TrueBox> boxes{
      {{-1.0, -1.2}, {0.0, 0.8}}, {{2.0, 1.0}, {3.0, 2.0}}, {{-3.0, -4.0}, {-2.0, -2.0}}};
  RobotAgent agent{2, with_method(AgentParameters{}, GetParam()), map_of(boxes), {{-5.0, 0.0}, 0.0}, 0.0};
  const double ends[2] = {5.0, -5.0};
  agent.set_goal({ends[0], 0.0});
  RandomStream noise{4};
  std::uint32_t sequence = 0;
  int legs = 0;
  int risky_plans = 0;
  bool new_goal = true;  // its guide needs memory, which is given back where the map is known
  Allocations allocations;
  for (int tick = 1; tick <= 9000; ++tick) {
    const double time = 0.01 * tick;
    AgentInput input;
    input.state.valid = true;
    input.state.pose_world = {agent.committed().position(time) + 0.01 * noise.normal2(), 0.0};
    if (tick % 10 == 0) {
      input.observation.emplace();
      input.observation->time = time;
      for (int k = 0; k < 5; ++k) {
        // They turn so quickly that none of them stands: what stands changes the guide, which is computed
        // anew then and allocates on a known map.
        const Eigen::Vector2d position{-4.0 + 2.0 * k, 4.0 * std::sin(0.3 * time + k)};
        const Eigen::Vector2d seen = position + 0.02 * noise.normal2();
        input.observation->detections.push_back({k, seen, std::nullopt, 0.4, 0.02});
      }
    }
    if (tick % 20 == 0) {
      for (int id : {0, 1, 3, 4}) {
        const double phase = std::fmod(time + 2.0 * id, 10.0);
        const Trajectory course = straight({-3.0 + 2.0 * id, -4.0 + 0.8 * phase}, {0.0, 0.8}, time, 2.0);
        input.messages.push_back(told_by(id, ++sequence, time, PeerState::moving, course));
      }
    }
    // The warm-up goes each way once; a few seconds do not meet every kind of plan.
    const bool counts = legs >= 2;
    const AllocationGuard receiving;
    for (const HeardMessage& message : input.messages) agent.hear(message, time);
    if (input.observation) agent.observe(*input.observation, input.state.pose_world, time);
    if (counts) allocations.receive += receiving.allocations();
    if (agent.plan_due(time)) {
      const AllocationGuard planning;
      (void)agent.plan(time, input.state);
      if (counts && !new_goal) allocations.plan += planning.allocations();
      new_goal = false;
      const PlanStats& stats = agent.last_plan().stats;
      if (counts && (stats.primitives > 1 || stats.optimiser_calls > 1 || GetParam() == std::string{"orca"}))
        ++risky_plans;
      if (agent.status().state == PeerState::arrived) {
        agent.set_goal({ends[++legs % 2], 0.0});
        new_goal = true;
      }
    }
  }
  EXPECT_GE(legs, 3);
  EXPECT_GT(risky_plans, 10);  // there was something to plan around
  EXPECT_EQ(allocations.receive, 0);
  EXPECT_EQ(allocations.plan, 0);
}

}  // namespace
}  // namespace spf
