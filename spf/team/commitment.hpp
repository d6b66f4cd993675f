// The trajectory that the robot is committed to: where the next plan begins, what replaces it, how it ends in
// a stop, and where the body's x axis points on it. Frame: world.
#pragma once

#include <optional>

#include "spf/localisation/observer.hpp"
#include "spf/planning/planner.hpp"
#include "spf/robot/drive.hpp"
#include "spf/team/agent_parameters.hpp"
#include "spf/team/agent_status.hpp"

namespace spf {

class Commitment {
 public:
  /// Stands at `start` from `time` on.
  Commitment(const AgentParameters& parameters, const Pose2& start, double time);

  /// Other limits and another heading mode from the next plan on.
  void reconfigure(const AgentParameters& parameters);

  /// Fills in where a plan made at request.time begins. It goes on from the trajectory, which keeps the
  /// motion smooth; a robot that has been carried too far from it, by an estimate that is valid, starts anew
  /// where it is, as it is told to move when it is held, and so does one that may not go on at all, or that
  /// cannot move sideways and has come to rest beside it.
  void begin_plan(const StateEstimate& estimate, PlanRequest& request,
                  const std::optional<Hold>& hold = std::nullopt);
  /// Does what the result's action says, with the heading that the heading mode wants; near its end with the
  /// goal's, where the goal has one, whatever the mode. That is kept from then on where the mode keeps one.
  void follow(const PlanRequest& request, const PlanResult& result);
  /// Brakes from the trajectory, unless it is a braking one already. True when a new one began.
  bool brake(double time);

  /// For a robot that is kept from moving and follows no trajectory, not even a braking one: stands from now
  /// on where it is, when that is clearly elsewhere. Requires braking(). True when it was.
  bool stand_where(const StateEstimate& estimate, double time);

  [[nodiscard]] const Trajectory& trajectory() const { return trajectory_; }
  /// The trajectory leads to rest (or aside), since there was no plan.
  [[nodiscard]] bool braking() const { return braking_; }
  /// Smoothed square of the distance between robot and trajectory [m^2], per axis.
  [[nodiscard]] double tracking_variance() const { return tracking_variance_; }

 private:
  [[nodiscard]] bool ends_soon(const PlanRequest& request) const;
  [[nodiscard]] HeadingProfile heading_for(const PlanRequest& request);
  /// [rad] from which, in turn with another, a scanner with a blind side sees all round.
  [[nodiscard]] double look_around(const PlanRequest& request);
  [[nodiscard]] std::optional<double> out_of_view(const PlanRequest& request) const;
  /// [rad] of the motion soon, if it moves clearly.
  [[nodiscard]] std::optional<double> course(const PlanRequest& request) const;
  void watch_rest(const PlanRequest& request);
  /// How far a robot that stands may be from its plan [m].
  [[nodiscard]] double standing_error(const StateEstimate& estimate) const;

  HeadingMode heading_mode_;
  RobotParameters robot_;
  Drive drive_;
  double reanchor_distance_;  // [m]
  double held_heading_;       // [rad] in mode `keep`
  double outlook_;            // [rad] the direction that it looks to both sides of, in mode `look`
  double look_side_ = 1.0;    // to which of them
  double rests_since_;        // [s] since when the plan of a robot that cannot move sideways stands
  Trajectory trajectory_;
  bool braking_ = false;
  double tracking_variance_ = 0.0;  // [m^2]
};

}  // namespace spf
