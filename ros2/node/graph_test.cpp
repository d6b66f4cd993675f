// What a node announces, read by a plain program of CycloneDDS, against what ROS 2 Jazzy's nodes were seen to
// announce.
#include "ros2/node/graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <ros2_messages/nav_msgs/OccupancyGrid.hpp>
#include <ros2_messages/sensor_msgs/LaserScan.hpp>

#include "ros2/node/bench_test.hpp"

namespace ros2 {
namespace {

struct Seen {
  std::string type, user_data;
  dds_reliability_kind_t reliability{};
  dds_duration_t blocking = 0, lifespan = DDS_INFINITY;
  dds_durability_kind_t durability{};
  dds_history_kind_t history{};
  int depth = 0;
  std::vector<dds_data_representation_id_t> representations;
};

std::string bytes_from(const dds_qos_t* qos, bool (*get)(const dds_qos_t*, void**, size_t*)) {
  void* data = nullptr;
  size_t size = 0;
  if (!get(qos, &data, &size) || data == nullptr) return {};
  std::string text(static_cast<const char*>(data), size);
  dds_free(data);
  return text;
}

Seen seen_of(const dds_builtintopic_endpoint_t& endpoint) {
  Seen seen;
  seen.type = endpoint.type_name;
  const dds_qos_t* qos = endpoint.qos;
  seen.user_data = bytes_from(qos, dds_qget_userdata);
  EXPECT_EQ(bytes_from(qos, dds_qget_topicdata) + bytes_from(qos, dds_qget_groupdata), "");
  dds_qget_reliability(qos, &seen.reliability, &seen.blocking);
  dds_qget_durability(qos, &seen.durability);
  dds_qget_history(qos, &seen.history, &seen.depth);
  dds_qget_lifespan(qos, &seen.lifespan);
  std::uint32_t count = 0;
  dds_data_representation_id_t* values = nullptr;
  if (dds_qget_data_representation(qos, &count, &values)) {
    seen.representations.assign(values, values + count);
    dds_free(values);
  }
  return seen;
}

/// Endpoints of one participant, as another one has discovered them.
class Dumper {
 public:
  explicit Dumper(const Participant& participant)
      : writers_{dds_create_reader(participant.entity(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
                 "dump"},
        readers_{
            dds_create_reader(participant.entity(), DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, nullptr, nullptr),
            "dump"},
        people_{dds_create_reader(participant.entity(), DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr),
                "dump"} {}

  void look(const Gid& participant) {
    take(writers_, participant, writers);
    take(readers_, participant, readers);
    void* sample = nullptr;
    dds_sample_info_t info;
    while (dds_take(people_.get(), &sample, &info, 1, 1) > 0) {
      const auto* person = static_cast<const dds_builtintopic_participant_t*>(sample);
      if (info.valid_data && std::equal(participant.begin(), participant.end(), person->key.v))
        enclave = bytes_from(person->qos, dds_qget_userdata);
      dds_return_loan(people_.get(), &sample, 1);
    }
  }

  std::map<std::string, Seen> writers, readers;
  std::string enclave;

 private:
  static void take(const Entity& from, const Gid& participant, std::map<std::string, Seen>& to) {
    void* sample = nullptr;
    dds_sample_info_t info;
    while (dds_take(from.get(), &sample, &info, 1, 1) > 0) {
      const auto* endpoint = static_cast<const dds_builtintopic_endpoint_t*>(sample);
      if (info.valid_data && std::equal(participant.begin(), participant.end(), endpoint->participant_key.v))
        to[endpoint->topic_name] = seen_of(*endpoint);
      dds_return_loan(from.get(), &sample, 1);
    }
  }
  Entity writers_, readers_, people_;
};

void expect_qos(const std::map<std::string, Seen>& endpoints, const std::string& topic, const Qos& qos) {
  SCOPED_TRACE(topic);
  const auto found = endpoints.find(topic);
  ASSERT_NE(found, endpoints.end());
  const Seen& seen = found->second;
  EXPECT_EQ(seen.reliability, qos.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT);
  EXPECT_EQ(seen.blocking, qos.reliable ? DDS_INFINITY : 0);
  EXPECT_EQ(seen.durability, qos.transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  EXPECT_EQ(seen.history, DDS_HISTORY_KEEP_LAST);
  EXPECT_EQ(seen.depth, qos.depth);
  EXPECT_EQ(seen.lifespan,
            qos.lifespan > 0.0 ? static_cast<dds_duration_t>(qos.lifespan * 1e9) : DDS_INFINITY);
  EXPECT_THAT(seen.representations, testing::ElementsAre(DDS_DATA_REPRESENTATION_XCDR1));
}

TEST(Graph, ANodeAnnouncesItselfAsJazzysDo) {
  Process robot{{"--ros-args", "-p", "use_sim_time:=true"}}, people;
  Node node{robot.context, robot.executor, {"planner", "/robot0"}};
  const auto map = node.advertise<nav_msgs::OccupancyGrid>("/map", Qos::latched());
  node.subscribe<sensor_msgs::LaserScan>("scan", Qos::sensor_data(), [](const auto&) {});

  Dumper dumper{people.context.participant};
  const Gid gid = robot.context.participant.gid();
  ASSERT_TRUE(run_until({&robot, &people},
                        [&] {
                          dumper.look(gid);
                          return dumper.writers.size() >= 10 && dumper.readers.size() >= 8;
                        }))
      << dumper.writers.size() << " writers, " << dumper.readers.size() << " readers";

  EXPECT_EQ(dumper.enclave, "enclave=/;");
  EXPECT_EQ(dumper.writers.size(), 10U);  // discovery, rosout, events, map, six replies
  EXPECT_EQ(dumper.readers.size(), 8U);   // clock, scan, six requests
  expect_qos(dumper.writers, "ros_discovery_info", Qos::latched());
  expect_qos(dumper.writers, "rt/rosout", Qos::rosout());
  expect_qos(dumper.writers, "rt/parameter_events", Qos::parameters());
  expect_qos(dumper.writers, "rt/map", Qos::latched());
  expect_qos(dumper.readers, "rt/clock", Qos::clock());
  expect_qos(dumper.readers, "rt/robot0/scan", Qos::sensor_data());
  for (const char* service : {"get_parameters", "get_parameter_types", "set_parameters",
                              "set_parameters_atomically", "describe_parameters", "list_parameters"}) {
    const std::string name = std::string{"/robot0/planner/"} + service;
    expect_qos(dumper.readers, "rq" + name + "Request", Qos::parameters());
    expect_qos(dumper.writers, "rr" + name + "Reply", Qos::parameters());
    const std::string asked = dumper.readers["rq" + name + "Request"].user_data;
    const std::string answered = dumper.writers["rr" + name + "Reply"].user_data;
    ASSERT_TRUE(user_data_value(asked, "serviceid")) << asked;
    EXPECT_EQ(user_data_value(asked, "serviceid"), user_data_value(answered, "serviceid"));
  }
  EXPECT_EQ(dumper.writers["rt/map"].type, "nav_msgs::msg::dds_::OccupancyGrid_");
  EXPECT_EQ(dumper.writers["rt/map"].user_data,
            "typehash=RIHS01_8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7;");
  EXPECT_EQ(dumper.writers["ros_discovery_info"].type, "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_");
  EXPECT_EQ(dumper.writers["ros_discovery_info"].user_data,
            "typehash=RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e;");
  EXPECT_EQ(dumper.readers["rq/robot0/planner/get_parametersRequest"].type,
            "rcl_interfaces::srv::dds_::GetParameters_Request_");
}

/// What ros_discovery_info says last.
rmw_dds_common::ParticipantEntitiesInfo told_by(Process& robot, Process& people, std::size_t nodes) {
  DdsTopic topic = message_topic<rmw_dds_common::ParticipantEntitiesInfo>("");
  topic.name = "ros_discovery_info";
  Qos qos = Qos::latched();
  qos.depth = 0;
  Reader reader{people.context.participant.entity(), topic, qos};
  rmw_dds_common::ParticipantEntitiesInfo last;
  const rmw_dds_common::ParticipantEntitiesInfo mine = robot.context.graph.info();
  EXPECT_TRUE(run_until({&robot, &people}, [&] {
    reader.take([&](ByteView bytes, dds_instance_handle_t) {
      rmw_dds_common::ParticipantEntitiesInfo info;
      std::string fault;
      if (from_cdr(bytes, info, fault) && info.gid.data == mine.gid.data) last = info;
    });
    return last.node_entities_info_seq.size() == nodes;
  }));
  return last;
}

TEST(Graph, TellsWhichNodesThereAreAndWhatIsTheirs) {
  Process robot, people;
  Node planner{robot.context, robot.executor, {"planner", "/robot0"}};
  {
    Node tracker{robot.context, robot.executor, {"tracker", "/robot0"}};
    const auto told = told_by(robot, people, 2);
    ASSERT_EQ(told.node_entities_info_seq.size(), 2U);
    EXPECT_EQ(told.node_entities_info_seq[1].node_name, "tracker");
    EXPECT_EQ(told.node_entities_info_seq[1].node_namespace, "/robot0");
    EXPECT_EQ(told.node_entities_info_seq[1].writer_gid_seq.size(), 8U);
    EXPECT_EQ(told.node_entities_info_seq[1].reader_gid_seq.size(), 6U);
    EXPECT_EQ(told.gid.data, robot.context.participant.gid());
    // Ids of writers end in 03, of readers in 04 (DDSI-RTPS 9.3.1).
    for (const auto& gid : told.node_entities_info_seq[1].writer_gid_seq) EXPECT_EQ(gid.data[15], 0x03);
    for (const auto& gid : told.node_entities_info_seq[1].reader_gid_seq) EXPECT_EQ(gid.data[15], 0x04);
  }
  EXPECT_EQ(told_by(robot, people, 1).node_entities_info_seq[0].node_name, "planner");
}

rmw_dds_common::ParticipantEntitiesInfo one_node() {
  rmw_dds_common::ParticipantEntitiesInfo info;
  info.gid.data[15] = 0xc1;
  info.node_entities_info_seq.resize(1);
  info.node_entities_info_seq[0].node_namespace = "/robot0";
  info.node_entities_info_seq[0].node_name = "rcl_node";
  info.node_entities_info_seq[0].reader_gid_seq.resize(12);
  info.node_entities_info_seq[0].writer_gid_seq.resize(14);
  return info;
}

TEST(Graph, ASampleHasTheLayoutOfJazzys) {
  const Bytes bytes = graph_sample(one_node(), false);
  ASSERT_EQ(bytes.size(), 476U);
  EXPECT_EQ(bytes[19], 0xc1);
  EXPECT_EQ(bytes[20], 1);
  EXPECT_EQ(bytes[24], 8);
  EXPECT_EQ(bytes[36], 9);
  EXPECT_EQ(bytes[52], 12);
  EXPECT_EQ(bytes[248], 14);
}

TEST(Graph, HumblesGidsAreWiderByZeros) {
  rmw_dds_common::ParticipantEntitiesInfo info = one_node();
  info.node_entities_info_seq[0].reader_gid_seq[0].data.fill(0xaa);
  const Bytes bytes = graph_sample(info, true);
  ASSERT_EQ(bytes.size(), 476U + 8U * (1 + 12 + 14));
  EXPECT_EQ(bytes[28], 1);  // nodes, after 24 bytes
  EXPECT_EQ(bytes[60], 12);
  EXPECT_EQ(bytes[64 + 15], 0xaa);
  for (std::size_t i = 16; i < 24; ++i) EXPECT_EQ(bytes[64 + i], 0);
}

}  // namespace
}  // namespace ros2
