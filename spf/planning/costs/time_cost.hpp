// Travel time, the term that needs neither nodes nor coefficients.
#pragma once

#include "spf/trajectory/minco.hpp"

namespace spf {

struct TimeCost {
  double weight = 1.0;  ///< [1/s]

  /// C = weight * sum of the durations.
  [[nodiscard]] double add(const Minco& minco, Minco::Durations& wrt_durations) const {
    wrt_durations.array() += weight;
    return weight * minco.durations().sum();
  }
};

}  // namespace spf
