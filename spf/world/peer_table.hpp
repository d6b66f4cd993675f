// Teammates as known from their broadcasts: which messages are accepted, and what becomes of a peer that
// falls silent. Frame: world. Time is the receiver's; clocks agree within `clock_tolerance`. Whatever is
// sent, the table holds at most kMostPeers, a message costs time linear in their number at most, and all
// numbers stay believable (spf/math/believable.hpp).
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "spf/math/parameters.hpp"
#include "spf/world/heard_message.hpp"
#include "spf/world/peer.hpp"

namespace spf {

struct PeerTableParameters {
  double silence =
      1.0;  ///< [s] a peer expires this long after its last message, even if that promised longer
  double growth_rate = 0.3;  ///< [m/s] growth of an expired peer's disc, which covers where it may have gone
  double largest_growth = 1.0;   ///< [m] the disc grows up to here
  double forget_time = 10.0;     ///< [s] after expiry the peer is forgotten and left to the sensors
  double clock_tolerance = 1.0;  ///< [s] messages from farther in the future are malformed

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("silence", self.silence, "s", Range{0.05, 60.0}, "without a message for this long a peer expires");
    visit("growth_rate", self.growth_rate, kSpeedByRobot, Range{0.0, 20.0},
          "growth of the radius of an expired peer");
    visit("forget_time", self.forget_time, "s", Range{0.0, 3600.0},
          "an expired peer is forgotten after this");
    visit("clock_tolerance", self.clock_tolerance, "s", Range{0.0, 60.0},
          "largest difference of the robots' clocks");
  }

  /// No settings, but they follow the robot.
  template <class Self, class Visitor>
  static void visit_constants(Self& self, Visitor&& visit) {
    visit(self.largest_growth, Scale::size, Range{0.0, 100.0});
  }
};

/// Largest number of peers that a robot remembers: about twice the largest fleet whose robots all hear each
/// other.
inline constexpr std::size_t kMostPeers = 2000;

enum class MessageVerdict {
  accepted,
  own,        ///< the robot's own message came back
  duplicate,  ///< the sequence number is known already
  old,        ///< an older one, overtaken in transit
  malformed,  ///< without a usable trajectory (HeardMessage::usable), not finite, or out of range
  crowded,    ///< valid, but from a new sender while kMostPeers are known, none of them expired
};
inline constexpr std::size_t kMessageVerdicts = static_cast<std::size_t>(MessageVerdict::crowded) + 1;

class PeerTable {
 public:
  /// Throws std::invalid_argument on parameters out of range.
  explicit PeerTable(int own_id, const PeerTableParameters& parameters = {});

  /// Checks a message and, when valid, stores it as its sender's latest. `now` [s] is the time of arrival. A
  /// sender that has been silent long enough to expire may restart its sequence (the robot was restarted). In
  /// a full table a new sender replaces the one that expired first.
  MessageVerdict receive(const HeardMessage& heard, double now);

  /// All peers known at time `now` [s], sorted by robot_id; those due to be forgotten are dropped. The
  /// reference is valid until the next call.
  const std::vector<Peer>& peers(double now);
  /// The result of the last call of peers().
  [[nodiscard]] const std::vector<Peer>& last_peers() const { return peers_; }

  /// Number of messages with this verdict.
  [[nodiscard]] std::uint64_t count(MessageVerdict verdict) const {
    return counts_[static_cast<std::size_t>(verdict)];
  }

 private:
  struct Entry {
    Peer peer;
    std::uint32_t sequence = 0;
    double expiry_time = 0.0;  // [s] as the message said, at most `silence` after its arrival
    double still_since = 0.0;  // [s]
    Eigen::Vector2d stood_at = Eigen::Vector2d::Zero();  // [m] of the peer then
  };

  [[nodiscard]] MessageVerdict judge(const HeardMessage& heard, double now) const;
  [[nodiscard]] bool well_formed(const TrajectoryMessage& message, double now) const;
  [[nodiscard]] bool make_room(double now);
  static void watch_standing(Entry& entry, bool is_new, double now);

  int own_id_;
  PeerTableParameters parameters_;
  std::map<int, Entry> entries_;  // by robot_id
  std::vector<Peer> peers_;
  std::array<std::uint64_t, kMessageVerdicts> counts_{};
};

}  // namespace spf
