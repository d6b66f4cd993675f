// A still picture of the scene at one instant, for documents: SVG, light palette, y up.
#pragma once

#include <string>

#include "report/replay_data.hpp"

namespace spf {

struct FrameSvgOptions {
  double width = 720.0;  ///< [px]; the height follows from the bounds
  bool dark = false;
  bool plans = true;
  bool trails = true;
};

/// The frame nearest to `time` (held within the run), with trails up to it, the plans that were valid then,
/// and the contacts so far. Throws as require_consistent() does when the data does not fit together.
[[nodiscard]] std::string render_frame_svg(const ReplayData& data, double time,
                                           const FrameSvgOptions& options = {});

}  // namespace spf
