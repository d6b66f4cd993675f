// The scene of the family PED: robots cross a window of a recorded crowd (docs/protocol.md). Frame: world
// of the recording.
#pragma once

#include "sim/crowd_recording.hpp"
#include "sim/families.hpp"

namespace spf::sim {

/// Number of trials in a recording: that of its windows.
[[nodiscard]] int pedestrian_trials(const CrowdRecording& crowd, const LayoutParameters& layout);

/// Fills in robots, people and, where none is set, the time limit of a trial. The scenario's robot must be
/// set. The robots enter in the middle of the sides of the recording's extent and leave on the opposite side;
/// the start is delayed in steps of 0.4 s while a person is within 1 m of a robot. Throws std::runtime_error
/// when the recording has no such window or no such start.
void place_among_people(const CrowdRecording& crowd, const LayoutParameters& layout, int trial,
                        Scenario& scenario);

}  // namespace spf::sim
