#include "report/integer_column.hpp"

#include <algorithm>
#include <cmath>

namespace spf {

nlohmann::json quantised(double value, double step) {
  constexpr double kLimit = 4503599627370496.0;  // 2^52: sums and differences stay exact in a double
  if (!std::isfinite(value)) return nullptr;
  return static_cast<std::int64_t>(std::llround(std::clamp(value / step, -kLimit, kLimit)));
}

void IntegerColumn::push(double value) {
  nlohmann::json entry = quantised(value, step_);
  if (!entry.is_null()) {
    const auto integer = entry.get<std::int64_t>();
    entry = integer - last_;
    last_ = integer;
  }
  const bool is_zero = entry == 0;
  differences_.push_back(std::move(entry));
  if (!is_zero) used_ = differences_.size();
}

nlohmann::json IntegerColumn::take() {
  differences_.erase(differences_.begin() + static_cast<std::ptrdiff_t>(used_), differences_.end());
  nlohmann::json taken = std::move(differences_);
  *this = IntegerColumn{step_};
  return taken;
}

}  // namespace spf
