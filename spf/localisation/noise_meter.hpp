// How noisy measurements are, from themselves: noise that is fresh in each of them makes one too large and
// the change to the next too small. So of two surprises in a row (by which the measured change differs from
// the expected one) the product is on average minus the variance of the noise, whereas motion that was not
// expected surprises alike twice.
#pragma once

#include <algorithm>

namespace spf {

class NoiseMeter {
 public:
  /// `remembered` [1]: measurements over which it averages.
  explicit NoiseMeter(int remembered) : remembered_{remembered} {}

  /// By how much the next measured change differs from the expected one.
  void note(double surprise) {
    if (surprises_ > 0) mean_ += (-surprise * last_ - mean_) / surprises_;
    surprises_ = std::min(surprises_ + 1, remembered_);
    last_ = surprise;
  }
  /// Of one measurement; 0 while nothing tells of noise.
  [[nodiscard]] double variance() const { return std::max(mean_, 0.0); }
  void reset() { *this = NoiseMeter{remembered_}; }

 private:
  int remembered_;
  int surprises_ = 0;
  double last_ = 0.0;
  double mean_ = 0.0;
};

}  // namespace spf
