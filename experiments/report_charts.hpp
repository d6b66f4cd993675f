// The charts of a campaign's report, as SVG elements of a page.
#pragma once

#include <string>
#include <vector>

#include "experiments/campaign_parts.hpp"

namespace spf {

/// Success against the noise level with Wilson intervals: one chart for each noise model, tracking and
/// condition with more than one level.
[[nodiscard]] std::vector<std::string> success_charts(const CampaignParts& parts);
/// Travel times of robots in successful trials: one chart for each scene.
[[nodiscard]] std::vector<std::string> travel_charts(const CampaignParts& parts);
/// Histograms of the time of new plans (all planning calls for a method that reports no new plans) and
/// control ticks.
[[nodiscard]] std::vector<std::string> time_charts(const CampaignParts& parts);
/// Median and 99th percentile of each part's time, by method and condition (Fig. 6).
[[nodiscard]] std::vector<std::string> part_charts(const CampaignParts& parts);

}  // namespace spf
