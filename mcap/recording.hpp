// A recording of a fleet: ROS 2's messages as CDR with their definitions, and JSON for what no message of
// ROS holds. Channels come up as they are written.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <ros2_messages/builtin_interfaces/Time.hpp>
#include <string>

#include "mcap/writer.hpp"
#include "ros2/messages/cdr.hpp"

namespace spf::mcap {

/// Times of a world as those of messages.
class RecordClock {
 public:
  /// `epoch` [ns since 1970] of the world's zero; a whole second.
  explicit RecordClock(std::uint64_t epoch = 0) : epoch_{epoch} {}

  /// Nothing is before the epoch.
  [[nodiscard]] std::uint64_t nanoseconds(double time) const {
    return epoch_ + static_cast<std::uint64_t>(std::llround(std::fmax(time, 0.0) * 1e9));
  }
  [[nodiscard]] ros2::builtin_interfaces::Time time(double time) const {
    const std::uint64_t all = nanoseconds(time);
    ros2::builtin_interfaces::Time stamp;
    stamp.sec = static_cast<std::int32_t>(all / 1'000'000'000U);
    stamp.nanosec = static_cast<std::uint32_t>(all % 1'000'000'000U);
    return stamp;
  }

 private:
  std::uint64_t epoch_;
};

class Recording {
 public:
  /// Throws std::runtime_error when the file cannot be written.
  explicit Recording(const std::string& path, const RecordClock& clock = RecordClock{})
      : writer_{path, "ros2"}, clock_{clock} {}

  [[nodiscard]] const RecordClock& clock() const { return clock_; }

  /// `time` [s] of the world.
  template <class Message>
  void add(const std::string& topic, double time, const Message& message) {
    const auto known = channels_.find(topic);
    const Writer::Id channel = known != channels_.end() ? known->second : open<Message>(topic);
    const ros2::Bytes bytes = ros2::to_cdr(message);
    writer_.write(channel, clock_.nanoseconds(time),
                  {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  /// An object; its `schema` says by name what it is, and is not checked.
  void add_json(const std::string& topic, const std::string& schema, double time,
                const nlohmann::json& object);

  /// Throws std::runtime_error when something could not be written.
  void close() { writer_.close(); }

 private:
  template <class Message>
  Writer::Id open(const std::string& topic) {
    const std::string name = std::string{Message::kPackage} + "/msg/" + Message::kName;
    const Writer::Id schema = writer_.add_schema({name, "ros2msg", Message::kDefinition});
    return channels_[topic] = writer_.add_channel(schema, topic, "cdr");
  }

  Writer writer_;
  RecordClock clock_;
  std::map<std::string, Writer::Id> channels_;
};

}  // namespace spf::mcap
