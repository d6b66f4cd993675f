#include "spf/planning/field/emergency_manoeuvre.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/plane.hpp"
#include "spf/planning/braking.hpp"
#include "spf/trajectory/constant_acceleration.hpp"

namespace spf {
namespace {

constexpr int kDirections = 16;
constexpr double kSidestepTime = 0.5;           // [s] towards the velocity before braking
constexpr double kWayOutTime = 1.0;             // [s] likewise, out of a danger region
constexpr double kEnoughClearance = 0.5 / 0.3;  // [radii of the robot] more is not better
constexpr double kFarEnough = 0.05 / 0.3;       // [radii of the robot] least distance of a way out

/// Constant acceleration towards a velocity for some time, then constant braking to rest.
Trajectory sidestep(const FlatState& head, const Eigen::Vector2d& velocity, double time, double duration,
                    const RobotParameters& robot) {
  const Eigen::Vector2d change = velocity - head.velocity_world;
  const double share = std::min(1.0, robot.max_acceleration * duration / std::max(change.norm(), 1e-9));
  const Eigen::Vector2d reached = head.velocity_world + share * change;
  Trajectory trajectory{time};
  const QuinticPiece away =
      constant_acceleration(head.position_world, head.velocity_world, reached, duration);
  trajectory.append(away);
  const double stop = reached.norm() / robot.max_acceleration;
  if (stop > 1e-6)
    trajectory.append(constant_acceleration(away.position(duration), reached, Eigen::Vector2d::Zero(), stop));
  return trajectory;
}

bool better(const ClearanceReport& candidate, const ClearanceReport& best, double enough) {
  if (candidate.clear() != best.clear()) return candidate.clear();
  if (candidate.clear()) {
    return std::min(candidate.min_clearance, enough) > std::min(best.min_clearance, enough);
  }
  return candidate.time > best.time + 1e-9;
}

/// Order of preference among manoeuvres.
struct Criterion {
  const ClearanceModel& model;
  double time;                    // [s]
  double until;                   // [s]
  double radius;                  // [m] of the robot
  bool in_fields;                 // the start lies in a danger region
  Eigen::Vector2d axis = {0, 0};  // unit, of the obstacle's motion there

  [[nodiscard]] EmergencyManoeuvre judged(const Trajectory& trajectory, bool sidestep) const {
    ClearanceWindow window{time, until, until, 0.5};
    window.fields = !in_fields;
    EmergencyManoeuvre manoeuvre{trajectory, model.check(trajectory, window), sidestep};
    if (in_fields) manoeuvre.time_in_fields = model.time_in_fields(trajectory, time, until);
    return manoeuvre;
  }
  [[nodiscard]] bool prefers(const EmergencyManoeuvre& candidate, const EmergencyManoeuvre& best) const {
    if (!in_fields) return better(candidate.report, best.report, enough());
    constexpr double kSoon = 1e-6;  // [s]
    if (candidate.report.clear() != best.report.clear()) return candidate.report.clear();
    if (!candidate.report.clear()) return candidate.report.time > best.report.time + 1e-9;
    if (leads_out(candidate) != leads_out(best)) return leads_out(candidate);
    if (std::abs(candidate.time_in_fields - best.time_in_fields) > kSoon)
      return candidate.time_in_fields < best.time_in_fields;
    return rest_clearance(candidate) > rest_clearance(best);
  }
  /// A robot that moves ahead of the obstacle stays in front of it: a way out leads to its side, or anywhere
  /// but ahead when it takes little time.
  [[nodiscard]] bool leads_out(const EmergencyManoeuvre& manoeuvre) const {
    constexpr double kShort = 0.5;  // [s]
    constexpr double kLeastLateral =
        0.65;  // [1] sine of the angle to the obstacle's motion, about least_lateral_share
    const Eigen::Vector2d moved = manoeuvre.trajectory.tail_position() -
                                  manoeuvre.trajectory.position(manoeuvre.trajectory.start_time());
    const double across = std::abs(cross(axis, moved));
    if (across >= kLeastLateral * moved.norm() && moved.norm() > kFarEnough * radius) return true;
    return manoeuvre.time_in_fields <= kShort && axis.dot(moved) <= 0.0;
  }
  [[nodiscard]] double rest_clearance(const EmergencyManoeuvre& manoeuvre) const {
    return std::min(model.field_clearance(manoeuvre.trajectory.tail_position()), enough());
  }
  [[nodiscard]] double enough() const { return kEnoughClearance * radius; }  // [m]
};

}  // namespace

EmergencyManoeuvre best_emergency_manoeuvre(const FlatState& head, const HeadingState& heading, double time,
                                            double until, const ClearanceModel& model,
                                            const RobotParameters& robot) {
  const DangerRegion* region = model.nearest_region(head.position_world);
  const bool in_fields =
      region != nullptr && region->field.clearance(head.position_world, region->threshold) < 0.0;
  const Criterion criterion{model,     time,
                            until,     robot.radius,
                            in_fields, in_fields ? region->field.axis_world() : Eigen::Vector2d::Zero()};
  EmergencyManoeuvre best = criterion.judged(braking_trajectory(head, heading, time, robot), false);
  if (!in_fields && best.report.clear() && best.report.min_clearance >= criterion.enough()) return best;
  const ClearanceWindow only_static{time, until, time, 0.5};
  for (const double duration : {kSidestepTime, kWayOutTime}) {
    if (duration > kSidestepTime && !in_fields) break;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2.0 * kPi * i / kDirections;
      const Eigen::Vector2d direction{std::cos(angle), std::sin(angle)};
      for (const double part : {1.0, 0.5}) {
        Trajectory trial = sidestep(head, part * robot.max_speed * direction, time, duration, robot);
        if (!model.check(trial, only_static).clear()) continue;  // not even to gain time
        EmergencyManoeuvre candidate = criterion.judged(trial, true);
        if (!criterion.prefers(candidate, best)) continue;
        candidate.trajectory.set_heading(stopping_heading(heading, time, robot));
        best = std::move(candidate);
      }
    }
  }
  return best;
}

}  // namespace spf
