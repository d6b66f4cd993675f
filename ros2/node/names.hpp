// Names of ROS 2's graph: what is valid, how a name is made whole, how it is remapped, and what DDS calls it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ros2/node/participant.hpp"

namespace ros2 {

/// A node's name and namespace: "planner", "/robot0". The root namespace is "/".
struct NodeName {
  std::string name;
  std::string ns = "/";

  /// "/robot0/planner"
  [[nodiscard]] std::string full() const { return (ns == "/" ? "" : ns) + "/" + name; }
};

/// Why a name of a node is none: letters, digits and underscores, not beginning with a digit; empty when it
/// is one.
[[nodiscard]] std::string fault_of_node_name(const std::string& name);
/// Likewise of a whole name of a topic, service or namespace: tokens like a node's name, each after a slash.
[[nodiscard]] std::string fault_of_full_name(const std::string& name);

/// "from:=to", for one node or for all. Such rules rename topics and services, and the node itself (__node,
/// __ns).
struct RemapRule {
  std::string node;  ///< name of the only node that it is for; empty: all
  std::string from;
  std::string to;
};

/// The whole name of a topic or service: relative to the node's namespace, "~" to the node, or absolute
/// already. Of the rules the first that names it counts. Throws std::invalid_argument with the name and what
/// is wrong with it.
[[nodiscard]] std::string resolved(const std::string& name, const NodeName& node,
                                   const std::vector<RemapRule>& rules);

/// A node's own name by the rules for __node (__name) and __ns.
[[nodiscard]] NodeName resolved_node(const NodeName& asked, const std::vector<RemapRule>& rules);

// ---- as DDS names it

/// "nav_msgs::msg::dds_::Odometry_"
[[nodiscard]] std::string dds_type_name(const std::string& package, const std::string& kind,
                                        const std::string& name);
template <class Message>
[[nodiscard]] std::string dds_type_name() {
  return dds_type_name(Message::kPackage, Message::kKind, Message::kName);
}

/// The topic of a message, of a service's requests and of its replies, by whole names.
template <class Message>
[[nodiscard]] DdsTopic message_topic(const std::string& name) {
  return {"rt" + name, dds_type_name<Message>(), std::string{"typehash="} + Message::kTypeHash + ";"};
}
/// `end` such as "serviceid=...;" comes before the type's hash.
template <class Request>
[[nodiscard]] DdsTopic request_topic(const std::string& name, const std::string& end) {
  return {"rq" + name + "Request", dds_type_name<Request>(), end + "typehash=" + Request::kTypeHash + ";"};
}
template <class Response>
[[nodiscard]] DdsTopic reply_topic(const std::string& name, const std::string& end) {
  return {"rr" + name + "Reply", dds_type_name<Response>(), end + "typehash=" + Response::kTypeHash + ";"};
}

/// The value of a key in USER_DATA ("key=value;key=value;"); nothing when it is not there.
[[nodiscard]] std::optional<std::string> user_data_value(const std::string& user_data,
                                                         const std::string& key);

}  // namespace ros2
