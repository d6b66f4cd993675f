#include "host/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spf::host {
namespace {

TEST(DeadReckoning, FollowsACircle) {
  DeadReckoning motion;
  const Eigen::Vector3d twist{0.6, 0.8, 1.5};
  for (int i = 0; i <= 40; ++i) motion.advance(10.0 + 0.01 * i, twist);
  for (const double ago : {0.0, 0.003, 0.1, 0.257}) {
    const double turned = 1.5 * (0.4 - ago);
    const double heading = std::atan2(0.8, 0.6);
    const Eigen::Vector2d expected = Eigen::Vector2d{std::sin(heading + turned) - std::sin(heading),
                                                     std::cos(heading) - std::cos(heading + turned)} /
                                     1.5;
    EXPECT_LT((motion.at(10.4 - ago).position_world - expected).norm(), 1e-4) << ago;
    EXPECT_NEAR(motion.at(10.4 - ago).heading, turned, 1e-9) << ago;
  }
}

TEST(DeadReckoning, ChangesSpeedEvenlyBetweenCalls) {
  DeadReckoning motion;
  motion.advance(0.0, Eigen::Vector3d::Zero());
  for (int i = 1; i <= 10; ++i) motion.advance(0.05 * i, {0.05 * i, 0.0, 0.0});
  EXPECT_NEAR(motion.here().position_world.x(), 0.5 * 0.5 * 0.5, 1e-12);
  EXPECT_NEAR(motion.at(0.6).position_world.x(), 0.125 + 0.1 * 0.5, 1e-12);  // as it moves
}

TEST(DeadReckoning, RemembersAsLongAtAnyRate) {
  for (const double period : {0.0005, 0.001, 0.02, 0.05, 0.2}) {
    DeadReckoning motion;
    const int steps = static_cast<int>(std::round(3.0 / period));
    for (int i = 0; i <= steps; ++i) motion.advance(i * period, {1.0, 0.0, 0.0});
    EXPECT_NEAR(motion.here().position_world.x(), 3.0, 1e-9);
    EXPECT_NEAR(motion.at(3.0 - DeadReckoning::kMemory).position_world.x(), 3.0 - DeadReckoning::kMemory,
                1e-6)
        << period;
  }
}

TEST(DeadReckoning, IgnoresTimesThatDoNotGrowAndForgets) {
  DeadReckoning motion;
  EXPECT_EQ(motion.at(5.0).position_world, Eigen::Vector2d(0.0, 0.0));
  motion.advance(1.0, {1.0, 0.0, 0.0});
  motion.advance(0.5, {9.0, 0.0, 0.0});
  motion.advance(1.0, {9.0, 0.0, 0.0});
  EXPECT_NEAR(motion.at(1.1).position_world.x(), 0.1, 1e-12);
  motion.reset();
  motion.advance(0.2, {1.0, 0.0, 0.0});
  EXPECT_EQ(motion.here().position_world, Eigen::Vector2d(0.0, 0.0));
}

}  // namespace
}  // namespace spf::host
