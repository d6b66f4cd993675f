// Seeded random numbers: splitmix64, with our own uniform and normal so that every platform draws the same.
// One independent stream per role: RandomStream{mix(mix(seed, role), index)}.
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace spf {

class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : state_{seed} {}

  /// Next 64 random bits.
  std::uint64_t bits();
  /// Uniform in [0, 1): the top 53 bits.
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal: sqrt(-2 ln(1 - u1)) cos(2 pi u2), two uniforms a draw.
  double normal();
  /// Two standard normals, x drawn before y.
  Eigen::Vector2d normal2();

 private:
  std::uint64_t state_;
};

/// Seed derived from a pair: the second output of splitmix64 seeded with a * 0x9E3779B97F4A7C15 + b.
[[nodiscard]] std::uint64_t mix(std::uint64_t a, std::uint64_t b);

}  // namespace spf
