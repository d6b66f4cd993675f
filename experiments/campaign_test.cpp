#include "experiments/campaign.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "config/contradiction_report.hpp"
#include "config/parameter_text.hpp"
#include "experiments/campaign_run.hpp"
#include "experiments/paper_figures.hpp"
#include "spf/testing/source_dir.hpp"

namespace spf {
namespace {

using testing::HasSubstr;

CampaignPlan plan_of(const std::string& text) {
  return campaign_from_text("name: test\nfamilies: [t2]\n" + text, "test.yaml", ".");
}

TEST(Campaign, CrossesItsAxes) {
  const CampaignPlan plan =
      plan_of("methods: [orca, es2]\nlevels: [0, 1, 2]\nnoise: [white, walk]\ntracking: [ideal, full]\n");
  EXPECT_EQ(plan.cells.size(), 2u * 3u * 2u * 2u);
  std::set<std::string> files, setups;
  for (const Cell& cell : plan.cells) {
    files.insert(cell_file_name(cell.key));
    setups.insert(cell.setup);
    EXPECT_EQ(cell.key.method, cell.config.method.name());
    EXPECT_EQ(cell.key.level, cell.config.simulation.noise.level);
    EXPECT_EQ(cell.key.noise, enum_name(cell.config.simulation.noise.model));
    EXPECT_EQ(cell.key.tracking, enum_name(cell.config.simulation.trial.tracking));
  }
  EXPECT_EQ(files.size(), plan.cells.size());
  EXPECT_EQ(setups.size(), plan.cells.size());
}

TEST(Campaign, LeavesWhatItDoesNotNameToTheScenario) {
  const CampaignPlan plan = campaign_from_text("name: test\nfamilies: [p8]\n", "test.yaml", ".");
  ASSERT_EQ(plan.cells.size(), 1u);
  const RunConfiguration p8 = default_run_configuration(SceneFamily{sim::Family::p8}, "space_time");
  EXPECT_EQ(to_yaml_text(plan.cells[0].config), to_yaml_text(p8));
}

TEST(Campaign, VariantsAndConditionsSetWhatTheySay) {
  const CampaignPlan plan = plan_of(
      "methods: [orca]\n"
      "tracking: [full]\n"
      "variants: [{name: fast, method: orca, set: [agent.orca.limit_acceleration=false], tracking: "
      "[ideal]}]\n"
      "conditions: [{name: one, set: [pose_noise.position_sigma=0.5], methods: [fast]}, {name: two}]\n");
  ASSERT_EQ(plan.cells.size(), 3u);
  EXPECT_EQ(plan.cells[0].key.method, "fast");
  EXPECT_EQ(plan.cells[0].key.condition, "one");
  EXPECT_EQ(plan.cells[0].key.tracking, "ideal");
  EXPECT_FALSE(plan.cells[0].config.agent.orca.limit_acceleration);
  EXPECT_EQ(plan.cells[0].config.simulation.pose_noise.position_sigma, 0.5);
  EXPECT_EQ(plan.cells[1].key.method, "orca");
  EXPECT_EQ(plan.cells[1].key.tracking, "full");
  EXPECT_TRUE(plan.cells[1].config.agent.orca.limit_acceleration);
  EXPECT_EQ(plan.cells[1].config.simulation.pose_noise.position_sigma, 0.0);
}

TEST(Campaign, ObserversKnowTheNoiseUnlessTold) {
  const CampaignPlan plan = plan_of(
      "set: [pose_noise.position_sigma=0.5, pose_noise.heading_sigma=0.01]\n"
      "conditions: [{name: informed}, {name: misinformed, set: [agent.tracker.observer.pose_sigma=0.1]}]\n");
  ASSERT_EQ(plan.cells.size(), 2u);
  const ObserverParameters informed = agent_parameters(plan.cells[0].config).tracker.observer;
  EXPECT_EQ(informed.pose_sigma, 0.5);
  EXPECT_EQ(informed.heading_sigma, 0.01);
  EXPECT_EQ(agent_parameters(plan.cells[1].config).tracker.observer.pose_sigma, 0.1);
}

TEST(Campaign, WritesItselfSoThatItReadsBack) {
  const CampaignPlan plan = plan_of("methods: [orca]\nlevels: [0.25]\nfigures: [table2]\ntimes: [1, 2.5]\n");
  const CampaignPlan again = campaign_from_text(to_yaml_text(plan.campaign), "again.yaml", ".");
  EXPECT_EQ(to_yaml_text(again.campaign), to_yaml_text(plan.campaign));
  ASSERT_EQ(again.cells.size(), 1u);
  EXPECT_EQ(again.cells[0].setup, plan.cells[0].setup);
}

/// Why a campaign is refused.
std::string refusal(const std::string& text) {
  try {
    static_cast<void>(plan_of(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string numbers(const std::string& key, int count) {
  std::string text = key + ": [0";
  for (int i = 1; i < count; ++i) text += ", " + std::to_string(0.001 * i);
  return text + "]\n";
}

TEST(Campaign, RefusesMoreCellsAndTrialsThanAnybodyRuns) {
  std::string conditions = "conditions:\n";
  for (int i = 0; i < 1000; ++i) conditions += "  - {name: c" + std::to_string(i) + "}\n";
  EXPECT_THAT(refusal(conditions + numbers("levels", 2000) + "noise: [white, walk]\n"),
              HasSubstr("has 8000000 combinations: must be at most 100000 (conditions x scenes x noise x"));
  EXPECT_THAT(refusal(numbers("levels", 2001)), HasSubstr("asks for 2001 cells: must be at most 2000"));
  EXPECT_THAT(refusal("trials: 10000000\n"),
              HasSubstr("test.yaml:3:9: trials = 10000000 makes 10000000 trials of 1 cells: must be at most "
                        "1000000 in all"));
  EXPECT_THAT(refusal("trials: 600000\nmethods: [orca, es2]\n"),
              HasSubstr("makes 1200000 trials of 2 cells"));
  EXPECT_EQ(refusal("trials: 1000000\n"), "");
  std::string settings = "set: [sensing.range=5";
  for (int i = 0; i < 100; ++i) settings += ", sensing.range=5";
  EXPECT_THAT(refusal(settings + "]\n"), HasSubstr("set has 101 settings: must be at most 100"));
}

TEST(Campaign, LooksAtAHundredCellsThatCannotRunAndNoMore) {
  const std::string found = refusal(numbers("levels", 1000) + "set: [sensing.range=-1]\n");
  EXPECT_THAT(found, HasSubstr("100 cells cannot run; further ones were not looked at"));
}

TEST(CampaignPresets, AreGoodAndHaveThePapersRows) {
  ASSERT_EQ(campaign_presets().size(), 5u);
  for (const CampaignPreset& preset : campaign_presets()) {
    const CampaignPlan plan = campaign_from_text(std::string{preset.text}, std::string{preset.name}, ".");
    EXPECT_EQ(plan.campaign.name, preset.name);
    int paper_rows = 0;
    for (const Cell& cell : plan.cells) {
      if (preset.name == "table2")
        paper_rows += paper_table2(cell.key.level, cell.key.method) != nullptr ? 1 : 0;
      if (preset.name == "table3")
        paper_rows += paper_table3(cell.key.condition, cell.key.method) != nullptr ? 1 : 0;
    }
    // Both noise models; and, of Table 3, both levels.
    const int expected = preset.name == "table2" ? 9 * 2 : preset.name == "table3" ? 5 * 2 * 2 : 0;
    EXPECT_EQ(paper_rows, expected) << preset.name;
  }
  const std::string file = source_dir() + "/scenarios/experiments/es2_check.yaml";
  EXPECT_EQ(read_campaign(file).cells.size(), 4u);
}

TEST(Campaign, ShippedOnesContradictThemselvesNowhere) {
  std::size_t cells = 0;
  const std::filesystem::path folder{source_dir() + "/scenarios/experiments"};
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator{folder})
    for (const Cell& cell : read_campaign(entry.path().string()).cells) {
      ++cells;
      for (const InputProblem& warning : cell.config.warnings)
        ADD_FAILURE() << cell_text(cell.key) << ": " << warning_text(warning);
    }
  EXPECT_GT(cells, 100u);
}

// Every trial is in exactly one shard, and every cell has its share in each.
TEST(CampaignShards, SplitEveryCellEvenly) {
  const CampaignPlan plan = plan_of("methods: [orca, es2, space_time]\nlevels: [0, 1]\ntrials: 24\n");
  for (const int count : {1, 2, 3, 4, 7, 12}) {
    SCOPED_TRACE(count);
    std::set<std::pair<int, int>> seen;
    for (int index = 1; index <= count; ++index) {
      std::vector<int> of_cell(plan.cells.size(), 0);
      for (const CampaignTrial& trial : trials_of(plan, {index, count})) {
        EXPECT_TRUE(seen.emplace(trial.cell, trial.trial).second);
        ++of_cell[static_cast<std::size_t>(trial.cell)];
      }
      for (const int trials : of_cell) EXPECT_NEAR(trials, 24.0 / count, 1.0);
    }
    EXPECT_EQ(seen.size(), plan.cells.size() * 24u);
  }
}

TEST(CampaignShards, AreEquallyLongEvenWhenThereAreMany) {
  const CampaignPlan plan = plan_of("methods: [orca, es2, space_time]\nlevels: [0, 1]\ntrials: 5\n");
  std::size_t all = 0;
  for (int index = 1; index <= 10; ++index) {
    const std::size_t trials = trials_of(plan, {index, 10}).size();
    EXPECT_EQ(trials, 3u);
    all += trials;
  }
  EXPECT_EQ(all, 30u);
}

}  // namespace
}  // namespace spf
