// Campaign files: refused by InputError, or read to cells within the limits.
#include "experiments/campaign.hpp"
#include "experiments/campaign_run.hpp"
#include "fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spf;
  try {
    const CampaignPlan plan = campaign_from_text(fuzz::text_of(data, size), "fuzz.yaml", ".");
    fuzz::require(!plan.cells.empty() && plan.cells.size() <= 2000,
                  "a campaign has some cells, and not too many");
    const std::size_t trials = trials_of(plan).size();
    fuzz::require(trials <= std::size_t{kMostTrials}, "a campaign has not too many trials");
  } catch (const InputError& error) {
    fuzz::require(error.problems().kept().size() <= InputProblems::kMostProblems,
                  "few problems are reported");
  }
  return 0;
}
