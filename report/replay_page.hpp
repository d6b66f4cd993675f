// The replay page: one HTML file that holds its data, script and style, and asks the network for nothing.
#pragma once

#include <string>

#include "report/replay_data.hpp"

namespace spf {

/// The whole file, UTF-8. Every text of `data` is escaped. Throws as require_consistent() does.
/// A reader may add ?t=12.5&robot=3 (or #t=12.5&robot=3) to the page's address.
[[nodiscard]] std::string render_replay(const ReplayData& data);

}  // namespace spf
