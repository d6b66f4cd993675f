// Splits a sweep into surfaces: adaptive breakpoint detector (Borges and Aldon, "Line extraction in 2D
// range images for mobile robotics", 2004). Frame: world.
#pragma once

#include <vector>

#include "spf/perception/perception_parameters.hpp"
#include "spf/perception/sensor_sweep.hpp"

namespace spf {

/// Why a segment ends where it does.
enum class SegmentEdge : std::uint8_t {
  free,      ///< the next beam passes behind it: an outline
  occluded,  ///< the next beam ends nearer: the surface may go on behind
  joined,    ///< the surface goes on, or nothing is known beyond
};

/// Returns [first, first + count) of Segmentation::returns().
struct Segment {
  int first = 0;
  int count = 0;
  SegmentEdge first_edge = SegmentEdge::joined;  ///< before its first beam
  SegmentEdge last_edge = SegmentEdge::joined;
};

class Segmentation {
 public:
  explicit Segmentation(const PerceptionParameters& parameters) : parameters_{parameters} {
    segments_.reserve(256);
  }

  /// Segments those returns of a sweep that are not masked (`masked`: a flag per return; `returns` in
  /// the order of beams). Up to two lost beams or masked returns in a row are bridged.
  void run(const SensorSweep& sweep, const std::vector<ScanReturn>& returns,
           const std::vector<std::uint8_t>& masked);

  /// In the order of beams, from a gap on: with a full circle a segment may run across the last and first
  /// beam (unless the sweep takes time: then a moving object has moved on between them).
  [[nodiscard]] const std::vector<ScanReturn>& returns() const { return returns_; }
  [[nodiscard]] const std::vector<Segment>& segments() const { return segments_; }

  /// Largest distance between two returns of one surface, `angle` [rad] apart, the nearer at `range` [m].
  [[nodiscard]] static double link_distance(const PerceptionParameters& parameters, double range,
                                            double angle);

 private:
  [[nodiscard]] bool linked(const SensorSweep& sweep, const ScanReturn& a, const ScanReturn& b) const;
  [[nodiscard]] SegmentEdge edge_of(const SensorSweep& sweep, const ScanReturn& end, int step) const;
  void split_at_dents(const Segment& segment);

  PerceptionParameters parameters_;
  std::vector<ScanReturn> returns_;
  std::vector<Segment> segments_;
};

}  // namespace spf
