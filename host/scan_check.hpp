// Which scans and reports of obstacles make sense.
#pragma once

#include "spf/math/pose2.hpp"
#include "spf/world/observation.hpp"

namespace spf::host {

/// Finite angles, at least one beam and at most kMostBeams, no more than one turn, a range of at most
/// kFarthest.
[[nodiscard]] bool sensible(const RangeScan& scan);
/// A pose on a robot: finite, and within 100 m of its centre.
[[nodiscard]] bool sensible(const Pose2& sensor_in_body);
/// Share of the beams without a reading (NaN, or nothing above 0), in [0, 1].
[[nodiscard]] double blind_share(const RangeScan& scan);
/// Beyond this share the sensor is covered or broken.
inline constexpr double kHalfBlind = 0.5;

/// Finite, near enough, of a size: something that a robot can keep away from.
[[nodiscard]] bool sensible(const Detection& detection);
/// All of them, and not absurdly many. One obstacle without a position spoils a report: it may be anywhere.
[[nodiscard]] bool sensible(const std::vector<Detection>& detections);

}  // namespace spf::host
