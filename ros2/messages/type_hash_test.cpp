// Type hashes of ROS 2 Jazzy (rosidl 4.6.5): those that its own generator gives, and that its nodes announce.
#include <gtest/gtest.h>

#include <ros2_messages/action_msgs/CancelGoal.hpp>
#include <ros2_messages/action_msgs/GoalStatusArray.hpp>
#include <ros2_messages/diagnostic_msgs/DiagnosticArray.hpp>
#include <ros2_messages/geometry_msgs/PolygonStamped.hpp>
#include <ros2_messages/geometry_msgs/PoseArray.hpp>
#include <ros2_messages/geometry_msgs/PoseStamped.hpp>
#include <ros2_messages/geometry_msgs/PoseWithCovarianceStamped.hpp>
#include <ros2_messages/geometry_msgs/Twist.hpp>
#include <ros2_messages/geometry_msgs/TwistStamped.hpp>
#include <ros2_messages/nav2_msgs/NavigateToPose.hpp>
#include <ros2_messages/nav_msgs/OccupancyGrid.hpp>
#include <ros2_messages/nav_msgs/Odometry.hpp>
#include <ros2_messages/nav_msgs/Path.hpp>
#include <ros2_messages/rcl_interfaces/DescribeParameters.hpp>
#include <ros2_messages/rcl_interfaces/GetParameterTypes.hpp>
#include <ros2_messages/rcl_interfaces/GetParameters.hpp>
#include <ros2_messages/rcl_interfaces/ListParameters.hpp>
#include <ros2_messages/rcl_interfaces/Log.hpp>
#include <ros2_messages/rcl_interfaces/ParameterEvent.hpp>
#include <ros2_messages/rcl_interfaces/SetParameters.hpp>
#include <ros2_messages/rcl_interfaces/SetParametersAtomically.hpp>
#include <ros2_messages/rmw_dds_common/ParticipantEntitiesInfo.hpp>
#include <ros2_messages/rosgraph_msgs/Clock.hpp>
#include <ros2_messages/sensor_msgs/Imu.hpp>
#include <ros2_messages/sensor_msgs/JointState.hpp>
#include <ros2_messages/sensor_msgs/LaserScan.hpp>
#include <ros2_messages/sensor_msgs/PointCloud2.hpp>
#include <ros2_messages/std_msgs/Bool.hpp>
#include <ros2_messages/std_msgs/Empty.hpp>
#include <ros2_messages/std_msgs/Float64.hpp>
#include <ros2_messages/std_msgs/String.hpp>
#include <ros2_messages/std_srvs/Empty.hpp>
#include <ros2_messages/std_srvs/SetBool.hpp>
#include <ros2_messages/std_srvs/Trigger.hpp>
#include <ros2_messages/tf2_msgs/TFMessage.hpp>
#include <ros2_messages/visualization_msgs/Marker.hpp>
#include <ros2_messages/visualization_msgs/MarkerArray.hpp>

#include <string>

namespace ros2 {
namespace {

template <class Message>
void expect_hash(const std::string& name, const std::string& hash) {
  EXPECT_EQ(std::string{Message::kPackage} + "/" + Message::kKind + "/" + Message::kName, name);
  EXPECT_EQ(Message::kTypeHash, "RIHS01_" + hash) << name;
}

TEST(TypeHash, IsThatOfJazzy) {
  expect_hash<nav_msgs::Odometry>("nav_msgs/msg/Odometry",
                                  "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0");
  expect_hash<nav_msgs::OccupancyGrid>("nav_msgs/msg/OccupancyGrid",
                                       "8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7");
  expect_hash<nav_msgs::Path>("nav_msgs/msg/Path",
                              "1957a5bb3cee5da65c4e52e52b65a93df227efce4c20f8458b36e73066ca334b");
  expect_hash<sensor_msgs::LaserScan>("sensor_msgs/msg/LaserScan",
                                      "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828");
  expect_hash<geometry_msgs::Twist>("geometry_msgs/msg/Twist",
                                    "9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a");
  expect_hash<geometry_msgs::PoseStamped>("geometry_msgs/msg/PoseStamped",
                                          "10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8");
  expect_hash<tf2_msgs::TFMessage>("tf2_msgs/msg/TFMessage",
                                   "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087");
  expect_hash<visualization_msgs::MarkerArray>(
      "visualization_msgs/msg/MarkerArray",
      "86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf");
  expect_hash<diagnostic_msgs::DiagnosticArray>(
      "diagnostic_msgs/msg/DiagnosticArray",
      "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e");
  expect_hash<rosgraph_msgs::Clock>("rosgraph_msgs/msg/Clock",
                                    "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564");
  expect_hash<rmw_dds_common::ParticipantEntitiesInfo>(
      "rmw_dds_common/msg/ParticipantEntitiesInfo",
      "91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e");
  expect_hash<rcl_interfaces::Log>("rcl_interfaces/msg/Log",
                                   "e28ce254ca8abc06abf92773b74602cdbf116ed34fbaf294fb9f81da9f318eac");
  expect_hash<rcl_interfaces::ParameterEvent>(
      "rcl_interfaces/msg/ParameterEvent",
      "043e627780fcad87a22d225bc2a037361dba713fca6a6b9f4b869a5aa0393204");
  expect_hash<action_msgs::GoalStatusArray>(
      "action_msgs/msg/GoalStatusArray", "6c1684b00f177d37438febe6e709fc4e2b0d4248dca4854946f9ed8b30cda83e");
  expect_hash<visualization_msgs::Marker>("visualization_msgs/msg/Marker",
                                          "45b13ccf791f225962bf74e746f9644518855d783a6f42ba0cc14fde2b4f3ce0");
  expect_hash<geometry_msgs::TwistStamped>(
      "geometry_msgs/msg/TwistStamped", "5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64");
  expect_hash<geometry_msgs::PoseWithCovarianceStamped>(
      "geometry_msgs/msg/PoseWithCovarianceStamped",
      "26432f9803e43727d3c8f668d1fdb3c630f548af631e2f4e31382371bfea3b6e");
  expect_hash<geometry_msgs::PoseArray>("geometry_msgs/msg/PoseArray",
                                        "af0cc36d190e104d546d168d6b39df04fa4b4ccecf59cb4c9ed328d3d5004aa0");
  expect_hash<geometry_msgs::PolygonStamped>(
      "geometry_msgs/msg/PolygonStamped", "b7cf07932f1523d4b4088075945c1a0141f7cd21da87cc940fc61652e9138b46");
  expect_hash<sensor_msgs::PointCloud2>("sensor_msgs/msg/PointCloud2",
                                        "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5");
  expect_hash<sensor_msgs::Imu>("sensor_msgs/msg/Imu",
                                "7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b");
  expect_hash<sensor_msgs::JointState>("sensor_msgs/msg/JointState",
                                       "a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e");
  expect_hash<std_msgs::String>("std_msgs/msg/String",
                                "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18");
  expect_hash<std_msgs::Bool>("std_msgs/msg/Bool",
                              "feb91e995ff9ebd09c0cb3d2aed18b11077585839fb5db80193b62d74528f6c9");
  expect_hash<std_msgs::Float64>("std_msgs/msg/Float64",
                                 "705ba9c3d1a09df43737eb67095534de36fd426c0587779bda2bc51fe790182a");
  expect_hash<std_msgs::Empty>("std_msgs/msg/Empty",
                               "20b625256f32d5dbc0d04fee44f43c41e51c70d3502f84b4a08e7a9c26a96312");
  expect_hash<std_srvs::SetBool_Request>("std_srvs/srv/SetBool_Request",
                                         "c62fbb99d94e1b25e8ef9e109f9581956bb1b3361a45a4e5810c36a90d29932e");
  expect_hash<std_srvs::SetBool_Response>("std_srvs/srv/SetBool_Response",
                                          "d0814e7f7b4880ab77e9c57426c7aa1562ab69f11eef8e2e968812f9cbd0b059");
  expect_hash<std_srvs::Trigger_Request>("std_srvs/srv/Trigger_Request",
                                         "d010825374ce8918e72bfd826c82603e60f45419e932ea976f807b74a863a199");
  expect_hash<std_srvs::Trigger_Response>("std_srvs/srv/Trigger_Response",
                                          "2d946c21e2fc3f1e9ca6986a8191d85fcc70097a8bb7771a053564bc47009cdf");
  expect_hash<std_srvs::Empty_Request>("std_srvs/srv/Empty_Request",
                                       "458eaf200a3f63d9cc53d19436edebc0c140ef4c93ca75d5bd4ce19fd7759e35");
  expect_hash<std_srvs::Empty_Response>("std_srvs/srv/Empty_Response",
                                        "0a2858b3f60df644a61d0fa44cfc923a3d3628e0ad9c8ad8534b1a2c92a413dc");
  expect_hash<action_msgs::CancelGoal_Request>(
      "action_msgs/srv/CancelGoal_Request",
      "3d3c84653c1f96918086887e1dcb236faec88b81a5b14fd4cf4840065bcdf8af");
  expect_hash<action_msgs::CancelGoal_Response>(
      "action_msgs/srv/CancelGoal_Response",
      "35e682cf3f510e83c70a82a4aac888496dedee56773bf9d8e5e0aa81f9e1c960");
  expect_hash<nav2_msgs::NavigateToPose_SendGoal_Request>(
      "nav2_msgs/action/NavigateToPose_SendGoal_Request",
      "e9381f2acfe9fa8c4838a277d0cde28a93c483564827b9f13496b9c2092e4f09");
  expect_hash<nav2_msgs::NavigateToPose_SendGoal_Response>(
      "nav2_msgs/action/NavigateToPose_SendGoal_Response",
      "99f97fcbb07daf024df4b8c3f02f19ce7fa3183fcedfb76b8772a61a371a55fa");
  expect_hash<nav2_msgs::NavigateToPose_GetResult_Request>(
      "nav2_msgs/action/NavigateToPose_GetResult_Request",
      "106d3457cf0db4c4a8d3373bab3ff6aa8ba8ad99ae6392ce9784830a7d04ac93");
  expect_hash<nav2_msgs::NavigateToPose_GetResult_Response>(
      "nav2_msgs/action/NavigateToPose_GetResult_Response",
      "c59f178c377de5318919c00bdbf7884cb3b185acfdffceba6c9f161e0aa3cc81");
  expect_hash<nav2_msgs::NavigateToPose_FeedbackMessage>(
      "nav2_msgs/action/NavigateToPose_FeedbackMessage",
      "9d1f6fa2eb975ce733b419ac2e97b134d8ff92b6478b6559feed9a50bdfd82b3");
  expect_hash<rcl_interfaces::GetParameters_Request>(
      "rcl_interfaces/srv/GetParameters_Request",
      "135a9e1c3d7cebef792f6687d7ddf99949b21a0bd9a320d863a9110a3f5cf4d6");
  expect_hash<rcl_interfaces::GetParameters_Response>(
      "rcl_interfaces/srv/GetParameters_Response",
      "9fa773b46e39cc5d02db6224d8fd520bb9caeeffc2b27c96c1e59431baba9f2a");
  expect_hash<rcl_interfaces::GetParameterTypes_Request>(
      "rcl_interfaces/srv/GetParameterTypes_Request",
      "87d7ec5ef545d4daa289d500025d31fb2437bc8b8365ca367161c4dac4be33fd");
  expect_hash<rcl_interfaces::GetParameterTypes_Response>(
      "rcl_interfaces/srv/GetParameterTypes_Response",
      "ac1335dce67c478e669434f6ac2fbff34fcd529580f272d3006785ba8b54e47f");
  expect_hash<rcl_interfaces::SetParameters_Request>(
      "rcl_interfaces/srv/SetParameters_Request",
      "130d46386b7e84ea9ecf60608a4d83cbe5e5cb7c6cc5b712b7a4e3a6c254e932");
  expect_hash<rcl_interfaces::SetParameters_Response>(
      "rcl_interfaces/srv/SetParameters_Response",
      "7a0e8140a0b8d98308fa81a5403a766e610af29a239caf54b7553227906fc266");
  expect_hash<rcl_interfaces::SetParametersAtomically_Request>(
      "rcl_interfaces/srv/SetParametersAtomically_Request",
      "db0bd950ed5ed867a0e90b225e44dea382d762c0762ff3e0ee842190042a59e5");
  expect_hash<rcl_interfaces::SetParametersAtomically_Response>(
      "rcl_interfaces/srv/SetParametersAtomically_Response",
      "31b1a38c5b0b9d893ee24da45f69638f4561c78461d82d52750f429b534502b8");
  expect_hash<rcl_interfaces::DescribeParameters_Request>(
      "rcl_interfaces/srv/DescribeParameters_Request",
      "05dd1c2bc87dec2627105c8070d6f9725c781a4f2ab852975bf105462b82b644");
  expect_hash<rcl_interfaces::DescribeParameters_Response>(
      "rcl_interfaces/srv/DescribeParameters_Response",
      "ad6747319613c6131589e062e095b469a46cc764f7d0f12a001a49e6cd893995");
  expect_hash<rcl_interfaces::ListParameters_Request>(
      "rcl_interfaces/srv/ListParameters_Request",
      "a1b0b5d6b967a5b8ac5bc8563c3ea678f349e312a6a4967227c5a96bc5ce38df");
  expect_hash<rcl_interfaces::ListParameters_Response>(
      "rcl_interfaces/srv/ListParameters_Response",
      "31b937b82de3612426be79f231e386259f97e8dc843e3f2845288b4bfa296bdd");
}

}  // namespace
}  // namespace ros2
