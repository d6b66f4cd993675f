#include "host/attempts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/progress_monitor.hpp"

namespace spf::host {
namespace {

TEST(Attempts, WaitLongerAfterEachFailureUpToALimit) {
  Attempts attempts;
  EXPECT_FALSE(attempts.waiting(0.0));
  double wait = Attempts::kFirstWait;
  double now = 5.0;
  for (int failure = 1; failure < 8; ++failure) {
    attempts.fail(now, 0.5);
    EXPECT_EQ(attempts.failures(), failure);
    EXPECT_TRUE(attempts.waiting(now));
    EXPECT_TRUE(attempts.waiting(now + 0.49 + wait));
    EXPECT_FALSE(attempts.waiting(now + 0.51 + wait));
    wait = std::min(2.0 * wait, Attempts::kLongestWait);
    now += 20.0;
  }
  attempts.succeed();
  EXPECT_EQ(attempts.failures(), 0);
  attempts.fail(now, 0.0);
  EXPECT_FALSE(attempts.waiting(now + Attempts::kFirstWait + 0.01));
}

struct Walk {
  ProgressMonitor monitor{RobotParameters{}};
  double now = 10.0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();

  /// Whether it is found to get nowhere.
  bool fails(double seconds, double speed, bool goes) {
    for (const double until = now + seconds; now < until; now += 0.01) {
      position.x() += 0.01 * speed;
      monitor.note(now, position, goes);
      if (monitor.stuck(now)) return true;
    }
    return false;
  }
};

TEST(ProgressMonitor, FindsARobotThatGoesAndGetsNowhere) {
  Walk walk;
  EXPECT_FALSE(walk.fails(ProgressMonitor::kTime - 0.1, 0.0, true));
  EXPECT_TRUE(walk.fails(0.3, 0.0, true));
  walk.now += 10.0;
  EXPECT_TRUE(walk.fails(ProgressMonitor::kTime + 0.3, 0.02, true));
  // Round and round within its own radius.
  Walk circling;
  bool found = false;
  for (int i = 0; i < 1200 && !found; ++i) {
    circling.now += 0.01;
    circling.position = 0.1 * Eigen::Vector2d{std::cos(0.02 * i), std::sin(0.02 * i)};
    circling.monitor.note(circling.now, circling.position, true);
    found = circling.monitor.stuck(circling.now);
  }
  EXPECT_TRUE(found);
}

TEST(ProgressMonitor, LeavesAloneWhoGetsOnOrHasACauseToStand) {
  EXPECT_FALSE(Walk{}.fails(60.0, 0.05, true));
  EXPECT_FALSE(Walk{}.fails(60.0, 0.0, false));
  Walk walk;
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(walk.fails(0.9 * ProgressMonitor::kTime, 0.0, true));
    EXPECT_FALSE(walk.fails(0.1, 0.0, false));  // waits for somebody
  }
}

}  // namespace
}  // namespace spf::host
