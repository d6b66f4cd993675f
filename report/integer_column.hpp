// A column of numbers as small integers: quantised, then the difference to the one before; zeros at the end
// are dropped. Unknown numbers (NaN, infinity) become null and do not move the running value.
#pragma once

#include <nlohmann/json.hpp>

namespace spf {

/// value / step, rounded; unknown numbers give null, huge ones are held at +-2^52 (exact in a browser).
[[nodiscard]] nlohmann::json quantised(double value, double step);

class IntegerColumn {
 public:
  /// One unit of the stored integers, such as 0.001 for millimetres.
  explicit IntegerColumn(double step) : step_{step} {}

  void push(double value);
  /// JSON array of differences. The reader pads it with zeros to the length it expects.
  [[nodiscard]] nlohmann::json take();

 private:
  double step_;
  std::int64_t last_ = 0;
  std::size_t used_ = 0;  // up to the last entry that is not zero
  nlohmann::json differences_ = nlohmann::json::array();
};

}  // namespace spf
