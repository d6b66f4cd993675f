// Numbers of beams, segments and tracks as subscripts.
#pragma once

#include <cstddef>

namespace spf {

[[nodiscard]] constexpr std::size_t as_index(int index) {
  return static_cast<std::size_t>(index);
}

}  // namespace spf
