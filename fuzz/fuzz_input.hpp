// Common parts of the fuzz programs: bytes as text and as numbers, and checks that are active in every build.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>

namespace spf::fuzz {

/// Ends the program when a check fails: that reports a finding to the fuzzer.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Reads values from the front of an input; zeros after its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_{data}, left_{size} {}

  [[nodiscard]] bool empty() const { return left_ == 0; }
  std::uint8_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  template <class Whole>
  Whole whole() {
    std::array<std::uint8_t, sizeof(Whole)> raw;
    for (std::uint8_t& part : raw) part = byte();
    Whole value;
    std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }
  /// Up to `most`.
  int up_to(int most) { return byte() % (most + 1); }
  /// Mostly of the size of things in a room, sometimes any number.
  double number() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr double kSpecial[] = {0.0,    std::numeric_limits<double>::quiet_NaN(),
                                   -0.0,   kInfinity,
                                   1e-9,   -kInfinity,
                                   1e9,    -1e9,
                                   1e18,   1e300,
                                   -1e300, std::numeric_limits<double>::denorm_min()};
    const std::uint8_t kind = byte();
    if (kind < 200) return 0.05 * static_cast<double>(kind - 100);
    if (kind < 224) return kSpecial[static_cast<std::size_t>(kind - 200) % std::size(kSpecial)];
    if (kind < 240) return 0.001 * static_cast<double>(whole<std::int16_t>());
    return whole<double>();
  }
  /// A position or velocity.
  Eigen::Vector2d pair() {
    const double x = number();
    return {x, number()};
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace spf::fuzz
