#include "spf/math/random_stream.hpp"

#include <cmath>

namespace spf {
namespace {
constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL;
constexpr double kTwoPi = 6.283185307179586476925286766559;
}  // namespace

std::uint64_t RandomStream::bits() {
  std::uint64_t z = (state_ += kGolden);
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

double RandomStream::uniform() {
  return static_cast<double>(bits() >> 11U) * 0x1.0p-53;
}

double RandomStream::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(kTwoPi * uniform());
}

Eigen::Vector2d RandomStream::normal2() {
  const double x = normal();
  const double y = normal();
  return {x, y};
}

std::uint64_t mix(std::uint64_t a, std::uint64_t b) {
  RandomStream stream{a * kGolden + b};
  stream.bits();
  return stream.bits();
}

}  // namespace spf
