// Scans as sensors and messages give them: which make sense, and how they look from the robot's centre.
#pragma once

#include "spf/math/pose2.hpp"
#include "spf/world/observation.hpp"

namespace spf::host {

/// Finite angles, at least one beam and at most kMostBeams, no more than one turn, a range of at most
/// kFarthest.
[[nodiscard]] bool sensible(const RangeScan& scan);
/// A pose on a robot: finite, and within 100 m of its centre.
[[nodiscard]] bool sensible(const Pose2& sensor_in_body);
/// More than half of the beams have no reading (NaN, or nothing above 0): the sensor is covered or broken.
[[nodiscard]] bool blind(const RangeScan& scan);

/// Finite, near enough, of a size: something that a robot can keep away from.
[[nodiscard]] bool sensible(const Detection& detection);
/// All of them, and not absurdly many. One obstacle without a position spoils a report: it may be anywhere.
[[nodiscard]] bool sensible(const std::vector<Detection>& detections);

/// The scan of a sensor at a pose in the body, as one at the robot's centre would have made it: every
/// reading goes to the beam that points at it, the nearest wins, and where no reading points the beam has
/// none (NaN).
[[nodiscard]] RangeScan seen_from_centre(const RangeScan& scan, const Pose2& sensor_in_body);

}  // namespace spf::host
