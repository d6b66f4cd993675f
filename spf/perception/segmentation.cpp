#include "spf/perception/segmentation.hpp"

#include <algorithm>
#include <cmath>

namespace spf {
namespace {

constexpr int kBridgedBeams = 2;

}  // namespace

double Segmentation::link_distance(const PerceptionParameters& parameters, double range, double angle) {
  // Spacing of the returns of a surface that beams hit at the angle lambda.
  const double sharpest = std::max(parameters.breakpoint_angle - angle, 0.25 * parameters.breakpoint_angle);
  return range * std::sin(angle) / std::sin(sharpest) + 3.0 * parameters.range_sigma;
}

bool Segmentation::linked(const SensorSweep& sweep, const ScanReturn& a, const ScanReturn& b) const {
  int steps = b.beam - a.beam;
  if (steps <= 0) steps += sweep.beams();  // over the seam
  if (steps > 1 + kBridgedBeams) return false;
  const double angle = steps * std::abs(sweep.scan->angle_increment);
  const double limit = link_distance(parameters_, std::min(a.range, b.range), angle);
  return (a.position_world - b.position_world).squaredNorm() < limit * limit;
}

SegmentEdge Segmentation::edge_of(const SensorSweep& sweep, const ScanReturn& end, int step) const {
  const int beam = sweep.wrapped(long{end.beam} + step);
  if (beam < 0 || (beam != end.beam + step && !sweep.seamless())) return SegmentEdge::joined;
  switch (beam_end(*sweep.scan, beam)) {
    case BeamEnd::unknown:
      return SegmentEdge::joined;
    case BeamEnd::open: {
      // Near its range limit the sensor loses a surface that bends away: no outline.
      const bool out_of_reach = end.range + parameters_.prior_radius > sweep.scan->max_range;
      return out_of_reach ? SegmentEdge::joined : SegmentEdge::free;
    }
    case BeamEnd::hit:
      break;
  }
  const double range = sweep.scan->ranges[static_cast<std::size_t>(beam)];
  const double angle = std::abs(sweep.scan->angle_increment);
  if (std::abs(range - end.range) < link_distance(parameters_, std::min(range, end.range), angle))
    return SegmentEdge::joined;
  return range < end.range ? SegmentEdge::occluded : SegmentEdge::free;
}

void Segmentation::run(const SensorSweep& sweep, const std::vector<ScanReturn>& returns,
                       const std::vector<std::uint8_t>& masked) {
  returns_.clear();
  segments_.clear();
  returns_.reserve(static_cast<std::size_t>(sweep.beams()));
  for (std::size_t k = 0; k < returns.size(); ++k)
    if (masked[k] == 0) returns_.push_back(returns[k]);
  if (returns_.empty()) return;

  // Full circle: start behind a gap, so that no segment is cut at the first beam.
  if (sweep.seamless() && linked(sweep, returns_.back(), returns_.front())) {
    std::size_t begin = 1;
    while (begin < returns_.size() && linked(sweep, returns_[begin - 1], returns_[begin])) ++begin;
    if (begin < returns_.size())
      std::rotate(returns_.begin(), returns_.begin() + static_cast<std::ptrdiff_t>(begin), returns_.end());
  }
  const int count = static_cast<int>(returns_.size());
  Segment segment{0, 0, edge_of(sweep, returns_.front(), -1), SegmentEdge::joined};
  for (int k = 0; k < count; ++k) {
    const ScanReturn& end = returns_[static_cast<std::size_t>(k)];
    if (k + 1 < count && linked(sweep, end, returns_[static_cast<std::size_t>(k) + 1])) continue;
    segment.count = k + 1 - segment.first;
    segment.last_edge = edge_of(sweep, end, 1);
    split_at_dents(segment);
    if (k + 1 == count) break;
    segment.first = k + 1;
    segment.first_edge = edge_of(sweep, returns_[static_cast<std::size_t>(k) + 1], -1);
  }
}

// Two objects side by side appear as one surface with a dent between them: the range rises by split_depth
// after a minimum and falls by it again. The cut is at the maximum, which belongs to the second part.
void Segmentation::split_at_dents(const Segment& segment) {
  const double depth = std::max(parameters_.split_depth, 5.0 * parameters_.range_sigma);
  Segment part = segment;
  const int end = segment.first + segment.count;
  double nearest = returns_[static_cast<std::size_t>(segment.first)].range;
  double deepest = nearest;
  int deepest_at = segment.first;
  for (int k = segment.first + 1; k < end; ++k) {
    const double range = returns_[static_cast<std::size_t>(k)].range;
    if (range > deepest) {
      deepest = range;
      deepest_at = k;
    }
    const bool dent = deepest - nearest > depth && deepest - range > depth && deepest_at > part.first;
    if (dent) {
      part.count = deepest_at - part.first;
      part.last_edge = SegmentEdge::joined;
      segments_.push_back(part);
      part.first = deepest_at;
      part.first_edge = SegmentEdge::joined;
      nearest = deepest = range;
      deepest_at = k;
    } else if (range < nearest && deepest - nearest <= depth) {
      nearest = deepest = range;  // still approaching the minimum
      deepest_at = k;
    }
  }
  part.count = end - part.first;
  part.last_edge = segment.last_edge;
  segments_.push_back(part);
}

}  // namespace spf
