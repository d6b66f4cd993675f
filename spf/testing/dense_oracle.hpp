// Dense linear algebra to compare with. Its templates are costly to compile, so they are compiled once.
#pragma once

#include <Eigen/Core>

namespace spf {

/// Solves matrix * x = right with full pivoting; `matrix` is square and regular, `right` has any number of
/// columns.
[[nodiscard]] Eigen::MatrixXd solve_densely(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);

/// An orthogonal matrix whose columns span those of a regular square one (Householder).
[[nodiscard]] Eigen::MatrixXd orthogonal_basis(const Eigen::MatrixXd& columns);

}  // namespace spf
