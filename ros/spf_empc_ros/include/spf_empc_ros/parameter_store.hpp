// Writes a node's own parameters from a thread of its own: the master may be slow, or gone, and a planner
// must not wait for it.
#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace spf_empc_ros {

class ParameterStore {
 public:
  /// `own` is the node's private namespace.
  explicit ParameterStore(const ros::NodeHandle& own);
  ~ParameterStore();
  ParameterStore(const ParameterStore&) = delete;
  ParameterStore& operator=(const ParameterStore&) = delete;

  /// Returns at once. Of several values of one parameter that wait to be written the last one is.
  void set(const std::string& name, const XmlRpc::XmlRpcValue& value);
  void erase(const std::string& name);

 private:
  void write_all();

  ros::NodeHandle own_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, std::optional<XmlRpc::XmlRpcValue>> waiting_;  // none: to be erased
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace spf_empc_ros
