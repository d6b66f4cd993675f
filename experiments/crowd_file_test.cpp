#include "study/crowd_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "experiments/result_row.hpp"
#include "experiments/run_configuration_test.hpp"
#include "sim/crowd_generator.hpp"
#include "spf/testing/source_dir.hpp"
#include "study/scenario_file.hpp"

namespace spf {
namespace {

using testing::HasSubstr;

const std::string kPed = source_dir() + "/scenarios/ped.yaml";
const std::string kHeader = "t_s,agent_id,x_m,y_m\n";

std::string problems_of(const std::string& text) {
  InputProblems problems;
  static_cast<void>(crowd_from_text(text, "crowd.csv", problems));
  return problems.to_text();
}

TEST(CrowdFile, ReadsColumnsByName) {
  InputProblems problems;
  const auto crowd =
      crowd_from_text("\xEF\xBB\xBFy_m, agent_id ,note,x_m,t_s\r\n2.5,7,a,1,0\r\n3,7,b,1e0,0.4\r\n\r\n",
                      "crowd.csv", problems);
  ASSERT_TRUE(problems.empty()) << problems.to_text();
  ASSERT_EQ(crowd->samples().size(), 2U);
  EXPECT_EQ(crowd->samples()[1].time, 0.4);
  EXPECT_EQ(crowd->samples()[1].id, 7);
  EXPECT_EQ(crowd->samples()[1].position_world, Eigen::Vector2d(1.0, 3.0));
}

TEST(CrowdFile, SaysWhatIsWrongAndWhere) {
  struct Bad {
    std::string text, expected;
  };
  const std::vector<Bad> table{
      {"", "crowd.csv: is empty"},
      {kHeader, "crowd.csv: holds nobody"},
      {"t_s,agent_id,x_m\n", "crowd.csv:1: the column y_m is missing"},
      {"0,1,2,3\n", "crowd.csv:1: the column t_s is missing"},
      {kHeader + "0,1,2\n", "crowd.csv:2: has 3 values, but the first line names 4 columns"},
      {kHeader + "0,1,nan,3\n", "crowd.csv:2: x_m = nan must lie in [-1e+05, 1e+05] m"},
      {kHeader + "inf,1,2,3\n", "crowd.csv:2: t_s = inf must lie in"},
      {kHeader + "0,1,2,1e99\n", "crowd.csv:2: y_m = 1e99 must lie in"},
      {kHeader + "0,1,2,1e999\n", "crowd.csv:2: y_m = 1e999 must lie in"},
      {kHeader + "0,1,,3\n", "crowd.csv:2: x_m =  must be a number in m"},
      {kHeader + "0,1.5,2,3\n", "crowd.csv:2: agent_id = 1.5 must be a whole number"},
      {kHeader + "0,-1,2,3\n", "crowd.csv:2: agent_id = -1 must be a whole number in [0, 9007199254740992]"},
      {kHeader + "0,1,2,3\n0,2,2,3\n0,1,2,3\n",
       "crowd.csv:4: agent_id = 1 stands twice at t_s = 0 (first in line 2)"},
      {kHeader + "0,1,2,3\n0.4,1,27,3\n",
       "crowd.csv:3: agent_id = 1 moves 25 m in 0.4 s: must be at most 15"}};
  for (const Bad& bad : table) EXPECT_THAT(problems_of(bad.text), HasSubstr(bad.expected)) << bad.text;
}

TEST(CrowdFile, TellsAllProblemsUpToALimit) {
  std::string text = kHeader;
  for (int k = 0; k < 1000; ++k) text += "x,1,2,3\n";
  EXPECT_THAT(problems_of(text), HasSubstr("crowd.csv:101: t_s"));
}

TEST(CrowdFile, WritesWhatItReads) {
  sim::CrowdGeneratorParameters parameters;
  parameters.duration = 10.0;
  const std::vector<sim::CrowdSample> samples = sim::generate_crowd(parameters, 3);
  InputProblems problems;
  const auto crowd = crowd_from_text(crowd_text(samples), "crowd.csv", problems);
  ASSERT_TRUE(crowd) << problems.to_text();
  ASSERT_EQ(crowd->samples().size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(crowd->samples()[i].id, samples[i].id);
    EXPECT_NEAR((crowd->samples()[i].position_world - samples[i].position_world).norm(), 0.0, 1e-4);
  }
}

std::string refusal_of_ped(const std::vector<Setting>& settings, const std::string& file = kPed) {
  try {
    static_cast<void>(read_run_configuration(file, settings));
  } catch (const InputError& error) {
    return error.what();
  }
  return "good";
}

TEST(PedScenario, NamesItsRecordingWherePathsBegin) {
  EXPECT_EQ(refusal_of_ped({}), "good");  // beside the scenario file, wherever the test runs
  EXPECT_EQ(refusal_of_ped({{"crowd=" + source_dir() + "/scenarios/crowds/plaza.csv"}}), "good");
  EXPECT_THAT(refusal_of_ped({{"crowd=crowds/plaza.csv"}}),
              HasSubstr("--set: crowd = crowds/plaza.csv is no file"));
  EXPECT_THAT(refusal_of_ped({{"crowd=" + source_dir()}}), HasSubstr("is not a regular file"));
  EXPECT_THROW(static_cast<void>(run_configuration_from_text("family: ped\n", "bare.yaml")), InputError);
}

TEST(PedScenario, KnowsItsNumberOfTrials) {
  const RunConfiguration config = read_run_configuration(kPed);
  ASSERT_EQ(trial_count(config), 51);
  EXPECT_EQ(trials_problem(config, 0, 51), "");
  EXPECT_THAT(trials_problem(config, 50, 2), HasSubstr("51 windows of 60 s: trials 0 to 50"));
  EXPECT_EQ(trial_count(default_run_configuration(SceneFamily{sim::Family::t2}, "orca")), std::nullopt);
}

TEST(PedScenario, IsRunAgainFromItsResolvedFile) {
  const RunConfiguration config = read_run_configuration(kPed);
  const std::string file = testing::TempDir() + "spf_ped_resolved.yaml";
  const RunConfiguration again = run_configuration_from_text(to_yaml_text(config), file);
  EXPECT_EQ(identity_text(again), identity_text(config));
  RunConfiguration other = config;
  std::vector<sim::CrowdSample> samples = config.recording->samples();
  samples.back().position_world.x() += 0.001;
  other.recording = std::make_shared<const sim::CrowdRecording>(samples);
  EXPECT_NE(identity_text(other), identity_text(config));
  other = config;
  other.crowd = "/elsewhere/plaza.csv";
  EXPECT_EQ(identity_text(other), identity_text(config));
}

/// The contract of names, and that crossings, not trials, are counted.
void expect_sound(const std::vector<TrialRecord>& records, int robots) {
  const ResultRow row = result_row(records);
  EXPECT_EQ(row.crossings, robots * static_cast<int>(records.size()));
  EXPECT_GE(row.crossings_ok, 4 * row.success);
  EXPECT_LE(row.crossings_ok, row.crossings);
  EXPECT_GT(row.robot_minutes, 0.0);
  EXPECT_LE(row.robot_minutes, row.sim_seconds / 60.0 * robots + 1e-9);
  const std::string json = to_json_line(row);
  for (const char* key :
       {"crossings", "crossings_ok", "contacts_moving", "hits_while_standing", "robot_minutes"}) {
    EXPECT_THAT(json, HasSubstr("\"" + std::string{key} + "\":"));
    EXPECT_THAT(csv_header(), HasSubstr(key));
  }
  for (const TrialRecord& record : records) {
    const TrialRecord read = trial_record_from_json(to_json_line(record), "trials.jsonl", 1);
    ASSERT_TRUE(read.crossing);
    EXPECT_EQ(read.crossing->crossings_ok, record.crossing->crossings_ok);
    EXPECT_EQ(read.crossing->contacts_moving, record.crossing->contacts_moving);
    EXPECT_EQ(read.crossing->robot_minutes, record.crossing->robot_minutes);
  }
}

TEST(PedScenario, CountsCrossings) {
  expect_sound(run_configuration(read_run_configuration(kPed), 0, 2), 4);
  // Another family writes none of it.
  RunConfiguration config = read_run_configuration(source_dir() + "/scenarios/swap.yaml");
  config.layout.robots = 2;
  EXPECT_EQ(to_json_line(result_row(run_configuration(config, 0, 1))).find("crossings"), std::string::npos);
}

TEST(PedScenario, RunsOnRecordings) {
  const char* data = std::getenv("SPF_DATA_DIR");
  if (data == nullptr)
    GTEST_SKIP() << "SPF_DATA_DIR is not set: it is the folder that holds pedestrians/*.csv";
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator{std::filesystem::path{data} / "pedestrians"}) {
    if (entry.path().extension() != ".csv") continue;
    SCOPED_TRACE(entry.path());
    const RunConfiguration config = read_run_configuration(kPed, {{"crowd=" + entry.path().string()}});
    expect_sound(run_configuration(config, trial_count(config).value() - 1, 1), 4);
    ++seen;
  }
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace spf
