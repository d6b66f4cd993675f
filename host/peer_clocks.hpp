// Whether peers' clocks agree with the own one, by the ages at which their messages arrive. When most come
// from the future, the peer's clock is ahead; when none of many is young, it is behind, or all of its
// messages come late. Times are the host's [s].
#pragma once

#include <array>
#include <map>

namespace spf::host {

/// Remembers at most kMostPeers.
class PeerClocks {
 public:
  /// Smaller differences [s] are none.
  explicit PeerClocks(double tolerance) : tolerance_{tolerance} {}

  /// A message that was sent at a time [s] by its sender's clock arrives.
  void hear(int robot_id, double sent_time, double now);
  /// By how much a peer's clock is ahead [s], negative: behind. Zero within the tolerance, for peers of which
  /// too little was heard, and for those that have been silent.
  [[nodiscard]] double error(int robot_id, double now) const;
  /// Everybody whose clock is off.
  [[nodiscard]] std::map<int, double> errors(double now) const;
  void forget() { known_.clear(); }

 private:
  static constexpr std::size_t kSmallest = 3;  // single messages may be wrong
  struct Span {
    double begun = -1e18;  // [s]
    int count = 0;
    int of_future = 0;                     // beyond the tolerance
    std::array<double, kSmallest> ages{};  // [s] the smallest, in order
  };
  struct Record {
    Span now, before;
    double last = 0.0;  // [s]
  };
  [[nodiscard]] double error_of(const Record& record, double now) const;
  [[nodiscard]] bool has_room(double now);

  double tolerance_;  // [s]
  std::map<int, Record> known_;
};

}  // namespace spf::host
