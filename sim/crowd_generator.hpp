// A synthetic crowd in the form of a recording: people come in at the sides of a rectangle, walk to another
// side, alone or in pairs, some stop on the way; they avoid each other at the predicted point of closest
// approach. They ignore robots. Frame: world, origin in the lower left corner of the rectangle.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/scenario.hpp"
#include "spf/math/parameters.hpp"

namespace spf::sim {

struct CrowdGeneratorParameters {
  double people = 12.0;          ///< [1] at once, on average
  double duration = 310.0;       ///< [s]
  double width = 16.0;           ///< [m] along x
  double height = 14.0;          ///< [m] along y
  double speed = 1.3;            ///< [m/s] mean of the speeds at which people like to walk
  double speed_sigma = 0.2;      ///< [m/s] and their spread
  double pairs = 0.3;            ///< [1] part of the arrivals that are two people side by side
  double stops = 0.1;            ///< [1] part of the arrivals that stop on the way
  double longest_stop = 15.0;    ///< [s]
  double sample_interval = 0.4;  ///< [s] of the recording

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("people", self.people, "1", Range{0.1, 1000.0}, "people at once, on average");
    visit("duration", self.duration, "s", Range{1.0, 36000.0}, "length of the recording");
    visit("width", self.width, "m", Range{4.0, 1000.0}, "of the area, along x");
    visit("height", self.height, "m", Range{4.0, 1000.0}, "of the area, along y");
    visit("speed", self.speed, "m/s", Range{0.2, 3.0}, "mean of the speeds at which people like to walk");
    visit("speed_sigma", self.speed_sigma, "m/s", Range{0.0, 1.0}, "spread of these speeds");
    visit("pairs", self.pairs, "1", Range{0.0, 1.0}, "part of the arrivals that are two people side by side");
    visit("stops", self.stops, "1", Range{0.0, 1.0}, "part of the arrivals that stop on the way");
    visit("longest_stop", self.longest_stop, "s", Range{0.0, 600.0}, "longest such stop");
    visit("sample_interval", self.sample_interval, "s", Range{0.1, 2.0}, "between samples of one person");
  }
};

/// Samples by time, then by person; ids 1, 2, ... in the order of arrival. Equal parameters and seed give
/// equal samples on every machine. Throws std::invalid_argument on parameters out of range.
[[nodiscard]] std::vector<CrowdSample> generate_crowd(const CrowdGeneratorParameters& parameters,
                                                      std::uint64_t seed);

}  // namespace spf::sim
