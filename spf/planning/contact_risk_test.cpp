#include "spf/planning/contact_risk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "spf/math/random_stream.hpp"
#include "spf/planning/cost_to_go.hpp"
#include "spf/trajectory/constant_acceleration.hpp"

namespace spf {
namespace {

// The formula is an approximation of the chance that a two-dimensional Gaussian lies in a disc: compare it
// with that chance by Monte Carlo. The approximation error, at most 0.12 over this range, is a known property
// of the formula.
TEST(OverlapProbability, IsCloseToTheChanceOfADiscUnderAGaussian) {
  RandomStream random{5};
  for (int i = 0; i < 60; ++i) {
    const double radius = random.uniform(0.5, 1.0);
    const double sigma = random.uniform(0.03, 0.6);
    const double distance = random.uniform(0.0, 2.0);
    int inside = 0;
    const int n = 4000;
    for (int k = 0; k < n; ++k) {
      inside += (sigma * random.normal2() + Eigen::Vector2d{distance, 0.0}).norm() < radius ? 1 : 0;
    }
    const double chance = static_cast<double>(inside) / n;
    EXPECT_NEAR(overlap_probability(distance, radius, sigma), chance, 0.12)
        << "R " << radius << " sigma " << sigma << " d " << distance;
  }
}

TEST(OverlapProbability, FallsWithDistance) {
  double last = 1.0;
  for (double distance = 0.0; distance < 3.0; distance += 0.1) {
    const double now = overlap_probability(distance, 0.8, 0.3);
    EXPECT_LT(now, last);
    last = now;
  }
}

constexpr double kNow = 10.0;    // [s]
constexpr double kRadius = 0.3;  // [m] of the robot

/// A robot, number 3, that goes 4 m straight ahead from the origin at 1 m/s, and stops there at once.
class ContactRiskTest : public ::testing::Test {
 protected:
  ContactRiskTest() {
    request.time = kNow;
    request.world = {kNow, 3, &map, &tracks, &peers};
    request.guide = &guide;
    plan.append(constant_acceleration({0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}, 4.0));
  }
  void add_track(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity, double sigma = 0.0) {
    ObstacleTrack track;
    track.time = kNow;
    track.state = {position, velocity, 0.4};
    track.position_variance = sigma * sigma;
    tracks.push_back(track);
  }
  void add_peer(int id, PeerState state, const Eigen::Vector2d& position) {
    Peer peer;
    peer.robot_id = id;
    peer.state = state;
    peer.trajectory = Trajectory::standing(position, kNow, 1.0);
    peers.push_back(peer);
  }
  [[nodiscard]] double risk() const { return contact_risk(plan, request, kRadius); }

  OccupancyMap map{GridFrame::covering({-10.0, -10.0}, {10.0, 10.0}, 0.1), 2.0};
  std::vector<ObstacleTrack> tracks;
  std::vector<Peer> peers;
  CostToGo guide{CostToGoParameters{}};
  PlanRequest request;
  Trajectory plan{kNow};
};

TEST_F(ContactRiskTest, IsZeroWhereNothingComesNear) {
  EXPECT_EQ(risk(), 0.0);
  add_track({2.0, 1.0}, {0.0, 0.5}, 0.01);
  add_track({-3.0, 0.0}, {0.5, 0.0});  // behind, and slower
  EXPECT_EQ(risk(), 0.0);
}

TEST_F(ContactRiskTest, IsCertainWhereWhatIsKnownExactlyIsMet) {
  add_track({2.0, 2.0}, {0.0, -1.0});
  EXPECT_NEAR(risk(), 1.0, 1e-12);
  // It was seen a second ago, where it was then.
  tracks[0].time = kNow - 1.0;
  tracks[0].state.position_world.y() = 3.0;
  EXPECT_NEAR(risk(), 1.0, 1e-12);
  tracks[0].state.position_world.y() = 5.0;  // 2 m late
  EXPECT_EQ(risk(), 0.0);
}

TEST_F(ContactRiskTest, LooksAheadAsFarAsItsHorizonAndThenAtARobotAtRest) {
  plan = Trajectory::standing({0.0, 0.0}, kNow, 0.5);
  const double contact = 0.7;
  add_track({contact + 0.9 * kRiskHorizon, 0.0}, {-1.0, 0.0});
  EXPECT_NEAR(risk(), 1.0, 1e-12);
  tracks[0].state.position_world.x() = contact + 1.1 * kRiskHorizon;
  EXPECT_EQ(risk(), 0.0);
}

TEST_F(ContactRiskTest, OfThingsAtRestIsTheirOverlapProbability) {
  plan = Trajectory::standing({0.0, 0.0}, kNow, 1.0);
  request.position_sigma = 0.06;
  add_track({0.8, 0.0}, {0.0, 0.0}, 0.08);
  const double one = overlap_probability(0.8, 0.7, 0.1);
  EXPECT_GT(one, 0.1);
  EXPECT_NEAR(risk(), one, 1e-12);
  // Two are independent of each other.
  add_track({0.0, -0.8}, {0.0, 0.0}, 0.08);
  EXPECT_NEAR(risk(), 1.0 - (1.0 - one) * (1.0 - one), 1e-12);
}

TEST_F(ContactRiskTest, CountsThePeersThatTheCommonCheckCounts) {
  add_peer(7, PeerState::moving, {2.0, 0.0});  // comes after robot 3
  EXPECT_EQ(risk(), 0.0);
  for (const PeerState state : {PeerState::stopped, PeerState::braking, PeerState::arrived}) {
    peers[0].state = state;
    EXPECT_NEAR(risk(), 1.0, 1e-12);
  }
  peers[0].state = PeerState::moving;
  peers[0].priority = -1;
  EXPECT_NEAR(risk(), 1.0, 1e-12);
  // One that fell silent grows.
  peers.clear();
  add_peer(7, PeerState::moving, {2.0, 1.0});
  peers[0].expired = true;
  EXPECT_EQ(risk(), 0.0);
  peers[0].growth = 0.5;
  EXPECT_NEAR(risk(), 1.0, 1e-12);
}

// Against the share of futures in which robot and obstacle touch at some time, drawn from the track's
// uncertainty of position and velocity. The largest probability of an instant is a little less than that of
// any; 0.12 is the error of the overlap's formula.
TEST_F(ContactRiskTest, IsAboutTheShareOfFuturesWithAContact) {
  RandomStream random{9};
  int graded = 0;
  for (int i = 0; i < 40; ++i) {
    tracks.clear();
    add_track({random.uniform(0.5, 3.0), random.uniform(1.0, 3.0)}, {random.uniform(-0.5, 0.5), -1.0}, 0.1);
    const double spread = random.uniform(0.05, 0.25);  // [m/s]
    tracks[0].velocity_variance = spread * spread;
    int met = 0;
    constexpr int kFutures = 1000;
    for (int k = 0; k < kFutures; ++k) {
      const Eigen::Vector2d from = tracks[0].state.position_world + 0.1 * random.normal2();
      const Eigen::Vector2d velocity = tracks[0].state.velocity_world + spread * random.normal2();
      bool contact = false;
      for (double ahead = 0.0; ahead <= kRiskHorizon && !contact; ahead += 0.05)
        contact = (plan.position(kNow + ahead) - from - ahead * velocity).norm() < 0.7;
      met += contact ? 1 : 0;
    }
    const double share = static_cast<double>(met) / kFutures;
    EXPECT_NEAR(risk(), share, 0.2) << i;
    graded += share > 0.1 && share < 0.9 ? 1 : 0;
  }
  EXPECT_GT(graded, 5);
}

TEST_F(ContactRiskTest, IsSetForThePlanAndItsCandidatesWhateverTheMethodSays) {
  add_track({2.0, 2.0}, {0.0, -1.0});
  PlanResult result;
  result.risk = 0.25;
  result.trajectory = plan;
  const Trajectory aside = Trajectory::standing({0.0, 0.0}, kNow, 1.0);
  result.candidates = {{Candidate::Kind::primitive, 1.0, 0.5, true, plan},
                       {Candidate::Kind::brake, 2.0, 0.5, false, aside}};
  set_risk(request, kRadius, result);
  EXPECT_NEAR(result.risk, 1.0, 1e-12);
  EXPECT_NEAR(result.candidates[0].risk, 1.0, 1e-12);
  EXPECT_EQ(result.candidates[1].risk, 0.0);
  // Of what cannot be planned nothing is said.
  result.clear();
  request.guide = nullptr;
  set_risk(request, kRadius, result);
  EXPECT_EQ(result.risk, 0.0);
}

}  // namespace
}  // namespace spf
