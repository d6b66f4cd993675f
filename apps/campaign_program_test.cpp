// Campaigns as people and schedulers run them: killed, resumed, in parts, with bad files, on a full disk.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/program_test.hpp"

namespace spf {
namespace {

using Json = nlohmann::json;

constexpr const char* kScene =
    "family: explicit\n"
    "robots: [{start: [0, 0], goal: [4, 0]}, {start: [4, 1], goal: [0, 1]}]\n"
    "moving: [{position: [2, 4], velocity: [0.1, -0.6], radius: 0.3}]\n"
    "border: {low: [-3, -5], high: [8, 6]}\n"
    "noise: {model: walk, level: 1}\n"
    "pose_noise: {position_sigma: 0.01}\n";
constexpr const char* kCampaign =
    "name: small\n"
    "title: Two robots and a disc\n"
    "scenarios: [scene.yaml]\n"
    "methods: [orca, space_time]\n"
    "variants: [{name: orca_wide, method: orca, set: [agent.orca.margin=0.3]}]\n"
    "conditions: [{name: as it is}, {name: hopeless, set: [trial.time_limit=1], methods: [orca_wide]}]\n"
    "levels: [0, 1]\n"
    "trials: 6\n";

class CampaignProgram : public Program {
 protected:
  CampaignProgram() {
    write("scene.yaml", kScene);
    write("small.yaml", kCampaign);
  }
  [[nodiscard]] std::vector<Json> trials_in(const std::string& folder) const {
    std::vector<Json> trials;
    for (const std::string& line : lines_of(folder_ / folder / "trials.jsonl"))
      trials.push_back(without_timings(line));
    return trials;
  }
  [[nodiscard]] std::vector<Json> rows_in(const std::string& file) const {
    std::vector<Json> rows;
    for (const std::string& line : lines_of(folder_ / file)) rows.push_back(without_timings(line));
    return rows;
  }
  /// The whole campaign without interruption, run once for the suite: a copy of it lies in `whole`.
  void run_whole() const {
    if (!fs::exists(shared())) {
      const Finished finished = run("experiment small.yaml --jobs 1 --out whole --json whole.jsonl");
      ASSERT_EQ(finished.status, 0) << finished.error;
      fs::create_directories(shared());
      for (const char* made : {"whole", "whole.jsonl"})
        fs::copy(folder_ / made, shared() / made, fs::copy_options::recursive);
    } else {
      for (const char* made : {"whole", "whole.jsonl"})
        fs::copy(shared() / made, folder_ / made, fs::copy_options::recursive);
    }
    ASSERT_EQ(trials_in("whole").size(), 8u * 6u);
  }
  static void SetUpTestSuite() { fs::remove_all(shared()); }
  static void TearDownTestSuite() { fs::remove_all(shared()); }

 private:
  static fs::path shared() {
    return fs::path{testing::TempDir()} / ("spf_program_" + std::to_string(::getpid()) + "_whole");
  }
};

TEST_F(CampaignProgram, RunsEveryCellAndKeepsWhatMadeIt) {
  run_whole();
  for (const char* name : {"campaign.yaml", "run.json", "summary.csv", "summary.jsonl"})
    EXPECT_TRUE(fs::exists(folder_ / "whole" / name)) << name;
  const std::vector<Json> trials = trials_in("whole");
  int timeouts = 0;
  for (const Json& trial : trials) {
    if (trial.value("condition", "") != "hopeless") continue;
    ++timeouts;
    EXPECT_EQ(trial.at("outcome"), "overtime");  // nobody drives 4 m in 1 s
    EXPECT_EQ(trial.at("cause").at("stand_reason"), "moving");
  }
  EXPECT_EQ(timeouts, 2 * 6);
  // The scenario of a row, run by itself, is that row's trial.
  const Finished again = run("run whole/cells/scene_orca_walk_1_full_as-it-is_*.yaml --first 3 --out again");
  ASSERT_NE(again.status, 2) << again.error;
  bool found = false;
  for (const Json& trial : trials)
    if (trial.at("method") == "orca" && trial.at("level") == 1.0 && trial.at("trial") == 3) {
      EXPECT_EQ(trial.at("digest"), trials_in("again").at(0).at("digest"));
      found = true;
    }
  EXPECT_TRUE(found);
}

TEST_F(CampaignProgram, GivesTheSameRowsForMoreThreads) {
  run_whole();
  ASSERT_EQ(run("experiment small.yaml --jobs 4 --out many --json many.jsonl").status, 0);
  EXPECT_EQ(trials_in("many"), trials_in("whole"));
  EXPECT_EQ(rows_in("many.jsonl"), rows_in("whole.jsonl"));
}

TEST_F(CampaignProgram, MergesShardsIntoTheSameRows) {
  run_whole();
  std::size_t trials = 0;
  for (const char* part : {"1", "2", "3", "4", "5", "6", "7"}) {
    const std::string arguments =
        std::string{"experiment small.yaml --shard "} + part + "/7 --out parts/" + part;
    ASSERT_EQ(run(arguments).status, 0);
    trials += trials_in(std::string{"parts/"} + part).size();
  }
  EXPECT_EQ(trials, trials_in("whole").size());
  ASSERT_EQ(run("report parts/7 parts/1 parts/2 parts/3 parts/4 parts/5 parts/6 --json merged.jsonl").status,
            0);
  EXPECT_TRUE(fs::exists(folder_ / "parts" / "report.html"));
  ASSERT_EQ(run("report whole --json alone.jsonl").status, 0);
  EXPECT_EQ(rows_in("merged.jsonl"), rows_in("alone.jsonl"));
  EXPECT_EQ(rows_in("alone.jsonl"), rows_in("whole.jsonl"));
}

TEST_F(CampaignProgram, ResumesAfterSigkillWithTheSameRows) {
  run_whole();
  const std::string log = (folder_ / "killed" / "trials.jsonl").string();
  const pid_t child = ::fork();
  if (child == 0) {
    const bool ready = ::chdir(folder_.c_str()) == 0 && std::freopen("/dev/null", "w", stdout) != nullptr &&
                       std::freopen("/dev/null", "w", stderr) != nullptr;
    if (ready)
      ::execl(program_path().c_str(), program_path().c_str(), "experiment", "small.yaml", "--jobs", "2",
              "--trials", "20000", "--out", "killed", nullptr);
    ::_exit(99);
  }
  ASSERT_GT(child, 0);
  for (int i = 0; i < 12000 && lines_of(log).size() < 10; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds{5});
  ::kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  // A line that was cut off in writing.
  const std::string whole_line = lines_of(log).at(0);
  { std::ofstream{log, std::ios::app} << whole_line.substr(0, whole_line.size() / 2); }

  EXPECT_THAT(run("experiment small.yaml --out killed").error, HasSubstr("--resume"));
  const Finished resumed = run("experiment small.yaml --out killed --resume");
  ASSERT_EQ(resumed.status, 0) << resumed.error;
  EXPECT_THAT(resumed.error, HasSubstr("cut off"));
  std::vector<Json> kept;
  for (const Json& trial : trials_in("killed"))
    if (trial.at("trial") < 6) kept.push_back(trial);
  EXPECT_EQ(kept, trials_in("whole"));
}

TEST_F(CampaignProgram, TellsOfAFullDiskAndLosesNothing) {
  run_whole();
  // 512-byte blocks: room for some trials.
  const Finished full = run("--version >/dev/null; (trap '' XFSZ; ulimit -f 40; '" + program_path() +
                            "' experiment small.yaml --out full)");
  EXPECT_EQ(full.status, 2);
  EXPECT_THAT(full.error, HasSubstr("full/trials.jsonl: cannot be written"));
  EXPECT_THAT(full.error, HasSubstr("trials are kept"));
  const std::size_t kept = trials_in("full").size();  // all lines are whole
  EXPECT_GT(kept, 0u);
  EXPECT_LT(kept, trials_in("whole").size());
  ASSERT_EQ(run("experiment small.yaml --out full --resume").status, 0);
  EXPECT_EQ(trials_in("full"), trials_in("whole"));
}

TEST_F(CampaignProgram, GoesOnOnlyWithItsOwnTrials) {
  ASSERT_EQ(run("experiment small.yaml --trials 1 --out one").status, 0);
  const Finished other = run("experiment small.yaml --trials 2 --out one --resume --set sensing.range=5");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.error, HasSubstr("trials.jsonl:1: is a trial of scene, orca"));
  ASSERT_EQ(run("experiment small.yaml --trials 2 --out one --resume").status, 0);
  EXPECT_EQ(trials_in("one").size(), 2u * 8u);
  // Neither does a report mix them.
  ASSERT_EQ(run("experiment small.yaml --trials 1 --out other --set sensing.range=5").status, 0);
  const Finished mixed = run("report one other");
  EXPECT_EQ(mixed.status, 2);
  EXPECT_THAT(mixed.error, HasSubstr("other settings"));
  EXPECT_EQ(run("report nowhere").status, 2);
}

TEST_F(CampaignProgram, RefusesATrialThatIsToldTwiceInTwoWays) {
  ASSERT_EQ(run("experiment small.yaml --trials 1 --out one").status, 0);
  const fs::path log = folder_ / "one" / "trials.jsonl";
  const std::string whole = text_of(log), first = lines_of(log).front();
  // The same once more is no contradiction, for either.
  write("one/trials.jsonl", whole + first + "\n");
  EXPECT_EQ(run("report one --replays 0").status, 0);
  EXPECT_EQ(run("experiment small.yaml --trials 1 --out one --resume").status, 0);
  EXPECT_EQ(text_of(log), whole);
  Json other = Json::parse(first);
  other["digest"] = "0123456789abcdef";
  write("one/trials.jsonl", whole + other.dump() + "\n");
  for (const char* verb : {"report one --replays 0", "experiment small.yaml --trials 1 --out one --resume"}) {
    const Finished finished = run(verb);
    EXPECT_EQ(finished.status, 2) << verb;
    EXPECT_THAT(finished.error, HasSubstr("tells trial 0 of scene, orca")) << verb;
    EXPECT_THAT(finished.error, HasSubstr("otherwise than")) << verb;
  }
}

TEST_F(CampaignProgram, RefusesForeignLinesAndKeepsTheirFile) {
  ASSERT_EQ(run("experiment small.yaml --trials 1 --out one").status, 0);
  const std::string foreign = text_of(folder_ / "one" / "trials.jsonl") + "{\"another\": \"program's\"}\n";
  write("one/trials.jsonl", foreign);
  for (const char* verb : {"report one --replays 0", "experiment small.yaml --trials 1 --out one --resume"}) {
    const Finished finished = run(verb);
    EXPECT_EQ(finished.status, 2) << verb;
    EXPECT_THAT(finished.error, HasSubstr("trials.jsonl:9: is no line of trial results: family is missing"));
  }
  EXPECT_EQ(text_of(folder_ / "one" / "trials.jsonl"), foreign);
}

struct BadCampaign {
  std::string text;
  std::string expected;
};

TEST_F(CampaignProgram, LinksAsManyReplaysAsAskedForAndMakesEachOnce) {
  run_whole();
  const auto files = [&] {
    std::map<std::string, fs::file_time_type> times;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator{folder_ / "whole" / "report_replays", none})
      times[entry.path().filename().string()] = entry.last_write_time();
    return times;
  };
  ASSERT_EQ(run("report whole --replays 0").status, 0);
  EXPECT_TRUE(files().empty());
  ASSERT_EQ(run("report whole --replays 2").status, 0);
  const auto first = files();
  EXPECT_EQ(first.size(), 2u);
  ASSERT_EQ(run("report whole --replays all").status, 0);
  const auto all = files();
  EXPECT_EQ(all.size(), 12u);  // every failed trial
  for (const auto& [name, time] : first) EXPECT_EQ(all.at(name), time);
  EXPECT_EQ(text_of(folder_ / "whole" / "report.html").find("adds the others"), std::string::npos);
}

// A method may be compared on a campaign that does not name it, without a file of one's own.
TEST_F(CampaignProgram, IsJoinedByAMethodThatWasAskedFor) {
  ASSERT_EQ(run("experiment small.yaml --trials 1 --method es2,orca_wide --json rows.jsonl").status, 0);
  std::map<std::string, int> rows;
  for (const Json& row : rows_in("rows.jsonl"))
    if (row.contains("method")) ++rows[row.at("method")];
  EXPECT_EQ(rows, (std::map<std::string, int>{{"es2", 2}, {"orca_wide", 4}}));  // two levels; and `hopeless`
  ASSERT_EQ(run("experiment small.yaml --trials 1 --method es2 --out joined --quiet").status, 0);
  EXPECT_THAT(text_of(folder_ / "joined" / "campaign.yaml"),
              HasSubstr(R"(methods: ["orca", "space_time", "es2"])"));
  EXPECT_EQ(run("report joined --quiet").status, 0);
  EXPECT_THAT(run("experiment small.yaml --method spf_emcp").error,
              HasSubstr("spf_emcp is no method of this campaign; did you mean spf_empc?"));
}

// Results outlive the version that made them: what it can no longer read is told, and the rest is reported.
TEST_F(CampaignProgram, ReportsResultsWhoseScenarioCannotBeRead) {
  run_whole();
  int spoilt = 0;
  for (const auto& entry : fs::directory_iterator{folder_ / "whole" / "cells"}) {
    if (entry.path().filename().string().find("_walk_0_full_hopeless") == std::string::npos) continue;
    std::string text = text_of(entry.path());
    const std::size_t group = text.find("\n  space_time:\n");
    ASSERT_NE(group, std::string::npos) << entry.path();
    text.insert(text.find('\n', group + 1) + 1, "    sigma_floor: 0.03\n    peer_sigma: 0.02\n");
    std::ofstream{entry.path()} << text;
    ++spoilt;
  }
  ASSERT_EQ(spoilt, 1);
  const Finished report = run("report whole --replays all --quiet");
  EXPECT_EQ(report.status, 0);
  EXPECT_THAT(report.error, StartsWith("warning: no replays of scene, orca_wide, walk noise at 0 Sigma, full "
                                       "tracking, hopeless, whose scenario cannot be read: whole"));
  EXPECT_THAT(report.error, HasSubstr("agent.space_time.sigma_floor = 0.03 is no parameter any more"));
  EXPECT_THAT(report.error, HasSubstr(" (and 1 more)\n"));
  EXPECT_EQ(lines_of(folder_ / "stderr").size(), 1u);  // once, although six of its trials failed
  std::size_t replays = 0;
  for (const auto& entry : fs::directory_iterator{folder_ / "whole" / "report_replays"})
    replays += entry.path().extension() == ".html" ? 1 : 0;
  EXPECT_EQ(replays, 6u);  // of the other cell
}

/// The very lines of docs/campaigns.md, but for the campaign and the number of parts.
TEST_F(CampaignProgram, RunsUnderGnuParallelAsDocumented) {
  if (std::system("parallel --version 2>/dev/null | grep -q '^GNU parallel'") != 0) {
    ASSERT_EQ(std::getenv("SPF_REQUIRE_TOOLS"), nullptr)
        << "GNU parallel is not installed (Debian: parallel)";
    GTEST_SKIP() << "GNU parallel is not installed (Debian: parallel)";
  }
  run_whole();
  std::vector<std::string> documented;
  bool wanted = false;
  for (const std::string& line : lines_of(fs::path{kSource} / "docs" / "campaigns.md")) {
    if (line.starts_with("parallel ")) wanted = true;
    if (line == "```") wanted = false;
    if (wanted) documented.push_back(line);
  }
  ASSERT_EQ(documented.size(), 2u);
  std::string script = "set -e\n";
  for (std::string line : documented) {
    for (const auto& [from, to] :
         std::vector<std::pair<std::string, std::string>>{{"spf ", program_path() + " "},
                                                          {"table2 --trials 500", "small.yaml"},
                                                          {"{}/16", "{}/3"},
                                                          {"$(seq 16)", "$(seq 3)"}}) {
      const std::size_t at = line.find(from);
      if (at != std::string::npos) line.replace(at, from.size(), to);
    }
    script += line + (line.starts_with("parallel") ? "" : " --json merged.jsonl") + "\n";
  }
  write("parts.sh", script);
  for (int again = 0; again < 2; ++again) {  // the same line may be run again
    ASSERT_EQ(std::system(("cd '" + folder_.string() + "' && bash parts.sh >parts.log 2>&1").c_str()), 0)
        << text_of(folder_ / "parts.log");
    EXPECT_EQ(rows_in("merged.jsonl"), rows_in("whole.jsonl"));
  }
}

TEST_F(CampaignProgram, RefusesBadFilesWithPlaceAndHint) {
  const std::vector<BadCampaign> table{
      {"", "bad.yaml: is empty"},
      {"title: x\n", "name is missing"},
      {"name: a/b\nfamilies: [t2]\n", "bad.yaml:1:7: name = a/b must be letters"},
      {"name: a\n", "names no scene"},
      {"name: a\nfamilies: [t22]\n", "bad.yaml:2:12: families[0] = t22 must be one of"},
      {"name: a\nfamilies: t2\n", "bad.yaml:2:11: families = t2 must be a list"},
      {"name: a\nfamilies: [t2]\nmethod: [orca]\n", "did you mean methods?"},
      {"name: a\nfamilies: [t2]\nmethods: [spf_epmc]\n", "did you mean spf_empc?"},
      {"name: a\nfamilies: [t2]\nlevels: [1, -1]\n", "bad.yaml:3:13: levels[1] = -1 must lie in [0, 100]"},
      {"name: a\nfamilies: [t2]\nlevels: [1, 1]\n", "lists this cell twice"},
      {"name: a\nfamilies: [t2]\ntrials: 0\n", "bad.yaml:3:9: trials = 0 must lie in"},
      {"name: a\nfamilies: [t2]\nset: [sensing.rnge=3]\n",
       "bad.yaml:3:7: sensing.rnge = 3 is not a known key"},
      {"name: a\nfamilies: [t2]\nset: [sensing.range]\n",
       "bad.yaml:3:7: 'sensing.range' must read key=value"},
      {"name: a\nscenarios: [nowhere.yaml]\n", "nowhere.yaml"},
      {"name: a\nfamilies: [t2]\nvariants: [{name: b}]\n", "variants[0].method is missing"},
      {"name: a\nfamilies: [t2]\nmethods: [orca]\nvariants: [{name: orca, method: orca}]\n",
       "is the name of another method"},
      {"name: a\nfamilies: [t2]\nmethods: [orca]\nconditions: [{name: c, methods: [orka]}]\n",
       "bad.yaml:4:34: conditions[0].methods[0] = orka is no method or variant of this campaign; did you "
       "mean orca?"},
  };
  for (const BadCampaign& bad : table) {
    write("bad.yaml", bad.text);
    const Finished finished = run("experiment bad.yaml");
    EXPECT_EQ(finished.status, 2) << bad.text;
    EXPECT_THAT(finished.error, HasSubstr(bad.expected)) << bad.text;
    EXPECT_EQ(finished.out, "") << bad.text;
  }
}

TEST_F(CampaignProgram, RefusesBadUsage) {
  for (const char* arguments :
       {"experiment", "experiment tabel2", "experiment nowhere.yaml", "experiment small.yaml --shard 0/2",
        "experiment small.yaml --shard 3/2", "experiment small.yaml --shard x",
        "experiment small.yaml --resume", "experiment small.yaml --trials 0",
        "experiment small.yaml --method es9", "experiment small.yaml --level -1",
        "experiment small.yaml --jobs -1", "report", "report whole --replays x"}) {
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.status, 2) << arguments;
    EXPECT_NE(finished.error, "") << arguments;
    EXPECT_EQ(finished.out, "") << arguments;
  }
  EXPECT_THAT(run("experiment tabel2").error, HasSubstr("did you mean table2?"));
}

TEST_F(CampaignProgram, ReportsFailuresWithReplays) {
  run_whole();
  const Finished report = run("report whole --replays 2 --csv --markdown --charts charts");
  ASSERT_EQ(report.status, 0) << report.error;
  EXPECT_EQ(report.error, "");
  const std::string page = text_of(folder_ / "whole" / "report.html");
  for (const char* words :
       {"Two robots and a disc", "not arrived in time, moving", "McNemar", "spf run whole/cells/",
        "report_replays/small_", "<svg ", "2 of 12 failed trials have their replay here"})
    EXPECT_THAT(page, HasSubstr(words));
  EXPECT_EQ(page.find("http://"), std::string::npos);
  EXPECT_EQ(page.find("https://"), std::string::npos);
  int replays = 0;
  for (const auto& entry : fs::directory_iterator{folder_ / "whole" / "report_replays"}) {
    ++replays;
    EXPECT_THAT(page, HasSubstr(entry.path().filename().string()));
  }
  EXPECT_EQ(replays, 2);
  EXPECT_THAT(text_of(folder_ / "charts" / "small_success1.svg"), HasSubstr("http://www.w3.org/2000/svg"));
  EXPECT_EQ(lines_of(folder_ / "whole" / "report.csv").size(), 1u + 8u);
  EXPECT_THAT(text_of(folder_ / "whole" / "report.md"), HasSubstr("# Two robots and a disc"));
}

}  // namespace
}  // namespace spf
