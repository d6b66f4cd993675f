#include "config/number_text.hpp"

#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace spf {

#ifdef __cpp_lib_to_chars

NumberRead read_number(std::string_view text) {
  NumberRead read;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), read.value);
  read.used = static_cast<std::size_t>(rest - text.data());
  read.error = error;
  return read;
}

std::string shortest_text(double value) {
  std::array<char, 32> buffer;
  const std::to_chars_result result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::string fixed_text(double value, int decimals) {
  std::array<char, 64> buffer;
  const std::to_chars_result result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals);
  return {buffer.data(), result.ptr};
}

#else  // by the C library, which reads and writes exactly; a program that sets no locale has "C"

NumberRead read_number(std::string_view text) {
  NumberRead read;
  const std::string ended{text};  // strtod needs its end
  const bool other = ended.empty() || ended[0] == '+' || std::isspace(static_cast<unsigned char>(ended[0]));
  const bool hexadecimal = ended.find_first_of("xX") != std::string::npos;
  char* rest = nullptr;
  errno = 0;
  read.value = std::strtod(ended.c_str(), &rest);
  read.used = static_cast<std::size_t>(rest - ended.c_str());
  if (other || hexadecimal || read.used == 0) return {0.0, 0, std::errc::invalid_argument};
  if (errno == ERANGE) read.error = std::errc::result_out_of_range;
  return read;
}

std::string shortest_text(double value) {
  std::array<char, 32> buffer{};
  for (int digits = 1; digits <= 17; ++digits) {
    std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, value);
    if (std::strtod(buffer.data(), nullptr) == value) break;
  }
  return buffer.data();
}

std::string fixed_text(double value, int decimals) {
  std::array<char, 400> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, value);
  return buffer.data();
}

#endif

}  // namespace spf
