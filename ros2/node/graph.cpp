#include "ros2/node/graph.hpp"

#include <utility>

namespace ros2 {
namespace {

using rmw_dds_common::ParticipantEntitiesInfo;

rmw_dds_common::Gid message_of(const Gid& gid) {
  rmw_dds_common::Gid message;
  message.data = gid;
  return message;
}

/// A visitor that gives gids their width.
class WideGids {
 public:
  template <class Value>
  void operator()(const char* /*name*/, const Value& value) {
    write(value);
  }
  template <class Value>
  void write(const Value& value) {
    Value::visit_fields(value, *this);
  }
  void write(const std::string& text) { writer_.write(text); }
  void write(const rmw_dds_common::Gid& gid) {
    writer_.write(gid);
    writer_.write(std::array<std::uint8_t, 8>{});
  }
  template <class Value>
  void write(const std::vector<Value>& values) {
    writer_.write(static_cast<std::uint32_t>(values.size()));
    for (const Value& value : values) write(value);
  }
  [[nodiscard]] Bytes take() { return writer_.take(); }

 private:
  CdrWriter writer_;
};

DdsTopic graph_topic() {
  DdsTopic topic = message_topic<ParticipantEntitiesInfo>("");
  topic.name = "ros_discovery_info";
  return topic;
}

}  // namespace

Bytes graph_sample(const ParticipantEntitiesInfo& info, bool wide_gids) {
  if (!wide_gids) return to_cdr(info);
  WideGids writer;
  writer.write(info);
  return writer.take();
}

Graph::Graph(const Participant& participant)
    : wide_gids_{participant.options().wide_gids},
      own_{participant.gid()},
      writer_{participant.entity(), graph_topic(), Qos::latched()} {}

std::size_t Graph::add_node(const NodeName& node) {
  Entry entry;
  entry.info.node_name = node.name;
  entry.info.node_namespace = node.ns;
  nodes_.push_back(std::move(entry));
  return nodes_.size() - 1;
}

void Graph::remove_node(std::size_t number) {
  nodes_[number] = {false, {}};
  announce();
}

void Graph::add_writer(std::size_t node, const Gid& gid) {
  nodes_[node].info.writer_gid_seq.push_back(message_of(gid));
}

void Graph::add_reader(std::size_t node, const Gid& gid) {
  nodes_[node].info.reader_gid_seq.push_back(message_of(gid));
}

ParticipantEntitiesInfo Graph::info() const {
  ParticipantEntitiesInfo info;
  info.gid = message_of(own_);
  for (const Entry& node : nodes_)
    if (node.alive) info.node_entities_info_seq.push_back(node.info);
  return info;
}

void Graph::announce() {
  writer_.write(graph_sample(info(), wide_gids_));
}

}  // namespace ros2
