#include "spf/planning/space_time/passage_speed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "spf/math/segment.hpp"
#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

/// A robot of 0.3 m on its way along x through a map, towards the origin.
class OnItsWay : public ::testing::Test {
 protected:
  /// Looks from a position on the way from `start` to `goal`.
  void look_from(const Eigen::Vector2d& position, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
    ASSERT_EQ(guide_.update(map_, goal, start), CostToGoOutcome::reachable);
    request_.head.position_world = position;
    request_.world.map = &map_;
    request_.guide = &guide_;
    passage_.prepare(request_);
  }
  [[nodiscard]] double limit_at(double x) const { return passage_.limit(guide_.cost_to_go({x, 0.0})); }

  OccupancyMap map_{GridFrame::covering({-8.0, -8.0}, {8.0, 8.0}, 0.1), 2.0};
  RobotParameters robot_;
  CostToGo guide_{CostToGoParameters{}, robot_.radius, SpaceTimeParameters{}.static_margin};
  PlanRequest request_;
  PassageSpeed passage_{SpaceTimeParameters{}, robot_};
};

/// Through a wall along y at x = 0 with one door, from (-5, 0) to (5, 0).
class PassageSpeedTest : public OnItsWay {
 protected:
  void prepare(double door, const std::vector<StandingDisc>& standing = {}) {
    map_ = OccupancyMap{GridFrame::covering({-8.0, -8.0}, {8.0, 8.0}, 0.1), 2.0};
    map_.add_box({-0.2, 0.5 * door}, {0.2, 9.0});
    map_.add_box({-0.2, -9.0}, {0.2, -0.5 * door});
    guide_.set_standing(standing, 1.0);
    look_from({-2.0, 0.0}, {-5.0, 0.0}, {5.0, 0.0});
  }
};

TEST_F(PassageSpeedTest, LimitsNothingWhereThereIsRoom) {
  prepare(1.4);
  EXPECT_FALSE(passage_.limits());
  EXPECT_GT(limit_at(0.0), robot_.max_speed);
  EXPECT_FALSE(passage_.direction({-1.0, 0.0}, 0.5).has_value());
}

TEST_F(PassageSpeedTest, IsLowerTheNarrowerTheDoorAndLeavesRoomToBrake) {
  double last = robot_.max_speed;
  for (const double door : {0.8, 0.74, 0.7}) {
    prepare(door);
    ASSERT_TRUE(passage_.limits());
    const double inside = limit_at(0.0);
    EXPECT_LT(inside, last) << door;
    EXPECT_GT(inside, 0.0) << door;
    last = inside;
    for (double x = -1.8; x < -0.3; x += 0.1) {
      const double before = limit_at(x);
      const double after = limit_at(x + 0.1);
      EXPECT_LE(before * before - after * after, 2.0 * robot_.max_acceleration * 0.2 + 1e-9)
          << door << " " << x;
    }
  }
}

TEST_F(PassageSpeedTest, IsNoLowerThanHelpsWhereTheOwnPositionIsNotKnown) {
  request_.position_sigma = 0.1;
  prepare(0.74);
  const double unsure = limit_at(0.0);
  request_.position_sigma = 0.0;
  prepare(0.74);
  EXPECT_GT(unsure, limit_at(0.0));
}

TEST_F(PassageSpeedTest, LeadsBackToTheWayAndAlongIt) {
  prepare(0.7);
  const auto along = passage_.direction({-1.0, 0.0}, 0.0);
  ASSERT_TRUE(along.has_value());
  EXPECT_GT(along->x(), 0.99);
  const auto beside = passage_.direction({-1.0, 0.1}, 0.0);
  ASSERT_TRUE(beside.has_value());
  EXPECT_LT(beside->y(), -0.3);
  EXPECT_FALSE(passage_.direction({-1.0, 2.0}, 0.0).has_value());
}

TEST_F(PassageSpeedTest, TellsHowMuchLongerNarrowPlacesTake) {
  prepare(1.4);
  EXPECT_EQ(passage_.delay(guide_.cost_to_go({-2.0, 0.0})), 0.0);
  double last = 0.0;
  for (const double door : {0.8, 0.74, 0.7}) {
    prepare(door);
    const auto delay_at = [&](double x) { return passage_.delay(guide_.cost_to_go({x, 0.0})); };
    EXPECT_GT(delay_at(-1.9), last) << door;
    last = delay_at(-1.9);
    for (double x = -1.9; x < 1.0; x += 0.1) EXPECT_GE(delay_at(x), delay_at(x + 0.1)) << door << " " << x;
    EXPECT_NEAR(delay_at(1.5), 0.0, 1e-9) << door;
    // Step by step at the speeds allowed, what the cost counts at full speed included.
    double time = 0.0;
    for (double x = -1.9; x < 1.0; x += 0.01) time += 0.01 / std::min(limit_at(x + 0.005), robot_.max_speed);
    const double counted =
        (guide_.cost_to_go({-1.9, 0.0}) - guide_.cost_to_go({1.0, 0.0})) / robot_.max_speed;
    EXPECT_GT(last + counted, 0.75 * time) << door;
    EXPECT_LT(last + counted, 1.5 * time) << door;
  }
}

TEST_F(PassageSpeedTest, CountsNoDelayForStandingBeforeWhatStands) {
  prepare(0.9);
  const double open = passage_.delay(guide_.cost_to_go({-1.9, 0.0}));
  prepare(0.9, {{{0.0, 0.0}, 0.3, 10.0, 7, true}});
  ASSERT_NE(passage_.blocked_by(), nullptr);
  const double left = passage_.left_to_go(guide_.cost_to_go({-1.9, 0.0}));
  EXPECT_LT(passage_.delay(left), open + 2.0);
}

/// Along a corridor that turns by `angle` to the left at the origin, in `joints` equal steps.
class BentCorridor : public OnItsWay {
 protected:
  void prepare(double angle, int joints) {
    const double step = angle / joints;
    std::vector<Eigen::Vector2d> middle{{-4.0, 0.0}, {0.0, 0.0}};
    for (int k = 1; k <= joints; ++k) {
      const double length = k == joints ? 4.0 : kJoint;
      middle.push_back(middle.back() + length * Eigen::Vector2d{std::cos(k * step), std::sin(k * step)});
    }
    map_ = OccupancyMap{GridFrame::covering({-6.0, -6.0}, {6.0, 6.0}, 0.025), 1.0};
    for (double x = -6.0; x < 6.0; x += kPost)
      for (double y = -6.0; y < 6.0; y += kPost) {
        double nearest = 1e9;
        for (std::size_t i = 1; i < middle.size(); ++i)
          nearest = std::min(nearest, distance_to_segment({x, y}, {middle[i - 1], middle[i]}));
        if (nearest > 0.5 * kWidth && nearest < 0.5 * kWidth + 2.0 * kPost)
          map_.add_box({x - 0.5 * kPost, y - 0.5 * kPost}, {x + 0.5 * kPost, y + 0.5 * kPost});
      }
    look_from({-3.5, 0.0}, {-3.5, 0.0}, middle.back());
  }
  /// Lowest limit near the bend.
  [[nodiscard]] double slowest() const {
    double speed = robot_.max_speed;
    for (double x = -0.6; x < 0.3; x += 0.02) speed = std::min(speed, limit_at(x));
    return speed;
  }

  static constexpr double kWidth = 0.84;  // [m]
  static constexpr double kJoint = 0.1;   // [m]
  static constexpr double kPost = 0.05;   // [m]
};

TEST_F(BentCorridor, IsDrivenTheSlowerTheMoreItTurns) {
  prepare(1e-3, 1);
  double last = slowest();
  for (const double angle : {0.8, 1.5}) {
    prepare(angle, 1);
    EXPECT_LT(slowest(), 0.9 * last) << angle;
    last = slowest();
  }
}

TEST_F(BentCorridor, HasOneSpeedInHoweverManyJointsItTurns) {
  prepare(1.5, 1);
  ASSERT_TRUE(passage_.limits());
  const double at_once = slowest();
  prepare(1.5, 3);
  EXPECT_LT(slowest(), 1.3 * at_once);
  EXPECT_GT(slowest(), at_once / 1.3);
}

TEST_F(PassageSpeedTest, StopsBeforeWhatStandsInTheOnlyWayAndNamesIt) {
  prepare(0.9, {{{0.0, 0.0}, 0.3, 10.0, 7, true}});
  ASSERT_NE(passage_.blocked_by(), nullptr);
  EXPECT_EQ(passage_.blocked_by()->id, 7);
  EXPECT_TRUE(passage_.blocked_by()->is_peer);
  EXPECT_EQ(limit_at(-0.6), 0.0);  // 0.1 m before it
  EXPECT_GT(limit_at(-1.5), 0.5);
  // To come nearer than where it stops is no progress, to be behind it is.
  EXPECT_EQ(passage_.left_to_go(guide_.cost_to_go({-0.55, 0.0})),
            passage_.left_to_go(guide_.cost_to_go({-0.5, 0.0})));
  EXPECT_LT(passage_.left_to_go(guide_.cost_to_go({1.5, 0.0})),
            passage_.left_to_go(guide_.cost_to_go({-0.55, 0.0})) - 5.0);
  prepare(0.9);
  EXPECT_EQ(passage_.blocked_by(), nullptr);
}

TEST_F(PassageSpeedTest, StopsWhereItIsToLetOthersPassAndStepsBackFromNearer) {
  prepare(1.4);
  request_.give_way = GiveWay{guide_.cost_to_go({-1.0, 0.0}), 5};
  passage_.prepare(request_);
  ASSERT_TRUE(passage_.limits());
  EXPECT_TRUE(passage_.stands_before());
  EXPECT_EQ(passage_.blocked_by(), nullptr);
  EXPECT_EQ(limit_at(-0.9), 0.0);
  EXPECT_GT(limit_at(-1.8), 0.5);
  // Nearer to the passage is worse than where it is to wait, as much as the same distance before it.
  const auto left_at = [&](double x) { return passage_.left_to_go(guide_.cost_to_go({x, 0.0})); };
  EXPECT_NEAR(left_at(-0.5), left_at(-1.5), 1e-6);
  EXPECT_LT(left_at(-1.0), left_at(-0.5));
  EXPECT_TRUE(passage_.in_the_way(guide_.cost_to_go({-0.5, 0.0})));
  EXPECT_FALSE(passage_.in_the_way(guide_.cost_to_go({-1.0, 0.0})));
}

}  // namespace
}  // namespace spf
