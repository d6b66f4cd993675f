// Recordings of people as files: CSV with named columns (t_s, agent_id, x_m, y_m and other names for them),
// TrajNet++ (JSON objects a line), obsmat of ETH and the columns frame, id, x, y. The format is told by the
// first line. Frame: world of the recording, SI units.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "config/input_problem.hpp"
#include "sim/crowd_recording.hpp"
#include "spf/math/parameters.hpp"

namespace spf {

/// What a scenario says of its recording besides the file.
struct CrowdSettings {
  double frame_rate = 0.0;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("frame_rate", self.frame_rate, "1/s", Range{0.0, 1000.0},
          "of recordings that number frames; 0: what the file says, else 0.4 s between samples of a person");
  }
};

/// Reads a recording. Every problem is collected with file, line, column name, value and limit; null when
/// there is any. `asked_at` is the location that names the file, for problems of the file as a whole. Lines
/// may have any order; times that begin beyond 10^7 s (since some epoch) are counted from the first one; ids
/// above 999999 make all ids be numbered anew.
[[nodiscard]] std::shared_ptr<const sim::CrowdRecording> read_crowd_file(const std::string& path,
                                                                         const SourceLocation& asked_at,
                                                                         InputProblems& problems,
                                                                         const CrowdSettings& settings = {});
/// The same from text; `name` stands for the file in messages.
[[nodiscard]] std::shared_ptr<const sim::CrowdRecording> crowd_from_text(std::string_view text,
                                                                         const std::string& name,
                                                                         InputProblems& problems,
                                                                         const CrowdSettings& settings = {});

/// The text of such a file as CSV, with positions to 0.1 mm.
[[nodiscard]] std::string crowd_text(const std::vector<sim::CrowdSample>& samples);

}  // namespace spf
