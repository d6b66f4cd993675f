// A campaign's report: tables in the paper's form with its figures beside ours, paired comparisons, charts,
// and causes of failure. As sections of an HTML page and as Markdown.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiments/campaign_parts.hpp"
#include "report/page_html.hpp"

namespace spf {

/// Replay pages of trials: (index of the cell, trial) -> address relative to the report.
using ReplayLinks = std::map<std::pair<std::size_t, int>, std::string>;

[[nodiscard]] std::vector<PageSection> report_sections(const CampaignParts& parts,
                                                       const ReplayLinks& replays);

/// The charts of the report as separate files; the names end in .svg.
[[nodiscard]] std::vector<StoredPicture> report_pictures(const CampaignParts& parts);

/// The tables of the report as Markdown.
[[nodiscard]] std::string report_markdown(const CampaignParts& parts);

/// The command that runs a trial of a cell again and shows it; empty when its scenario file is missing.
[[nodiscard]] std::string replay_command(const CampaignParts& parts, std::size_t cell, int trial);

}  // namespace spf
