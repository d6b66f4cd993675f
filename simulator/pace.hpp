// Simulated time against the wall's.
#pragma once

namespace spf::simulator {

/// A tick that cannot begin in time shifts all that follow, instead of having them catch up in a burst that
/// no robot could keep up with.
class Pace {
 public:
  /// `speed` [1]: simulated seconds per second.
  explicit Pace(double speed) : speed_{speed} {}

  void start(double time, double wall) {
    time_ = time;
    wall_ = wall;
  }
  /// When a simulated time [s] is to be reached on the wall's clock [s].
  [[nodiscard]] double due(double time) const { return wall_ + (time - time_) / speed_; }
  /// It was reached at `wall`; shifts what follows when that is late.
  void reached(double time, double wall) {
    const double late = wall - due(time);
    if (late <= kTolerated) return;
    wall_ += late;
    lost_ += late;
    ++shifts_;
  }

  [[nodiscard]] long shifts() const { return shifts_; }
  [[nodiscard]] double lost() const { return lost_; }  ///< [s] on the wall, by all shifts

 private:
  static constexpr double kTolerated = 0.01;  // [s] that are made up for
  double speed_;
  double time_ = 0.0;  // [s] simulated
  double wall_ = 0.0;  // [s] then
  long shifts_ = 0;
  double lost_ = 0.0;
};

}  // namespace spf::simulator
