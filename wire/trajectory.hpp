// What a robot tells its peers, and its own tracker (spf_empc_msgs/Trajectory).
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "spf/world/trajectory_message.hpp"
#include "wire/pose.hpp"

namespace spf::wire {

struct StampedTrajectory {
  TrajectoryMessage message;
  std::optional<double> observed;  ///< [s] when the newest observation behind it was made
};

namespace trajectory_parts {

inline constexpr std::size_t kCoefficients = 12;  // of a piece: x0..x5, y0..y5

inline std::string sizes(const char* what, std::size_t is, std::size_t must) {
  return std::string{what} + " has " + std::to_string(is) + " entries, not " + std::to_string(must);
}

/// The parts that must be numbers before anything is made of them.
template <class Message>
[[nodiscard]] std::string bad_pieces(const Message& message) {
  const std::size_t count = message.durations.size();
  if (count == 0) return "durations is empty";
  if (count > static_cast<std::size_t>(Trajectory::kMaxPieces))
    return "durations has " + std::to_string(count) + " entries, more than " +
           std::to_string(Trajectory::kMaxPieces);
  if (message.coefficients.size() != kCoefficients * count)
    return sizes("coefficients", message.coefficients.size(), kCoefficients * count);
  for (const double duration : message.durations)
    if (!(std::isfinite(duration) && duration > 0.0)) return "a duration is not above 0";
  for (const double coefficient : message.coefficients)
    if (!std::isfinite(coefficient)) return "a coefficient is not finite";
  return {};
}

template <class Message, class Clock>
[[nodiscard]] Trajectory trajectory_of(const Message& message, const Clock& clock) {
  Trajectory trajectory{clock.seconds(message.start)};
  for (std::size_t i = 0; i < message.durations.size(); ++i) {
    QuinticPiece piece;
    piece.duration = message.durations[i];
    for (std::size_t k = 0; k < kCoefficients; ++k)
      piece.coefficients(static_cast<Eigen::Index>(k % 6), static_cast<Eigen::Index>(k / 6)) =
          message.coefficients[kCoefficients * i + k];
    if (message.headings.empty())
      trajectory.append(piece);
    else
      trajectory.append(piece, {message.headings[i], message.yaw_rates[i]},
                        {message.headings[i + 1], message.yaw_rates[i + 1]});
  }
  return trajectory;
}

/// Of a robot that steers; none is well.
template <class Message>
[[nodiscard]] std::string bad_headings(const Message& message) {
  constexpr double kMost = 1e6;
  const std::size_t given = message.headings.size();
  if (given != message.yaw_rates.size() || (given > 0 && given != message.durations.size() + 1))
    return "headings and yaw_rates are not one more than durations";
  for (std::size_t i = 0; i < given; ++i)
    if (!(std::abs(message.headings[i]) <= kMost && std::abs(message.yaw_rates[i]) <= kMost))
      return "headings or yaw_rates are not finite, or too large";
  return {};
}

template <class Message, class Clock>
[[nodiscard]] std::optional<HeadingProfile> heading_of(const Message& message, const Clock& clock) {
  HeadingPhases phases;
  phases.start_time = clock.seconds(message.heading_start);
  phases.initial_heading = message.heading_initial;
  phases.target_heading = message.heading_target;
  phases.initial_rate = message.yaw_rate_initial;
  phases.cruise_rate = message.yaw_rate_cruise;
  phases.ramp_in = message.heading_phases[0];
  phases.cruise = message.heading_phases[1];
  phases.ramp_out = message.heading_phases[2];
  return HeadingProfile::from_phases(phases);
}

template <class Message, class Clock>
void fill_heading(const HeadingPhases& phases, const Clock& clock, Message& message) {
  message.heading_start = clock.time(phases.start_time);
  message.heading_initial = phases.initial_heading;
  message.heading_target = phases.target_heading;
  message.yaw_rate_initial = phases.initial_rate;
  message.yaw_rate_cruise = phases.cruise_rate;
  message.heading_phases[0] = phases.ramp_in;
  message.heading_phases[1] = phases.cruise;
  message.heading_phases[2] = phases.ramp_out;
}

template <class Message, class Clock>
void fill_claim(const std::optional<PassageClaim>& claim, const Clock& clock, Message& message) {
  message.claimed = claim.has_value();
  if (!claim) return;
  message.claim_inside = claim->inside;
  message.claim_waits = claim->waits;
  message.claim_since = clock.time(claim->since);
  fill(claim->entry_world, message.claim_entry);
  fill(claim->exit_world, message.claim_exit);
}

template <class Message, class Clock>
[[nodiscard]] std::optional<PassageClaim> claim_of(const Message& message, const Clock& clock) {
  if (!message.claimed) return std::nullopt;
  const auto position = [](const auto& point) { return Eigen::Vector2d{point.x, point.y}; };
  return PassageClaim{position(message.claim_entry), position(message.claim_exit),
                      clock.seconds(message.claim_since), message.claim_inside != 0,
                      message.claim_waits != 0};
}

}  // namespace trajectory_parts

template <class Message, class Clock>
void fill(const StampedTrajectory& stamped, const Clock& clock, const std::string& frame, Message& message) {
  const TrajectoryMessage& from = stamped.message;
  message.header.stamp = clock.time(from.sent_time);
  message.header.frame_id = frame;
  message.robot_id = static_cast<std::uint32_t>(from.robot_id);
  message.sequence = from.sequence;
  message.priority = static_cast<std::uint32_t>(from.priority);
  message.state = static_cast<std::uint8_t>(from.state);
  message.expiry = clock.time(from.expiry_time);
  message.radius = from.radius;
  message.position_sigma = from.position_sigma;
  trajectory_parts::fill_claim(from.claim, clock, message);
  if (stamped.observed) message.observed = clock.time(*stamped.observed);
  message.start = clock.time(from.trajectory.start_time());
  for (int i = 0; i < from.trajectory.piece_count(); ++i) {
    const QuinticPiece& piece = from.trajectory.piece(i);
    message.durations.push_back(piece.duration);
    for (const double coefficient : piece.coefficients.reshaped())
      message.coefficients.push_back(coefficient);
  }
  trajectory_parts::fill_heading(from.trajectory.heading().phases(), clock, message);
  if (from.trajectory.steered())
    for (int i = 0; i <= from.trajectory.piece_count(); ++i) {
      message.headings.push_back(from.trajectory.heading_knot(i).heading);
      message.yaw_rates.push_back(from.trajectory.heading_knot(i).yaw_rate);
    }
}

template <class Message, class Clock>
[[nodiscard]] Converted<StampedTrajectory> read_trajectory(const Message& message, const Clock& clock,
                                                           const std::string& frame) {
  using Result = Converted<StampedTrajectory>;
  std::string refusal;
  if (frames_differ(message.header.frame_id, frame, refusal)) return Result::refused(refusal);
  if (message.robot_id > static_cast<std::uint32_t>(std::numeric_limits<int>::max()))
    return Result::refused("robot_id is too large");
  if (message.priority > static_cast<std::uint32_t>(std::numeric_limits<int>::max()))
    return Result::refused("priority is too large");
  if (message.state > Message::ARRIVED) return Result::refused("state is none that is known");
  if (!(message.radius > 0.0 && std::isfinite(message.radius)))
    return Result::refused("radius is not above 0");
  if (!(message.position_sigma >= 0.0 && std::isfinite(message.position_sigma)))
    return Result::refused("position_sigma is negative or not finite");
  const std::optional<PassageClaim> claim = trajectory_parts::claim_of(message, clock);
  if (claim && !believable(*claim)) return Result::refused("its claim to a passage is not finite");
  if (std::string why = trajectory_parts::bad_pieces(message); !why.empty())
    return Result::refused(std::move(why));
  const std::optional<HeadingProfile> heading = trajectory_parts::heading_of(message, clock);
  if (!heading) return Result::refused("its heading does not turn to its target");
  if (std::string why = trajectory_parts::bad_headings(message); !why.empty())
    return Result::refused(std::move(why));

  StampedTrajectory stamped;
  TrajectoryMessage& to = stamped.message;
  to.robot_id = static_cast<int>(message.robot_id);
  to.priority = static_cast<int>(message.priority);
  to.sequence = message.sequence;
  to.sent_time = clock.seconds(message.header.stamp);
  to.expiry_time = clock.seconds(message.expiry);
  to.radius = message.radius;
  to.position_sigma = message.position_sigma;
  to.claim = claim;
  to.state = static_cast<PeerState>(message.state);
  to.trajectory = trajectory_parts::trajectory_of(message, clock);
  to.trajectory.set_heading(*heading);
  if (!(message.observed == decltype(message.observed){})) stamped.observed = clock.seconds(message.observed);
  return {stamped, {}};
}

}  // namespace spf::wire
