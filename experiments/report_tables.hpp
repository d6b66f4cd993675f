// The tables of a campaign's report, as data for HTML and Markdown alike.
#pragma once

#include <vector>

#include "experiments/campaign_parts.hpp"
#include "report/page_html.hpp"

namespace spf {

/// One line for each cell.
[[nodiscard]] PageTable rows_table(const CampaignParts& parts);
/// As the paper's Table 2: one for each noise model, tracking and condition.
[[nodiscard]] std::vector<PageTable> table2_tables(const CampaignParts& parts);
/// As the paper's Table 3: one for each noise model, level and tracking.
[[nodiscard]] std::vector<PageTable> table3_tables(const CampaignParts& parts);
/// Every two methods on the same trials: one table for each scene.
[[nodiscard]] std::vector<PageTable> paired_tables(const CampaignParts& parts);
/// How often each kind of failure happened, by method, over all cells.
[[nodiscard]] PageTable failure_table(const CampaignParts& parts);
/// Times of planning calls, optimiser calls and control ticks, by method and condition.
[[nodiscard]] PageTable runtime_table(const CampaignParts& parts);

/// Largest wheel speed of each cell, and how many trials kept the limit (Fig. 9).
[[nodiscard]] PageTable wheel_table(const CampaignParts& parts);

/// Crossings, contacts and hits among recorded people (PED); no rows without such trials.
[[nodiscard]] PageTable crossings_table(const CampaignParts& parts);

/// Names of the methods, in the order of the campaign.
[[nodiscard]] std::vector<std::string> method_names(const CampaignParts& parts);
/// "walk noise at 1 Sigma, full tracking", with the condition where there is one.
[[nodiscard]] std::string scene_text(const TrialKey& key);

}  // namespace spf
