// Speed that follows clearance: a slow robot keeps its way more exactly, so where the guide's way is narrow
// the robot goes as slowly as the gap needs, and brakes for it in time. Frame: world.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "spf/planning/planner.hpp"
#include "spf/planning/space_time/space_time_parameters.hpp"

namespace spf {

/// How exactly the robot keeps its way [m], one standard deviation, at a speed [m/s].
[[nodiscard]] double way_sigma(double static_sigma, double position_sigma, double speed, double max_speed);
inline constexpr double kSurfaceSigmas = 4.0;  ///< [1] as far from a surface there is no risk

class PassageSpeed {
 public:
  PassageSpeed(const SpaceTimeParameters& parameters, const RobotParameters& robot);

  /// Looks along the guide, which must be ready, as far as the robot can come within the horizon and then
  /// stop. Allocates only for a way of more corners than ever before.
  void prepare(const PlanRequest& request);

  /// Whether anything on the way is narrow.
  [[nodiscard]] bool limits() const { return !marks_.empty(); }
  /// Largest speed [m/s] where `cost_to_go` [m] is left; infinite where nothing limits it.
  [[nodiscard]] double limit(double cost_to_go) const;

 private:
  struct Mark {
    double cost;   // [m]
    double speed;  // [m/s]
  };
  [[nodiscard]] double speed_at(const OccupancyMap& map, const Eigen::Vector2d& position_world,
                                double position_sigma) const;

  SpaceTimeParameters parameters_;
  RobotParameters robot_;
  std::vector<Eigen::Vector2d> way_;
  std::vector<Mark> marks_;  // by falling cost, equally far apart along the way
};

}  // namespace spf
