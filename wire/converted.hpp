// Messages to values and back, for any messages that have the fields of ROS's: of ROS 1, of ROS 2, of tests.
// What comes from outside is a value, or a refusal with its reason; nothing throws. `read_...` makes values
// of messages, `fill` writes values into them. A Clock is anything with `seconds(stamp)`, the host's time [s]
// of a stamp, and `time(seconds)`, the stamp of such a time.
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace spf::wire {

/// A value, or why there is none.
template <class Value>
struct Converted {
  std::optional<Value> value;
  std::string refusal;

  [[nodiscard]] static Converted refused(std::string why) { return {std::nullopt, std::move(why)}; }
  explicit operator bool() const { return value.has_value(); }
  const Value& operator*() const { return *value; }
  const Value* operator->() const { return &*value; }
};

/// "/map" and "map" are the same.
[[nodiscard]] inline std::string plain_frame(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

/// Of two names; then the refusal says so.
[[nodiscard]] inline bool frames_differ(const std::string& is, const std::string& must,
                                        std::string& refusal) {
  if (plain_frame(is) == plain_frame(must)) return false;
  refusal = "its frame is '" + is + "', the fleet's is '" + must + "'";
  return true;
}

}  // namespace spf::wire
