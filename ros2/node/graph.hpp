// Tells others which nodes a participant has, and which endpoints belong to which: the topic
// ros_discovery_info, which `ros2 node list` and all the rest of the graph is read from.
#pragma once

#include <ros2_messages/rmw_dds_common/ParticipantEntitiesInfo.hpp>

#include "ros2/node/names.hpp"
#include "ros2/node/participant.hpp"

namespace ros2 {

/// The sample as it travels, with gids of 16 or 24 bytes: the last 8 are then 0.
[[nodiscard]] Bytes graph_sample(const rmw_dds_common::ParticipantEntitiesInfo& info, bool wide_gids);

class Graph {
 public:
  explicit Graph(const Participant& participant);

  /// Numbers of nodes stay. Endpoints are told of by announce(), or by the next change.
  [[nodiscard]] std::size_t add_node(const NodeName& node);
  void remove_node(std::size_t number);
  void add_writer(std::size_t node, const Gid& gid);
  void add_reader(std::size_t node, const Gid& gid);
  /// What is told replaces all that was.
  void announce();

  [[nodiscard]] rmw_dds_common::ParticipantEntitiesInfo info() const;

 private:
  struct Entry {
    bool alive = true;
    rmw_dds_common::NodeEntitiesInfo info;
  };
  bool wide_gids_;
  Gid own_;
  std::vector<Entry> nodes_;
  Writer writer_;
};

}  // namespace ros2
