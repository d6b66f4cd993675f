#include "spf/tracking/mpc.hpp"

#include <stdexcept>
#include <string>

#include "spf/tracking/mpc_core.hpp"

namespace spf {
namespace {

void check_bounds(const std::string& axis, double lower, double upper) {
  if (lower <= upper) return;
  throw std::invalid_argument(axis + "_lower = " + std::to_string(lower) + " m must not exceed " + axis +
                              "_upper = " + std::to_string(upper) + " m");
}

std::unique_ptr<ModelPredictiveController::Core> core_for(const MpcParameters& parameters,
                                                          const Drive& drive) {
  static_assert(kMaxDriveInputs == 6);
  switch (drive.inputs()) {
    case 2:
      return std::make_unique<MpcCore<2>>(parameters, drive);
    case 3:
      return std::make_unique<MpcCore<3>>(parameters, drive);
    case 4:
      return std::make_unique<MpcCore<4>>(parameters, drive);
    case 5:
      return std::make_unique<MpcCore<5>>(parameters, drive);
    default:
      return std::make_unique<MpcCore<6>>(parameters, drive);
  }
}

}  // namespace

ModelPredictiveController::ModelPredictiveController(const MpcParameters& parameters, const Drive& drive)
    : parameters_{validated(parameters)} {
  check_bounds("x", parameters_.x_lower, parameters_.x_upper);
  check_bounds("y", parameters_.y_lower, parameters_.y_upper);
  core_ = core_for(parameters_, drive);
}

ModelPredictiveController::~ModelPredictiveController() = default;
ModelPredictiveController::ModelPredictiveController(ModelPredictiveController&&) noexcept = default;
ModelPredictiveController& ModelPredictiveController::operator=(ModelPredictiveController&&) noexcept =
    default;

const MpcResult& ModelPredictiveController::solve(const MpcProblem& problem) {
  return core_->solve(problem);
}

const MpcResult& ModelPredictiveController::last() const {
  return core_->last();
}

void ModelPredictiveController::forget() {
  core_->forget();
}

}  // namespace spf
