// The reactive baseline: optimal reciprocal collision avoidance, written from its published description (van
// den Berg, Guy, Lin, Manocha, "Reciprocal n-body collision avoidance", ISRR 2009, Springer 2011; "the
// publication" below). Everything near forbids a half-plane of velocities; the allowed velocity closest to
// the preferred one is driven until the next plan. It uses present velocities only: no plans, no uncertainty.
// docs/add_a_method.md shows it as an example of adding a method. Frame: world.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "spf/planning/orca/orca_parameters.hpp"
#include "spf/planning/plan_judge.hpp"
#include "spf/robot/robot_parameters.hpp"

namespace spf {

/// The velocities v with normal . v >= offset; the normal has length 1.
struct HalfPlane {
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  double offset = 0.0;  ///< [m/s]
  /// Distance of a velocity from the border on the forbidden side [m/s]; not positive on the allowed side.
  [[nodiscard]] double violation(const Eigen::Vector2d& velocity) const {
    return offset - normal.dot(velocity);
  }
};

/// Two discs, from the point of view of one of them.
struct Encounter {
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();          ///< [m] from the own centre to the other's
  Eigen::Vector2d own_velocity = Eigen::Vector2d::Zero();    ///< [m/s] present
  Eigen::Vector2d other_velocity = Eigen::Vector2d::Zero();  ///< [m/s] present
  double reach = 0.0;                                        ///< [m] least distance of the centres to keep
  double share = 1.0;  ///< [1] part of the change of velocity to make: 1/2 when the other does the
                       ///< same, 1 when it will not react
};

/// The velocities that this encounter allows (the publication's ORCA set). If both discs choose from theirs
/// (with shares of 1/2), their distance stays above `reach` for `horizon` seconds. Discs that are too close
/// already are separated within `period` seconds. Exact symmetry is resolved to the right; coinciding discs
/// separate along `escape` (unit vector, opposite for the two).
[[nodiscard]] HalfPlane allowed_velocities(const Encounter& encounter, double horizon, double period,
                                           const Eigen::Vector2d& escape);

/// The chosen velocity, and whether it satisfies all half-planes.
struct VelocityChoice {
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< [m/s]
  bool feasible = false;  ///< false: the largest violation of the soft planes is minimal
};

/// Chooses velocities by linear programmes; keeps its memory between calls.
class VelocityProgramme {
 public:
  explicit VelocityProgramme(std::size_t largest_count) { projected_.reserve(largest_count); }

  /// The velocity of at most max_speed within all half-planes that is closest to `preferred`. When there is
  /// none: the one within the first `hard_count` half-planes whose largest violation of the others is least.
  /// When even those exclude each other, all count as soft. Finite for finite arguments.
  [[nodiscard]] VelocityChoice choose(const std::vector<HalfPlane>& planes, std::size_t hard_count,
                                      const Eigen::Vector2d& preferred, double max_speed);

 private:
  [[nodiscard]] Eigen::Vector2d least_violation(const std::vector<HalfPlane>& planes, std::size_t hard_count,
                                                const Eigen::Vector2d& start, double max_speed);

  std::vector<HalfPlane> projected_;
};

class OrcaPlanner final : public Planner {
 public:
  /// A velocity is held for `period` [s] > 0, until the next plan; `planner` holds the margins of the
  /// clearance check. Throws std::invalid_argument when parameters are out of range. All memory is allocated
  /// here.
  OrcaPlanner(const OrcaParameters& parameters, const RobotParameters& robot, double period,
              const PlannerParameters& planner = {});

  /// The trajectory holds the chosen velocity for one period, then brakes to rest: a robot that gets no
  /// further plan stops. Where no velocity satisfies all half-planes, that of least violation is driven. The
  /// cost of its one candidate is the departure from the preferred velocity [m/s].
  void plan(const PlanRequest& request, PlanResult& result) override;

 private:
  /// A peer or a moving obstacle.
  struct Neighbour {
    Encounter encounter;
    double gap = 0.0;  // [m] between the surfaces
    Eigen::Vector2d escape;
    bool is_peer = false;
    int id = 0;
  };
  [[nodiscard]] Eigen::Vector2d wanted_velocity(const PlanRequest& request) const;
  void add_static_planes(const PlanRequest& request, const Eigen::Vector2d& wanted);
  void add_surface_point(const PlanRequest& request, const Eigen::Vector2d& sample);
  void collect_neighbours(const PlanRequest& request);
  void collect(Neighbour neighbour, double other_radius);
  void add_neighbour_planes();
  void name_what_blocks(const Eigen::Vector2d& wanted, PlanResult& result) const;
  [[nodiscard]] Trajectory trajectory_for(const PlanRequest& request, const Eigen::Vector2d& velocity) const;

  OrcaParameters parameters_;
  RobotParameters robot_;
  double period_;                                // [s]
  std::vector<Eigen::Vector2d> surface_points_;  // [m] from the robot
  std::vector<Neighbour> neighbours_;            // nearest first
  std::vector<HalfPlane> planes_;                // of surfaces, then of neighbours_
  VelocityProgramme programme_;
  PlanJudge judge_;
};

}  // namespace spf
