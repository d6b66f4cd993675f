// The radio between robots: every other robot in range receives a message after a delay, unless that link
// loses it. Whether a link loses the n-th message of a sender is drawn from (trial, link, n) alone, so it
// depends on nothing else.
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

  /// Sends a message at `time` [s], which must not decrease; `position_world` is the sender's position.
  void send(double time, const HeardMessage& message, const Eigen::Vector2d& position_world);

  /// Calls deliver(receiver, message), with a HeardMessage, for everything due by `time`, in the order sent.
  /// `robots` holds the positions of all robots in `grid`; the range is measured from the sender's position
  /// at sending to the receiver's present one.
  template <class Deliver>
  void deliver(double time, const UniformGrid& grid, const std::vector<Eigen::Vector2d>& robots,
               Deliver&& deliver) {
    while (!flights_.empty() && flights_.front().arrival_time <= time + kTimeRounding) {
      const Flight& flight = flights_.front();
      grid.visit(flight.origin, parameters_.range, [&](int receiver) {
        if (receiver == flight.message->robot_id) return;
        const Eigen::Vector2d& position = robots[static_cast<std::size_t>(receiver)];
        if (!((position - flight.origin).norm() <= parameters_.range) || lost(flight, receiver)) return;
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
