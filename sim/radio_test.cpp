#include "sim/radio.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

namespace spf::sim {
namespace {

struct Heard {
  double time;
  int receiver;
  int sender;
  std::uint32_t sequence;
};

class Air {
 public:
  explicit Air(const Scenario& scenario, std::vector<Eigen::Vector2d> positions)
      : radio_{scenario}, positions_{std::move(positions)} {
    grid_.assign(positions_);
  }
  void send(double time, int sender, std::uint32_t sequence) {
    TrajectoryMessage message;
    message.robot_id = sender;
    message.sequence = sequence;
    radio_.send(time, message, positions_[static_cast<std::size_t>(sender)]);
  }
  std::vector<Heard> listen(double time) {
    std::vector<Heard> heard;
    radio_.deliver(time, grid_, positions_, [&](int receiver, const TrajectoryMessage& message) {
      heard.push_back({time, receiver, message.robot_id, message.sequence});
    });
    return heard;
  }

 private:
  Radio radio_;
  UniformGrid grid_{2.0};
  std::vector<Eigen::Vector2d> positions_;
};

Scenario fleet(std::size_t robots) {
  Scenario scenario;
  scenario.robots.resize(robots);
  return scenario;
}

TEST(Radio, DeliversToEveryOtherRobotAfterTheDelayInOrder) {
  Air air{fleet(3), {{0, 0}, {100, 0}, {0, 1000}}};
  air.send(1.0, 0, 7);
  air.send(1.01, 2, 8);
  EXPECT_TRUE(air.listen(1.04).empty());
  const std::vector<Heard> first = air.listen(1.05);
  ASSERT_EQ(first.size(), 2U);
  for (const Heard& heard : first) EXPECT_EQ(std::tuple(heard.sender, heard.sequence), std::tuple(0, 7U));
  EXPECT_EQ((std::set{first[0].receiver, first[1].receiver}), (std::set{1, 2}));
  EXPECT_EQ(air.listen(2.0).size(), 2U);
  EXPECT_TRUE(air.listen(3.0).empty());  // once only
}

TEST(Radio, EndsAtItsRange) {
  Scenario scenario = fleet(4);
  scenario.simulation.radio.range = 10.0;
  Air air{scenario, {{0, 0}, {9.9, 0}, {0, 10.1}, {-7, -7}}};
  air.send(0.0, 0, 1);
  std::set<int> receivers;
  for (const Heard& heard : air.listen(1.0)) receivers.insert(heard.receiver);
  EXPECT_EQ(receivers, (std::set{1, 3}));
}

TEST(Radio, LosesTheAskedShareIndependentlyByLink) {
  Scenario scenario = fleet(3);
  scenario.simulation.radio.loss = 0.3;
  Air air{scenario, {{0, 0}, {1, 0}, {2, 0}}};
  constexpr int kMessages = 5000;
  int heard_by_1 = 0;
  int heard_by_2 = 0;
  int heard_by_both = 0;
  for (int i = 0; i < kMessages; ++i) {
    air.send(i, 0, static_cast<std::uint32_t>(i));
    bool by_1 = false;
    bool by_2 = false;
    for (const Heard& heard : air.listen(i + 0.5)) (heard.receiver == 1 ? by_1 : by_2) = true;
    heard_by_1 += by_1;
    heard_by_2 += by_2;
    heard_by_both += by_1 && by_2;
  }
  const auto tolerance = [](double p) {
    return 5.0 * std::sqrt(p * (1.0 - p) * kMessages);
  };  // five deviations
  EXPECT_NEAR(heard_by_1, 0.7 * kMessages, tolerance(0.7));
  EXPECT_NEAR(heard_by_2, 0.7 * kMessages, tolerance(0.7));
  EXPECT_NEAR(heard_by_both, 0.49 * kMessages, tolerance(0.49));
}

TEST(Radio, LossOnALinkDoesNotDependOnOthersTraffic) {
  Scenario scenario = fleet(3);
  scenario.simulation.radio.loss = 0.5;
  Air quiet{scenario, {{0, 0}, {1, 0}, {2, 0}}};
  Air busy{scenario, {{0, 0}, {1, 0}, {2, 0}}};
  for (int i = 0; i < 100; ++i) {
    quiet.send(i, 0, 0);
    busy.send(i, 0, 0);
    busy.send(i, 2, 0);
    const auto heard_from_0 = [](const std::vector<Heard>& all) {
      std::set<int> receivers;
      for (const Heard& heard : all)
        if (heard.sender == 0) receivers.insert(heard.receiver);
      return receivers;
    };
    EXPECT_EQ(heard_from_0(quiet.listen(i + 0.5)), heard_from_0(busy.listen(i + 0.5)));
  }
}

}  // namespace
}  // namespace spf::sim
