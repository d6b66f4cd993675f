// Arithmetic of one stage of box_lq.hpp, used by its two algorithms only.
#pragma once

#include <Eigen/Core>

#include "spf/tracking/box_lq.hpp"

namespace spf::box_lq {

using Eigen::Matrix3d;
using Eigen::Vector3d;

template <int N>
using Input = Eigen::Matrix<double, N, 1>;

template <int N>
Input<N> clipped(const Input<N>& input, const BoxLqProblem<N>& problem) {
  return input.cwiseMax(problem.input_lower).cwiseMin(problem.input_upper);
}

template <int N>
Vector3d advance(const BoxLqStage<N>& stage, const Vector3d& state, const Input<N>& input) {
  Vector3d next = state + stage.input_matrix * input;
  next.x() += stage.x_by_heading * state.z();
  next.y() += stage.y_by_heading * state.z();
  return next;
}

/// A^T v.
template <int N>
Vector3d transposed(const BoxLqStage<N>& stage, const Vector3d& v) {
  return {v.x(), v.y(), v.z() + stage.x_by_heading * v.x() + stage.y_by_heading * v.y()};
}

/// M A.
template <int Rows, int N>
Eigen::Matrix<double, Rows, 3> times_transition(const Eigen::Matrix<double, Rows, 3>& m,
                                                const BoxLqStage<N>& stage) {
  Eigen::Matrix<double, Rows, 3> product = m;
  product.col(2) += stage.x_by_heading * m.col(0) + stage.y_by_heading * m.col(1);
  return product;
}

/// A^T M.
template <int N>
Matrix3d transition_times(const BoxLqStage<N>& stage, const Matrix3d& m) {
  Matrix3d product = m;
  product.row(2) += stage.x_by_heading * m.row(0) + stage.y_by_heading * m.row(1);
  return product;
}

}  // namespace spf::box_lq
