// What crosses from one process to another, by loopback: within one process CycloneDDS hands samples over as
// they are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <ros2_messages/nav_msgs/OccupancyGrid.hpp>
#include <ros2_messages/std_msgs/String.hpp>
#include <ros2_messages/std_srvs/SetBool.hpp>

#include "ros2/node/bench_test.hpp"

namespace ros2 {
namespace {

/// A process of its own that runs `body` until it is ended. Made before this one has threads of CycloneDDS.
class OtherProcess {
 public:
  explicit OtherProcess(const std::function<void()>& body) : id_{fork()} {
    if (id_ != 0) return;
    body();
    _exit(0);
  }
  ~OtherProcess() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  OtherProcess(const OtherProcess&) = delete;
  OtherProcess& operator=(const OtherProcess&) = delete;

 private:
  pid_t id_;
};

using nav_msgs::OccupancyGrid;

/// Sends back what it hears, and serves.
void echo(const DomainOptions& options) {
  Process process{{}, options};
  Node node{process.context, process.executor, {"echo"}};
  const auto back = node.advertise<OccupancyGrid>("/back", Qos::keep_last(10));
  node.subscribe<OccupancyGrid>("/to", Qos::keep_last(10), [&](const auto& grid) { back.publish(grid); });
  node.serve<std_srvs::SetBool_Request, std_srvs::SetBool_Response>("/switch", [](const auto& request) {
    std_srvs::SetBool_Response response;
    response.success = !request.data;
    response.message = "from afar";
    return response;
  });
  const auto latched = node.advertise<std_msgs::String>("/latched", Qos::latched());
  std_msgs::String text;
  text.data = "kept";
  latched.publish(text);
  (void)process.executor.spin_until([] { return false; }, 6.0 * kPatience);
}

TEST(Network, MessagesOfAllSizesCrossBothWays) {
  const DomainOptions options = test_domain();
  const OtherProcess other{[&] { echo(options); }};
  Process here{{}, options};
  Node node{here.context, here.executor, {"asks"}};
  const auto to = node.advertise<OccupancyGrid>("/to", Qos::keep_last(10));
  std::vector<OccupancyGrid> heard;
  node.subscribe<OccupancyGrid>("/back", Qos::keep_last(10),
                                [&](const auto& grid) { heard.push_back(grid); });
  ASSERT_TRUE(run_until({&here}, [&] { return to.subscribers() == 1; }));
  // From within a datagram to many fragments; of a length that needs padding.
  for (const std::size_t cells : {0U, 1U, 1300U, 14'001U, 70'002U, 1'000'003U}) {
    OccupancyGrid grid;
    grid.header.frame_id = "map";
    for (std::size_t i = 0; i < cells; ++i) grid.data.push_back(static_cast<std::int8_t>(i % 101));
    // The echo's publisher may not have found this subscription yet: said again until it has.
    const bool crossed = run_until({&here}, [&, next = std::chrono::steady_clock::time_point{}]() mutable {
      const auto now = std::chrono::steady_clock::now();
      const bool back = !heard.empty() && heard.back().data.size() == cells;
      if (!back && now > next) {
        to.publish(grid);
        next = now + std::chrono::seconds{1};
      }
      return back;
    });
    ASSERT_TRUE(crossed) << cells;
    EXPECT_EQ(to_cdr(heard.back()), to_cdr(grid)) << cells;
  }
}

TEST(Network, ServicesAndLatchedTopicsCross) {
  const DomainOptions options = test_domain();
  const OtherProcess other{[&] { echo(options); }};
  Process here{{}, options};
  Node node{here.context, here.executor, {"asks"}};
  std::vector<std::string> heard;
  node.subscribe<std_msgs::String>("/latched", Qos::latched(),
                                   [&](const auto& text) { heard.push_back(text.data); });
  const auto client = node.client<std_srvs::SetBool_Request, std_srvs::SetBool_Response>("/switch");
  ASSERT_TRUE(run_until({&here}, [&] { return client.ready(); }));
  std::vector<std::string> answers;
  client.call({}, [&](const auto& response) { answers.push_back(response.message); });
  ASSERT_TRUE(run_until({&here}, [&] { return !answers.empty() && !heard.empty(); }));
  EXPECT_THAT(answers, testing::ElementsAre("from afar"));
  EXPECT_THAT(heard, testing::ElementsAre("kept"));
}

}  // namespace
}  // namespace ros2
