#include "sim/radio.hpp"

#include "spf/math/random_stream.hpp"

namespace spf::sim {

Radio::Radio(const Scenario& scenario)
    : parameters_{scenario.simulation.radio},
      seed_{stream_seed(scenario, StreamRole::radio, 0)},
      sent_(scenario.robots.size(), 0) {}

void Radio::send(double time, const HeardMessage& message, const Eigen::Vector2d& position_world) {
  const std::uint64_t number = sent_[static_cast<std::size_t>(message->robot_id)]++;
  flights_.push_back({time + parameters_.delay, number, position_world, message});
  ++messages_sent_;
}

bool Radio::lost(const Flight& flight, int receiver) const {
  if (parameters_.loss <= 0.0) return false;
  const std::uint64_t link = static_cast<std::uint64_t>(flight.message->robot_id) * sent_.size() +
                             static_cast<std::uint64_t>(receiver);
  return RandomStream{mix(mix(seed_, link), flight.number)}.uniform() < parameters_.loss;
}

}  // namespace spf::sim
