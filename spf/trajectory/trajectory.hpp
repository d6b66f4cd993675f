// A planned motion: quintic position pieces over absolute time, and the heading beside them (Section
// "Trajectory representation", eq. 5-6); of robots that cannot move sideways with them. Fixed capacity, so
// that copying and evaluating never allocate. Frame: world.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cassert>

#include "spf/trajectory/heading_profile.hpp"

namespace spf {

/// Flat output of the position and its derivatives at one instant, all in world.
struct FlatState {
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();      ///< [m]
  Eigen::Vector2d velocity_world = Eigen::Vector2d::Zero();      ///< [m/s]
  Eigen::Vector2d acceleration_world = Eigen::Vector2d::Zero();  ///< [m/s^2]
};

/// p(t) = sum_k coefficients.row(k) t^k for local_time t in [0, duration].
struct QuinticPiece {
  Eigen::Matrix<double, 6, 2> coefficients = Eigen::Matrix<double, 6, 2>::Zero();
  double duration = 0.0;  ///< [s]

  [[nodiscard]] Eigen::Vector2d position(double local_time) const;
  [[nodiscard]] Eigen::Vector2d velocity(double local_time) const;
  [[nodiscard]] Eigen::Vector2d acceleration(double local_time) const;
  [[nodiscard]] Eigen::Vector2d jerk(double local_time) const;
};

/// Value type. Before its start it rests at its head position, after its end at its tail position, with zero
/// velocity in both: a plan that is not renewed in time means "stop".
class Trajectory {
 public:
  static constexpr int kMaxPieces = 32;

  Trajectory() = default;
  explicit Trajectory(double start_time) : start_time_{start_time} {}

  /// A trajectory that rests at a position from start_time on (one piece of the given duration).
  [[nodiscard]] static Trajectory standing(const Eigen::Vector2d& position_world, double start_time,
                                           double duration, const HeadingProfile& heading = {});

  /// Appends a piece with duration > 0; at most kMaxPieces.
  void append(const QuinticPiece& piece);
  /// Appends a piece on which the heading [rad] and its rate go from one state to another as a cubic, on the
  /// shorter side, so that the robot turns by less than half a circle. All pieces or none have their heading.
  void append(const QuinticPiece& piece, const HeadingState& from, const HeadingState& to);
  /// Of a trajectory whose pieces do not have theirs.
  void set_heading(const HeadingProfile& heading) { heading_ = heading; }

  [[nodiscard]] bool empty() const { return piece_count_ == 0; }
  [[nodiscard]] int piece_count() const { return piece_count_; }
  [[nodiscard]] const QuinticPiece& piece(int index) const {
    assert(0 <= index && index < piece_count_);
    return pieces_[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] const HeadingProfile& heading() const { return heading_; }
  /// Whether the pieces have their own heading, that of a robot that cannot move sideways.
  [[nodiscard]] bool steered() const { return steered_; }
  /// At the start of a piece, or at the end of the last; of a steered one.
  [[nodiscard]] const HeadingState& heading_knot(int index) const {
    assert(steered_ && 0 <= index && index <= piece_count_);
    return knots_[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] double start_time() const { return start_time_; }  ///< [s]
  [[nodiscard]] double duration() const { return duration_; }      ///< [s]
  [[nodiscard]] double end_time() const { return start_time_ + duration_; }

  /// Position, velocity, acceleration at an absolute time; the start and the end still belong to the motion.
  /// Requires !empty().
  [[nodiscard]] FlatState state(double time) const;
  [[nodiscard]] Eigen::Vector2d position(double time) const;
  /// Heading and yaw rate at an absolute time, whichever way the heading is given.
  [[nodiscard]] HeadingState heading_state(double time) const;
  /// [s] when neither position nor heading changes any more.
  [[nodiscard]] double rest_time() const;
  [[nodiscard]] Eigen::Vector2d tail_position() const;
  /// Bounds over the motion, found from polynomial roots to rounding, not by sampling [m/s], [m/s^2].
  [[nodiscard]] double max_speed() const;
  [[nodiscard]] double max_acceleration() const;
  /// Length of the path from start to end [m], by quadrature: to about 1e-9 of itself, and with no more than
  /// some 2700 evaluations of the speed per piece.
  [[nodiscard]] double length() const;

 private:
  struct LocalTime {
    int index;          // of the piece
    double local_time;  // [s] clamped to the motion
  };
  [[nodiscard]] LocalTime locate(double time) const;

  std::array<QuinticPiece, kMaxPieces> pieces_;
  int piece_count_ = 0;
  double start_time_ = 0.0;
  double duration_ = 0.0;
  HeadingProfile heading_;
  bool steered_ = false;
  std::array<HeadingState, kMaxPieces + 1> knots_;
};

}  // namespace spf
