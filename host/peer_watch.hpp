// Which peers are at odds with this robot, and what becomes of what they say: one that has the same number,
// or whose clock is off, is kept away from as from a stranger, who goes first and whose word masks
// nothing; one that speaks in another frame, or nonsense, is not heard at all. Frame: world; times are the
// host's [s].
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/health.hpp"
#include "host/peer_clocks.hpp"
#include "host/peer_witness.hpp"
#include "spf/world/heard_message.hpp"

namespace spf::host {

enum class PeerFault {
  same_number,  ///< another robot has this robot's number
  clock,        ///< its clock is off
  frame,        ///< it speaks in another frame
  malformed,    ///< its messages make no sense
};

struct PeerComplaint {
  int robot_id = 0;
  PeerFault fault = PeerFault::malformed;
  std::string text;
};

class PeerWatch {
 public:
  /// `clock_error` [s]: clocks that differ by less agree.
  PeerWatch(int own_id, double clock_error) : own_id_{own_id}, clocks_{clock_error} {}

  /// The number under which another robot with this robot's number is known.
  static constexpr int kNamesake = 2'000'000'000;

  /// The robot's own message, as it is broadcast.
  void told(const TrajectoryMessage& message);
  /// A well-formed message as the robot should hear it; nothing when it is its own.
  [[nodiscard]] std::optional<HeardMessage> admitted(const HeardMessage& message, double now);
  /// One that was admitted and believed.
  void believed(const TrajectoryMessage& message, double now) { witness_.add_message(message, now); }
  /// A message of a peer that is not heard, and why; or more about one that is at odds.
  void complain(int robot_id, PeerFault fault, const std::string& text, double now);

  void add_scan(const RangeScan& scan, const Pose2& pose_world, double time, const std::vector<Peer>& peers) {
    witness_.add_scan(scan, pose_world, time, peers);
  }
  /// Those of the peers whose word masks no returns, in their order.
  [[nodiscard]] std::vector<int> distrusted(const std::vector<Peer>& peers, double time) const;

  /// Of the last seconds, by number.
  [[nodiscard]] std::vector<PeerComplaint> complaints(double now) const;
  /// Adds them: errors, but for messages that make no sense, which anybody may send.
  void add_to(Health& health, double now) const;
  /// The clock has jumped.
  void forget();

 private:
  struct Sent {
    std::uint32_t sequence = 0;
    double time = -1e18;  // [s]
  };
  struct Told {
    std::string text;
    double time = 0.0;  // [s]
  };
  [[nodiscard]] bool is_own(const TrajectoryMessage& message, double now) const;

  int own_id_;
  PeerWitness witness_;
  PeerClocks clocks_;
  std::vector<Sent> sent_;  // the last, to know them when they come back; none before anything is heard
  std::size_t next_sent_ = 0;
  std::optional<double> begun_;  // [s] what was sent under its number before is of its own past
  std::map<std::pair<int, PeerFault>, Told> complaints_;
};

}  // namespace spf::host
