// Recordings of people as CSV files: columns t_s, agent_id, x_m, y_m (in any order, others are ignored),
// sorted by time. Frame: world of the recording, SI units.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "config/input_problem.hpp"
#include "sim/crowd_recording.hpp"

namespace spf {

/// Reads a recording. Every problem is collected with file, line, column name, value and limit; null when
/// there is any. `asked_at` is the location that names the file, for problems of the file as a whole.
[[nodiscard]] std::shared_ptr<const sim::CrowdRecording> read_crowd_file(const std::string& path,
                                                                         const SourceLocation& asked_at,
                                                                         InputProblems& problems);
/// The same from text; `name` stands for the file in messages.
[[nodiscard]] std::shared_ptr<const sim::CrowdRecording> crowd_from_text(std::string_view text,
                                                                         const std::string& name,
                                                                         InputProblems& problems);

/// The text of such a file, with positions to 0.1 mm.
[[nodiscard]] std::string crowd_text(const std::vector<sim::CrowdSample>& samples);

}  // namespace spf
