// A peer's message on its way to those who hear it.
#pragma once

#include "spf/math/shared.hpp"
#include "spf/world/trajectory_message.hpp"

namespace spf {

/// Its trajectory is checked once and stands in memory once, however many hear it. Copying shares.
class HeardMessage {
 public:
  HeardMessage(const TrajectoryMessage& message);  // NOLINT(google-explicit-constructor): it is that message

  [[nodiscard]] const TrajectoryMessage* operator->() const { return &*message_; }
  operator const TrajectoryMessage&() const {  // NOLINT(google-explicit-constructor): as above
    return message_;
  }
  [[nodiscard]] Shared<Trajectory> trajectory() const { return {message_, message_->trajectory}; }
  /// Whether there is a trajectory on which, from its start to its end, position, velocity, acceleration and
  /// heading can be reckoned with.
  [[nodiscard]] bool usable() const { return usable_; }

 private:
  Shared<TrajectoryMessage> message_;
  bool usable_;
};

}  // namespace spf
