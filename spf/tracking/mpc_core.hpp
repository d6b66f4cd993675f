// The algorithm of mpc.hpp for a fixed number of inputs, behind one interface.
#pragma once

#include "spf/tracking/box_lq.hpp"
#include "spf/tracking/mpc.hpp"

namespace spf {

class ModelPredictiveController::Core {
 public:
  virtual ~Core() = default;
  virtual const MpcResult& solve(const MpcProblem& problem) = 0;
  virtual void forget() = 0;
  [[nodiscard]] const MpcResult& last() const { return result_; }

 protected:
  MpcResult result_;
};

/// Made for N = 2 to kMaxDriveInputs.
template <int N>
class MpcCore final : public ModelPredictiveController::Core {
 public:
  /// `drive` has N inputs.
  MpcCore(const MpcParameters& parameters, const Drive& drive);

  const MpcResult& solve(const MpcProblem& problem) override;
  void forget() override { solver_.forget(); }

 private:
  using Input = Eigen::Matrix<double, N, 1>;

  void set_up(const MpcProblem& problem);
  void linearise(const MpcProblem& problem, const StateSequence& about, const InputSequence<N>& inputs);
  double roll_out(const MpcProblem& problem, const InputSequence<N>& inputs, StateSequence& states) const;
  double move_towards_trial(const MpcProblem& problem, double cost);
  double try_fraction(const MpcProblem& problem, double fraction);
  const MpcResult& finish(const MpcProblem& problem, double cost);
  [[nodiscard]] Eigen::Vector3d twist_body(const Input& input) const {
    if (linear_) return body_from_input_ * input;
    return drive_.twist_body(input);
  }
  [[nodiscard]] Eigen::Matrix<double, 3, N> jacobian(const Input& input) const {
    if (linear_) return body_from_input_;
    return drive_.jacobian(input);
  }

  MpcParameters parameters_;
  Drive drive_;
  bool linear_;  // the motion is linear in the inputs
  Eigen::Matrix<double, 3, N> body_from_input_;
  BoxLqProblem<N> lq_;
  BoxLqSolver<N> solver_;
  InputSequence<N> inputs_;
  InputSequence<N> trial_inputs_;
  InputSequence<N> input_steps_;
  InputSequence<N> best_inputs_;
  StateSequence trial_states_;
};

}  // namespace spf
