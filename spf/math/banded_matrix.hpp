// Square banded matrix with its LU factors in place, without pivoting: for systems whose row order makes
// every pivot safe (such as MINCO's). Capacity is fixed at construction; nothing allocates afterwards.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace spf {

/// Lower and Upper diagonals besides the main one. Work per factorisation: size * Lower * Upper.
template <int Lower, int Upper>
class BandedMatrix {
 public:
  explicit BandedMatrix(int max_size) : band_{kRows, max_size + Upper}, inverse_pivots_(max_size) {
    reset(0);
  }

  /// An all-zero matrix of a size up to the capacity.
  void reset(int size) {
    assert(0 <= size && size <= inverse_pivots_.size());
    size_ = size;
    band_.leftCols(size + Upper).setZero();
  }

  [[nodiscard]] int size() const { return size_; }

  /// Entry inside the band, for filling. Not after factorize().
  double& operator()(int row, int column) {
    assert(0 <= row && row < size_ && 0 <= column && column < size_);
    assert(row - column <= Lower && column - row <= Upper);
    return band_(Upper + row - column, column);
  }

  /// Replaces the entries by the factors L (unit diagonal) and U.
  void factorize() {
    regular_ = true;
    for (int k = 0; k < size_; ++k) {
      const double pivot = band_(Upper, k);
      regular_ = regular_ && pivot != 0.0 && std::isfinite(pivot);
      inverse_pivots_[k] = 1.0 / pivot;
      // Entries outside the matrix are zero, and columns are padded, so that every step has the same fixed
      // shape.
      const Eigen::Matrix<double, Lower, 1> multipliers =
          band_.col(k).template segment<Lower>(Upper + 1) * inverse_pivots_[k];
      band_.col(k).template segment<Lower>(Upper + 1) = multipliers;
      for (int d = 1; d <= Upper; ++d) {
        const double factor = band_(Upper - d, k + d);
        if (factor != 0.0) band_.col(k + d).template segment<Lower>(Upper - d + 1) -= factor * multipliers;
      }
    }
  }

  /// Whether the last factorize() met no pivot that is zero or not finite. Otherwise solutions are not
  /// finite.
  [[nodiscard]] bool regular() const { return regular_; }

  /// Solves A X = B in place, after factorize(). Rows of `unknowns` beyond size() are left alone.
  template <class Derived>
  void solve_in_place(Eigen::MatrixBase<Derived>& unknowns) const {
    assert(unknowns.rows() >= size_);
    for (int k = 0; k < size_; ++k) {
      const int last = std::min(k + Lower, size_ - 1);
      for (int i = k + 1; i <= last; ++i) unknowns.row(i) -= band_(Upper + i - k, k) * unknowns.row(k);
    }
    for (int k = size_ - 1; k >= 0; --k) {
      unknowns.row(k) *= inverse_pivots_[k];
      for (int i = std::max(0, k - Upper); i < k; ++i)
        unknowns.row(i) -= band_(Upper + i - k, k) * unknowns.row(k);
    }
  }

  /// Solves A^T X = B in place with the same factors.
  template <class Derived>
  void solve_transposed_in_place(Eigen::MatrixBase<Derived>& unknowns) const {
    assert(unknowns.rows() >= size_);
    for (int k = 0; k < size_; ++k) {
      for (int i = std::max(0, k - Upper); i < k; ++i)
        unknowns.row(k) -= band_(Upper + i - k, k) * unknowns.row(i);
      unknowns.row(k) *= inverse_pivots_[k];
    }
    for (int k = size_ - 1; k >= 0; --k) {
      const int last = std::min(k + Lower, size_ - 1);
      for (int i = k + 1; i <= last; ++i) unknowns.row(k) -= band_(Upper + i - k, k) * unknowns.row(i);
    }
  }

 private:
  static constexpr int kRows = Lower + Upper + 1;

  Eigen::Matrix<double, kRows, Eigen::Dynamic> band_;  // entry (i, j) at (Upper + i - j, j)
  Eigen::VectorXd inverse_pivots_;
  int size_ = 0;
  bool regular_ = false;
};

}  // namespace spf
