#include "spf_empc_ros/parameter_store.hpp"

namespace spf_empc_ros {

ParameterStore::ParameterStore(const ros::NodeHandle& own) : own_{own}, thread_{[this] { write_all(); }} {}

ParameterStore::~ParameterStore() {
  {
    const std::lock_guard<std::mutex> lock{mutex_};
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void ParameterStore::set(const std::string& name, const XmlRpc::XmlRpcValue& value) {
  {
    const std::lock_guard<std::mutex> lock{mutex_};
    waiting_[name] = value;
  }
  changed_.notify_one();
}

void ParameterStore::erase(const std::string& name) {
  {
    const std::lock_guard<std::mutex> lock{mutex_};
    waiting_[name].reset();
  }
  changed_.notify_one();
}

void ParameterStore::write_all() {
  std::unique_lock<std::mutex> lock{mutex_};
  while (true) {
    changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const auto next = waiting_.extract(waiting_.begin());
    lock.unlock();
    // Waits for the master, and no longer than the node lives.
    if (next.mapped())
      own_.setParam(next.key(), *next.mapped());
    else
      own_.deleteParam(next.key());
    lock.lock();
  }
}

}  // namespace spf_empc_ros
