// A peer's broadcast as its receivers share it.
#pragma once

#include "spf/math/shared.hpp"
#include "spf/world/trajectory_message.hpp"

namespace spf {

/// The trajectory is checked once and held in memory once, whatever the number of receivers. Copying shares.
class HeardMessage {
 public:
  HeardMessage(const TrajectoryMessage& message);  // NOLINT(google-explicit-constructor): it is one

  [[nodiscard]] const TrajectoryMessage* operator->() const { return &*message_; }
  operator const TrajectoryMessage&() const {  // NOLINT(google-explicit-constructor): as above
    return message_;
  }
  [[nodiscard]] Shared<Trajectory> trajectory() const { return {message_, message_->trajectory}; }
  /// Whether there is a trajectory on which position, velocity, acceleration and heading are believable
  /// (spf/math/believable.hpp) from start to end.
  [[nodiscard]] bool usable() const { return usable_; }

 private:
  Shared<TrajectoryMessage> message_;
  bool usable_;
};

}  // namespace spf
