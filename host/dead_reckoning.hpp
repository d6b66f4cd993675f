// Where the body has been in the last half second, by the motion of its wheels alone: to carry what a scan
// showed then to where it is seen from now. Frame: that in which it was at the origin at the first call.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>

#include "spf/math/pose2.hpp"

namespace spf::host {

/// Never throws or allocates.
class DeadReckoning {
 public:
  /// The body moves with `twist_body` [m/s, m/s, rad/s] at a time [s], and changed to it evenly since the
  /// call before. Times that do not grow are ignored.
  void advance(double time, const Eigen::Vector3d& twist_body);
  /// Where it was at a time [s] not much longer ago than kMemory, or will soon be as it moves now.
  [[nodiscard]] Pose2 at(double time) const;
  /// As of the last call of advance().
  [[nodiscard]] const Pose2& here() const { return newest().pose; }
  [[nodiscard]] const Eigen::Vector3d& twist_body() const { return newest().twist_body; }  ///< likewise
  void reset() { *this = DeadReckoning{}; }

  static constexpr double kMemory = 0.6;  ///< [s]

 private:
  struct Mark {
    double time = 0.0;  // [s]
    Pose2 pose;
    Eigen::Vector3d twist_body = Eigen::Vector3d::Zero();  // [m/s, m/s, rad/s]
  };
  static constexpr std::size_t kMarks = 64;
  static constexpr double kSpacing = kMemory / (kMarks - 4);  // [s]

  [[nodiscard]] const Mark& newest() const { return marks_[newest_]; }
  [[nodiscard]] const Mark& before(std::size_t index) const { return marks_[(index + kMarks - 1) % kMarks]; }

  std::array<Mark, kMarks> marks_;
  std::size_t newest_ = 0;
  std::size_t kept_ = 0;
};

}  // namespace spf::host
