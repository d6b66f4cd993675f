// Numbers that count something (steps, beams, robots) as subscripts; they must not be negative.
#pragma once

#include <cstddef>

namespace spf {

[[nodiscard]] constexpr std::size_t as_index(int index) {
  return static_cast<std::size_t>(index);
}

}  // namespace spf
