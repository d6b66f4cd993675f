// Numbers from and to text, whatever the language of the machine: std::from_chars and std::to_chars, which
// some standard libraries lack for floating point.
#pragma once

#include <string>
#include <string_view>
#include <system_error>

namespace spf {

struct NumberRead {
  double value = 0.0;
  std::size_t used = 0;  ///< characters of the number
  std::errc error = {};  ///< invalid_argument: there is none; result_out_of_range
};
/// The number that the text begins with, as std::from_chars reads it.
[[nodiscard]] NumberRead read_number(std::string_view text);

/// The shortest text that reads as this number, which must be finite.
[[nodiscard]] std::string shortest_text(double value);
/// With so many digits after the point.
[[nodiscard]] std::string fixed_text(double value, int decimals);

}  // namespace spf
