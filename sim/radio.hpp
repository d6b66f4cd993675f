// The radio between robots: every message is heard after a delay by every other robot in range, unless that
// link lost it. Whether a link loses the n-th message of a sender is drawn from (trial, link, n) alone, so
// that nothing else changes it.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "sim/scenario.hpp"
#include "sim/uniform_grid.hpp"
#include "spf/world/heard_message.hpp"

namespace spf::sim {

class Radio {
 public:
  explicit Radio(const Scenario& scenario);

  /// Hands a message to the radio at `time` [s], which must not go back; `position_world` is where the sender
  /// is.
  void send(double time, const HeardMessage& message, const Eigen::Vector2d& position_world);

  /// Calls deliver(receiver, message), with a HeardMessage, for everything due by `time`, in the
  /// order sent. `robots` holds the positions of all robots in `grid`; range counts from the sender's place
  /// when it sent to the receiver's place now.
  template <class Deliver>
  void deliver(double time, const UniformGrid& grid, const std::vector<Eigen::Vector2d>& robots,
               Deliver&& deliver) {
    while (!flights_.empty() && flights_.front().arrival_time <= time + kTimeRounding) {
      const Flight& flight = flights_.front();
      grid.visit(flight.origin, parameters_.range, [&](int receiver) {
        if (receiver == flight.message->robot_id) return;
        const Eigen::Vector2d& place = robots[static_cast<std::size_t>(receiver)];
        if (!((place - flight.origin).norm() <= parameters_.range) || lost(flight, receiver)) return;
        deliver(receiver, flight.message);
      });
      flights_.pop_front();
    }
  }

  [[nodiscard]] std::uint64_t messages_sent() const { return messages_sent_; }

 private:
  static constexpr double kTimeRounding = 1e-9;  // [s] sums of ticks are not exact
  struct Flight {
    double arrival_time;
    std::uint64_t number;  // of this sender's messages
    Eigen::Vector2d origin;
    HeardMessage message;
  };
  [[nodiscard]] bool lost(const Flight& flight, int receiver) const;

  RadioParameters parameters_;
  std::uint64_t seed_;
  std::vector<std::uint64_t> sent_;  // by sender
  std::uint64_t messages_sent_ = 0;
  std::deque<Flight> flights_;  // by arrival: one delay for all
};

}  // namespace spf::sim
