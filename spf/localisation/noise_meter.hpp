// Variance of white measurement noise, from the measurements themselves. An innovation is the measured change
// from one measurement to the next minus the predicted change. Every measurement's noise enters two
// innovations in a row, with opposite signs, so the mean of their product is minus the variance of the noise.
// A lasting error of the prediction enters both with the same sign and only lowers the estimate.
#pragma once

#include <algorithm>

namespace spf {

class NoiseMeter {
 public:
  /// `remembered` [1]: number of measurements over which it averages.
  explicit NoiseMeter(int remembered) : remembered_{remembered} {}

  /// The next innovation.
  void note(double innovation) {
    if (count_ > 0) mean_ += (-innovation * last_ - mean_) / count_;
    count_ = std::min(count_ + 1, remembered_);
    last_ = innovation;
  }
  /// Variance of one measurement; 0 while there is no evidence of noise.
  [[nodiscard]] double variance() const { return std::max(mean_, 0.0); }
  void reset() { *this = NoiseMeter{remembered_}; }

 private:
  int remembered_;
  int count_ = 0;
  double last_ = 0.0;
  double mean_ = 0.0;
};

}  // namespace spf
