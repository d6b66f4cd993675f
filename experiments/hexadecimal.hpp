// Hashes as text.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

namespace spf {

/// Sixteen hexadecimal digits.
[[nodiscard]] inline std::string hexadecimal(std::uint64_t value) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(value));
  return digits;
}

}  // namespace spf
