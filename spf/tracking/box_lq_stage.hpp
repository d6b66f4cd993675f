// Arithmetic of one stage of box_lq.hpp, used by its two algorithms only.
#pragma once

#include <Eigen/Core>

#include "spf/tracking/box_lq.hpp"

namespace spf::box_lq {

using Eigen::Matrix3d;
using Eigen::Vector3d;

inline Vector3d clipped(const Vector3d& input, double limit) {
  return input.cwiseMax(-limit).cwiseMin(limit);
}

inline Vector3d advance(const BoxLqStage& stage, const Vector3d& state, const Vector3d& input) {
  Vector3d next = state + stage.input_matrix * input;
  next.x() += stage.x_by_heading * state.z();
  next.y() += stage.y_by_heading * state.z();
  return next;
}

/// A^T v.
inline Vector3d transposed(const BoxLqStage& stage, const Vector3d& v) {
  return {v.x(), v.y(), v.z() + stage.x_by_heading * v.x() + stage.y_by_heading * v.y()};
}

/// M A.
inline Matrix3d times_transition(const Matrix3d& m, const BoxLqStage& stage) {
  Matrix3d product = m;
  product.col(2) += stage.x_by_heading * m.col(0) + stage.y_by_heading * m.col(1);
  return product;
}

/// A^T M.
inline Matrix3d transition_times(const BoxLqStage& stage, const Matrix3d& m) {
  Matrix3d product = m;
  product.row(2) += stage.x_by_heading * m.row(0) + stage.y_by_heading * m.row(1);
  return product;
}

}  // namespace spf::box_lq
