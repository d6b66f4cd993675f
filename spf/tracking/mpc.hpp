// The extended-state model predictive controller (eq. 19): wheel speeds that lead the robot along the
// reference. Departures from the printed problem, where it cannot be meant as printed: z_1..z_H are penalised
// (the print leaves z_H free, so that always u_{H-1} = 0); the effort term asks for the reference's wheel
// speeds instead of standstill; state bounds are soft (an infeasible start must still give a command) and
// never bound z_0; the observer's disturbance is held over the horizon: z_{k+1} = z_k + dt (A(heading_k)
// b(u_k)
// + d), with b(u) the motion of the body that the drive makes of its inputs, W^-1 u for wheels. Frame: world;
// poses are vectors (x, y, heading) as in reference_sampler.hpp, wheel speeds are rim speeds [m/s].
#pragma once

#include <Eigen/Core>

#include <array>
#include <memory>

#include "spf/math/parameters.hpp"
#include "spf/robot/drive.hpp"
#include "spf/tracking/reference_sampler.hpp"

namespace spf {

struct MpcParameters {
  int horizon = 5;                ///< [1] H (paper)
  double dt = 0.1;                ///< [s] (paper)
  double position_weight = 10.0;  ///< [1/m^2] lambda_p for x and y; the paper gives no value
  double heading_weight = 1.0;    ///< [1/rad^2] lambda_p for the heading
  double effort_weight = 0.5;     ///< [s^2/m^2] lambda_u, on wheel speeds minus the reference's
  double rate_weight =
      0.1;  ///< [s^2/m^2] on the change of wheel speeds from step to step; damps chatter under pose noise
  // No settings; tests vary them.
  double slack_weight = 1e5;  ///< [1/m^2] on violations of the state bounds
  double x_lower = -1e6;      ///< [m] soft bounds of the robot's centre (z_lb, z_ub of eq. 19)
  double x_upper = 1e6;
  double y_lower = -1e6;
  double y_upper = 1e6;
  int iterations = 2;          ///< [1] Gauss-Newton iterations at most
  double tolerance = 1e-6;     ///< [m/s] stop when an iteration moves no wheel speed by more
  int active_set_steps = 100;  ///< [1] per iteration at most

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("horizon", self.horizon, "1", Range{1, kMaxHorizon}, "horizon H in steps (paper: 5)");
    visit("dt", self.dt, "s", Range{1e-3, 1.0}, "time step of the prediction (paper: 0.1)");
    visit("position_weight", self.position_weight, "1/m^2", Range{1e-6, 1e6},
          "lambda_p of eq. 19 for x and y; our choice");
    visit("heading_weight", self.heading_weight, ScaledUnit{"1/rad^2", Scale::area}, Range{1e-6, 1e6},
          "lambda_p of eq. 19 for the heading; our choice");
    visit("effort_weight", self.effort_weight, "s^2/m^2", Range{1e-6, 1e6},
          "lambda_u of eq. 19, on wheel speeds minus the reference's; our choice");
    visit("rate_weight", self.rate_weight, "s^2/m^2", Range{0.0, 1e6},
          "weight of the change of wheel speeds between steps; our addition");
  }
};

/// u_0..u_{H-1} of a drive.
using DriveInputs = std::array<DriveInput, kMaxHorizon>;

struct MpcProblem {
  Eigen::Vector3d initial_pose = Eigen::Vector3d::Zero();  ///< z_0
  Eigen::Vector3d disturbance = Eigen::Vector3d::Zero();   ///< d, world [m/s, m/s, rad/s]
  DriveInput previous_wheel_speeds;                        ///< u_{-1} of the rate term
  Reference reference;                                     ///< steps as MpcParameters::horizon
};

enum class MpcStatus {
  converged,        ///< to the tolerance
  iteration_limit,  ///< the usual end of a few iterations; the command is near-optimal
  step_limit,  ///< an active set was not found within its step limit; the command is feasible, perhaps not
               ///< optimal
  invalid_problem,  ///< not finite, or of another horizon: the command is zero
};

struct MpcResult {
  MpcStatus status = MpcStatus::invalid_problem;
  DriveInputs wheel_speeds;                           ///< u_0..u_{H-1}, within the limits
  std::array<Eigen::Vector3d, kMaxHorizon + 1> pose;  ///< z_0..z_H predicted by the nonlinear model
  double cost = 0.0;                                  ///< of eq. 19 in our reading
  double optimality_residual = 0;  ///< largest component of the projected gradient; 0 at an optimum
  double largest_violation = 0;    ///< [m] of a soft bound by z_1..z_H
  double last_change = 0.0;        ///< [m/s] of a wheel speed by the last iteration
  int iterations = 0;
  int active_set_steps = 0;  ///< over all iterations
  bool fell_back = false;    ///< in one of them the slower method had to take over
};

/// Gauss-Newton on the nonlinear problem. The first iteration linearises about the reference (not about the
/// previous tick's solution: after a jump of the estimate that is a hundred times worse), each further one
/// about the last solution. Never throws or allocates after construction.
class ModelPredictiveController {
 public:
  /// Throws std::invalid_argument on parameters out of range or bounds that cross.
  ModelPredictiveController(const MpcParameters& parameters, const Drive& drive);
  ~ModelPredictiveController();
  ModelPredictiveController(ModelPredictiveController&&) noexcept;
  ModelPredictiveController& operator=(ModelPredictiveController&&) noexcept;

  const MpcResult& solve(const MpcProblem& problem);
  [[nodiscard]] const MpcResult& last() const;
  /// Drops the warm start. It changes the work, not the optimum.
  void forget();
  [[nodiscard]] const MpcParameters& parameters() const { return parameters_; }

  /// The same for a fixed number of inputs (mpc_core.hpp).
  class Core;

 private:
  MpcParameters parameters_;
  std::unique_ptr<Core> core_;
};

}  // namespace spf
