#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ros2_messages/humble/nav2_msgs/NavigateToPose.hpp>
#include <ros2_messages/nav2_msgs/NavigateToPose.hpp>

#include "ros2/node/action_goals.hpp"
#include "ros2/node/action_server.hpp"
#include "ros2/node/bench_test.hpp"

namespace ros2 {
namespace {

using action_msgs::CancelGoal_Request;
using action_msgs::CancelGoal_Response;
using action_msgs::GoalInfo;
using action_msgs::GoalStatus;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr GoalId goal_id(std::uint8_t number) {
  return {number};
}

GoalInfo asked(const GoalId& id, Nanoseconds until = 0) {
  GoalInfo info;
  info.goal_id.uuid = id;
  info.stamp = time_of(until);
  return info;
}

TEST(ActionGoals, ARequestMeansOneOrThoseBeforeOrAll) {
  ActionGoals goals;
  ASSERT_TRUE(goals.add(goal_id(3), 1 * kSecond));
  ASSERT_TRUE(goals.add(goal_id(1), 3 * kSecond));
  ASSERT_TRUE(goals.add(goal_id(2), 2 * kSecond));
  EXPECT_FALSE(goals.add(goal_id(1), 9 * kSecond));
  EXPECT_THAT(goals.meant_by(asked(goal_id(1))), ElementsAre(goal_id(1)));
  EXPECT_THAT(goals.meant_by(asked({}, 2 * kSecond)), ElementsAre(goal_id(2), goal_id(3)));
  EXPECT_THAT(goals.meant_by(asked(goal_id(1), kSecond)), ElementsAre(goal_id(1), goal_id(3)));
  EXPECT_THAT(goals.meant_by(asked({})), SizeIs(3));
  EXPECT_THAT(goals.meant_by(asked(goal_id(7))), IsEmpty());
  EXPECT_EQ(goals.why_none(asked(goal_id(7))), CancelGoal_Response::ERROR_UNKNOWN_GOAL_ID);
  (void)goals.set_status(goal_id(1), GoalStatus::STATUS_SUCCEEDED, 5 * kSecond);
  EXPECT_THAT(goals.meant_by(asked(goal_id(1))), IsEmpty());
  EXPECT_EQ(goals.why_none(asked(goal_id(1))), CancelGoal_Response::ERROR_GOAL_TERMINATED);
  const auto told = goals.message().status_list;
  ASSERT_THAT(told, SizeIs(3));
  EXPECT_EQ(told[0].goal_info, goals.info(goal_id(3)));
  EXPECT_EQ(told[1].status, GoalStatus::STATUS_SUCCEEDED);
}

TEST(ActionGoals, EndedOnesAreForgottenInTheEnd) {
  ActionGoals goals;
  ASSERT_TRUE(goals.add(goal_id(1), 0));
  ASSERT_TRUE(goals.add(goal_id(2), 0));
  EXPECT_THAT(goals.set_status(goal_id(1), GoalStatus::STATUS_ABORTED, kSecond), IsEmpty());
  EXPECT_THAT(goals.set_status(goal_id(2), GoalStatus::STATUS_ABORTED, 2 * kSecond + ActionGoals::kMemory),
              ElementsAre(goal_id(1)));
  EXPECT_EQ(goals.status(goal_id(1)), GoalStatus::STATUS_UNKNOWN);
  ActionGoals many;
  for (std::size_t i = 0; i < 250; ++i) {
    const GoalId id{static_cast<std::uint8_t>(i), 1};
    ASSERT_TRUE(many.add(id, kSecond)) << i;
    (void)many.set_status(id, GoalStatus::STATUS_ABORTED, kSecond);
  }
  EXPECT_THAT(many.message().status_list, SizeIs(ActionGoals::kMostGoals));
}

/// A client of an action, as rclcpp's are: services and topics one by one.
template <class Action>
class Operator {
 public:
  Operator() {
    node_.subscribe<typename Action::FeedbackMessage>(
        "/drive/_action/feedback", {},
        [this](const auto& message) { distances.push_back(message.feedback.distance_remaining); });
    node_.subscribe<action_msgs::GoalStatusArray>("/drive/_action/status", Qos::latched(),
                                                  [this](const auto& array) {
                                                    statuses.clear();
                                                    for (const auto& status : array.status_list)
                                                      statuses.push_back(status.status);
                                                  });
  }
  [[nodiscard]] bool ready() const { return send_.ready() && cancel_.ready() && result_.ready(); }
  void send(const GoalId& id, double x) {
    typename Action::SendGoalRequest request;
    request.goal_id.uuid = id;
    request.goal.pose.pose.position.x = x;
    send_.call(request, [this, id](const auto& response) {
      accepted.push_back(response.accepted);
      typename Action::GetResultRequest wanted;
      wanted.goal_id.uuid = id;
      result_.call(wanted, [this](const auto& result) { results.push_back(result); });
    });
  }
  void cancel(const GoalId& id) {
    CancelGoal_Request request;
    request.goal_info.goal_id.uuid = id;
    cancel_.call(request, [this](const auto& response) { cancelled.push_back(response); });
  }

  std::vector<float> distances;
  std::vector<std::int8_t> statuses;
  std::vector<bool> accepted;
  std::vector<CancelGoal_Response> cancelled;
  std::vector<typename Action::GetResultResponse> results;
  Process process;

 private:
  Node node_{process.context, process.executor, {"operator"}};
  Client<typename Action::SendGoalRequest, typename Action::SendGoalResponse> send_ =
      node_.client<typename Action::SendGoalRequest, typename Action::SendGoalResponse>(
          "/drive/_action/send_goal");
  Client<CancelGoal_Request, CancelGoal_Response> cancel_ =
      node_.client<CancelGoal_Request, CancelGoal_Response>("/drive/_action/cancel_goal");
  Client<typename Action::GetResultRequest, typename Action::GetResultResponse> result_ =
      node_.client<typename Action::GetResultRequest, typename Action::GetResultResponse>(
          "/drive/_action/get_result");
};

TEST(ActionServer, RunsGoals) {
  using Action = nav2_msgs::NavigateToPose;
  Process robot;
  Node node{robot.context, robot.executor, {"planner"}};
  std::vector<GoalId> to_cancel;
  ActionServer<Action> server{node, "drive",
                              [](const GoalId&, const auto& goal) { return goal.pose.pose.position.x > 0.0; },
                              [&](const GoalId& id) { to_cancel.push_back(id); }};
  Operator<Action> people;
  const auto wait = [&](auto done) { return run_until({&robot, &people.process}, done); };
  ASSERT_TRUE(wait([&] { return people.ready(); }));

  people.send(goal_id(1), 1.0);
  ASSERT_TRUE(wait([&] { return !people.accepted.empty() && people.statuses.size() == 1; }));
  EXPECT_TRUE(people.accepted[0]);
  EXPECT_THAT(people.statuses, ElementsAre(GoalStatus::STATUS_EXECUTING));
  Action::Feedback feedback;
  feedback.distance_remaining = 0.5F;
  server.tell(goal_id(1), feedback);
  ASSERT_TRUE(wait([&] { return !people.distances.empty(); }));
  EXPECT_THAT(people.results, IsEmpty());
  Action::Result result;
  result.error_msg = "well";
  server.end(goal_id(1), GoalStatus::STATUS_SUCCEEDED, result);
  ASSERT_TRUE(wait([&] { return people.results.size() == 1; }));
  EXPECT_EQ(people.results[0].status, GoalStatus::STATUS_SUCCEEDED);
  EXPECT_EQ(people.results[0].result.error_msg, "well");

  people.send(goal_id(2), -1.0);  // refused; and so it has no result
  ASSERT_TRUE(wait([&] { return people.accepted.size() == 2 && people.results.size() == 2; }));
  EXPECT_FALSE(people.accepted[1]);
  EXPECT_EQ(people.results[1].status, GoalStatus::STATUS_UNKNOWN);

  people.send(goal_id(3), 1.0);
  ASSERT_TRUE(wait([&] { return people.accepted.size() == 3; }));
  people.cancel(goal_id(3));
  people.cancel(goal_id(1));
  ASSERT_TRUE(wait([&] { return people.cancelled.size() == 2; }));
  EXPECT_THAT(to_cancel, ElementsAre(goal_id(3)));
  EXPECT_EQ(people.cancelled[1].return_code, CancelGoal_Response::ERROR_GOAL_TERMINATED);
  EXPECT_EQ(server.goals().status(goal_id(3)), GoalStatus::STATUS_CANCELING);
  server.end(goal_id(3), GoalStatus::STATUS_CANCELED, {});
  ASSERT_TRUE(wait([&] { return people.results.size() == 3; }));
  EXPECT_EQ(people.results[2].status, GoalStatus::STATUS_CANCELED);
}

TEST(ActionServer, HumblesResultIsEmpty) {
  EXPECT_EQ(to_cdr(humble::nav2_msgs::NavigateToPose::GetResultResponse{}), (Bytes{0, 1, 0, 0, 0, 0, 0, 0}));
  EXPECT_STREQ(humble::nav2_msgs::NavigateToPose::Result::kName, "NavigateToPose_Result");
}

}  // namespace
}  // namespace ros2
