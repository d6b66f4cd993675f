// Pictures of one trial of a campaign: still frames at chosen times (Fig. 7) and wheel speeds over time with
// the drive limit (Fig. 9).
#pragma once

#include <vector>

#include "experiments/campaign.hpp"
#include "experiments/campaign_parts.hpp"

namespace spf {

[[nodiscard]] bool has_pictures(const Campaign& campaign);

/// Runs the trial again, recorded, and draws what the campaign's figures ask for.
[[nodiscard]] std::vector<StoredPicture> pictures_of(const Campaign& campaign, const Cell& cell, int trial);

}  // namespace spf
