// The program as people and scripts meet it: exit statuses, messages, files.
#include "apps/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace spf {
namespace {

TEST_F(Program, ExplainsItself) {
  for (const char* arguments : {"--help", "run --help", "experiment --help", "report --help", "check --help",
                                "parameters --help", "crowd --help"}) {
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.status, 0) << arguments;
    EXPECT_THAT(finished.out, HasSubstr("Examples:")) << arguments;
    EXPECT_EQ(finished.error, "") << arguments;
  }
  const Finished version = run("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, StartsWith("spf 0."));
  EXPECT_THAT(version.out, HasSubstr("commit "));
}

TEST_F(Program, RefusesBadUsage) {
  for (const char* arguments :
       {"", "fly", "run", "run good.yaml --fly", "run good.yaml --trials 0", "run good.yaml --trials 2.5",
        "run good.yaml --jobs -1", "run good.yaml --first x", "run good.yaml --out", "run good.yaml extra",
        "check", "parameters --markdown --json", "run good.yaml --seed",
        "run good.yaml --trials 1 --trials 2", "run good.yaml --trials 2 --mcap a.mcap",
        "run good.yaml --mcap nowhere/a.mcap"}) {
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.status, 2) << arguments;
    EXPECT_NE(finished.error, "") << arguments;
    EXPECT_EQ(finished.out, "") << arguments;
  }
}

struct BadFile {
  std::string text;
  std::string expected;  ///< part of the report
};

TEST_F(Program, RefusesBadFilesWithFileLineAndKey) {
  const std::string good = kGood;
  const std::vector<BadFile> table{
      {"", "bad.yaml: is empty"},
      {"family", "bad.yaml:1:1: must be a map"},
      {good + "method: [", "bad.yaml:5:1: is not YAML"},
      {good + "seed: 1.5\n", "bad.yaml:5:7: seed = 1.5 must be a whole number"},
      {good + "seed: -1\n", "bad.yaml:5:7: seed = -1 must be a whole number"},
      {good + "robot: {radius: .nan}\n", "bad.yaml:5:17: robot.radius = .nan must be a number in m, not NaN"},
      {good + "robot: {radius: -0.3}\n", "bad.yaml:5:17: robot.radius = -0.3 must lie in [0.01, 5] m"},
      {good + "robot: {radius: 30 cm}\n",
       "bad.yaml:5:17: robot.radius = 30 cm must be a number in m, written without"},
      {good + "robot: {radios: 0.3}\n",
       "bad.yaml:5:9: robot.radios = 0.3 is not a known key; did you mean robot.radius?"},
      {good + "family: t2\n", "bad.yaml:5:1: key family stands twice (first in line 1)"},
      {good + "boxes: [{low: [-1, -1], high: [1, 1]}]\n",
       "bad.yaml:2:18: robots[0].start = [0, 0] is 0 m from boxes[0]"},
      {good + "a: &a [*a]\n", "bad.yaml:5:"},
      {std::string(3000, '['), "bad.yaml:1:"},
      {"\xff\xfe", "bad.yaml:1:1: byte 0xff is not UTF-8"}};
  for (const BadFile& bad : table) {
    write("bad.yaml", bad.text);
    for (const char* verb : {"check bad.yaml", "run bad.yaml --out results --json row.jsonl"}) {
      const Finished finished = run(verb);
      EXPECT_EQ(finished.status, 2) << bad.text;
      EXPECT_THAT(finished.error, HasSubstr(bad.expected));
      EXPECT_EQ(finished.out, "");
      EXPECT_FALSE(fs::exists(folder_ / "results"));
      EXPECT_FALSE(fs::exists(folder_ / "row.jsonl"));
    }
  }
  EXPECT_THAT(run("run missing.yaml").error, HasSubstr("missing.yaml: no such file"));
  EXPECT_THAT(run("run .").error, HasSubstr(".: is a directory"));
  EXPECT_EQ(run("run .").status, 2);
}

TEST_F(Program, ReportsAllProblemsAtOnce) {
  write("bad.yaml",
        "family: explicit\nrobots: [{start: [0, 0], goal: [2, 0]}, {start: [0.1, 0], goal: [5, 5]}]\n"
        "seed: x\nsensing: {beams: 2, ranje: 1}\n");
  const Finished finished = run("check bad.yaml --level -1 --set radio.loss=2 --method magic");
  EXPECT_EQ(finished.status, 2);
  for (const char* expected :
       {"bad.yaml:2:", "robots[1].start = [0.1, 0]", "bad.yaml:3:7: seed = x",
        "bad.yaml:4:18: sensing.beams = 2", "did you mean sensing.range?", "--level: noise.level = -1",
        "--set: radio.loss = 2", "--method: method = magic must be one of"})
    EXPECT_THAT(finished.error, HasSubstr(expected));
}

TEST_F(Program, ChecksScenarios) {
  const Finished good = run("check good.yaml '" + kSource + "/scenarios/f7.yaml'");
  EXPECT_EQ(good.status, 0) << good.error;
  EXPECT_THAT(good.out, HasSubstr("good.yaml: good"));
  EXPECT_THAT(good.out, HasSubstr("12 robots"));
  write("bad.yaml", "family: none");
  const Finished mixed = run("check bad.yaml good.yaml");
  EXPECT_EQ(mixed.status, 2);
  EXPECT_THAT(mixed.out, HasSubstr("good.yaml: good"));
  EXPECT_THAT(mixed.error, HasSubstr("bad.yaml:1:9: family = none"));
}

// Settings that contradict each other, but may be meant, are told once and change no exit status.
TEST_F(Program, WarnsOfSettingsThatContradictEachOther) {
  write("wide.yaml", std::string{kGood} + "robot:\n  wheel_arm: 0.31\n");
  const std::string warning =
      "wide.yaml:6:14: warning: robot.wheel_arm = 0.31 m is longer than robot.radius = 0.3 m: the wheels "
      "stand out of the disc that is kept free\n";
  const Finished checked = run("check wide.yaml");
  EXPECT_EQ(checked.status, 0);
  EXPECT_THAT(checked.out, StartsWith("wide.yaml: good, with 1 warning\n"));
  EXPECT_EQ(checked.error, warning);
  for (const char* verb : {"run wide.yaml --quiet", "run wide.yaml --trials 2 --quiet"}) {
    const Finished finished = run(verb);
    EXPECT_EQ(finished.status, 0) << verb;
    EXPECT_EQ(finished.error, warning) << verb;
  }
  write("two.yaml", "name: two\nscenarios: [wide.yaml]\nmethods: [orca, space_time]\ntrials: 1\n");
  const Finished campaign = run("experiment two.yaml --quiet");
  EXPECT_EQ(campaign.status, 0);
  EXPECT_THAT(campaign.error, HasSubstr("wide.yaml:6:14: warning: robot.wheel_arm = 0.31 m"));
  EXPECT_EQ(lines_of(folder_ / "stderr").size(), 1u);  // not once a cell

  write("wide.yaml", std::string{kGood} + "trial:\n  computing_delay: 0.4\n");
  for (const char* verb : {"check wide.yaml", "run wide.yaml"}) {
    const Finished refused = run(verb);
    EXPECT_EQ(refused.status, 2) << verb;
    EXPECT_THAT(refused.error, StartsWith("wide.yaml:6:20: trial.computing_delay = 0.4 s is longer than"));
  }
}

TEST_F(Program, RunsAScenarioAndKeepsItsResults) {
  const Finished finished = run("run good.yaml --out results/one --json row.jsonl");
  ASSERT_EQ(finished.status, 0) << finished.error << finished.out;
  EXPECT_THAT(finished.out, HasSubstr("success"));
  EXPECT_THAT(finished.out, HasSubstr("replay: results/one/replay.html"));
  const fs::path results = folder_ / "results" / "one";
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator{results})
    names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{"replay.html", "run.json", "scenario.yaml", "summary.csv",
                                          "summary.jsonl", "trials.jsonl"}));
  EXPECT_THAT(text_of(results / "replay.html"), StartsWith("<!"));
  const nlohmann::json row = nlohmann::json::parse(text_of(folder_ / "row.jsonl"));
  EXPECT_EQ(row.size(), 31u);
  EXPECT_EQ(row.at("family"), "explicit");
  EXPECT_EQ(row.at("success"), 1);
  EXPECT_EQ(text_of(results / "summary.jsonl"), text_of(folder_ / "row.jsonl"));
  const nlohmann::json facts = nlohmann::json::parse(text_of(results / "run.json"));
  EXPECT_EQ(facts.at("finished"), 1);
  EXPECT_FALSE(facts.at("commit").get<std::string>().empty());
  // The scenario as run gives the same trial again.
  ASSERT_EQ(run("run results/one/scenario.yaml --out results/two").status, 0);
  const auto digest = [](const fs::path& path) { return nlohmann::json::parse(text_of(path)).at("digest"); };
  EXPECT_EQ(digest(results / "trials.jsonl"), digest(folder_ / "results" / "two" / "trials.jsonl"));
}

TEST_F(Program, TellsASingleRunThatFailed) {
  const Finished single = run("run good.yaml --set trial.time_limit=0.5");
  EXPECT_EQ(single.status, 1) << single.error;
  EXPECT_THAT(single.out, HasSubstr("overtime"));
  EXPECT_THAT(single.out, HasSubstr("not arrived in time: robot 0"));
  const Finished many = run("run good.yaml --set trial.time_limit=0.5 --trials 3 --replays 2 --out results");
  EXPECT_EQ(many.status, 0) << many.error;
  EXPECT_TRUE(fs::exists(folder_ / "results" / "replay_trial_0.html"));
  EXPECT_TRUE(fs::exists(folder_ / "results" / "replay_trial_1.html"));
  EXPECT_FALSE(fs::exists(folder_ / "results" / "replay_trial_2.html"));
  EXPECT_EQ(lines_of(folder_ / "results" / "trials.jsonl").size(), 3u);
  EXPECT_EQ(many.error, "");  // above all: every replay went the way of its trial
}

TEST_F(Program, PrintsTheRowAloneWhenAsked) {
  const Finished finished =
      run("run good.yaml --trials 2 --first 5 --json - --quiet --seed 7 --noise walk --level 0.25 --tracking "
          "ideal");
  ASSERT_EQ(finished.status, 0) << finished.error;
  const nlohmann::json row = nlohmann::json::parse(finished.out);
  EXPECT_EQ(row.at("trials"), 2);
  EXPECT_EQ(row.at("seed"), 7);
  EXPECT_EQ(row.at("noise"), "walk");
  EXPECT_EQ(row.at("level"), 0.25);
  EXPECT_EQ(row.at("tracking"), "ideal");
}

TEST_F(Program, GivesTheSameRowsForAnyNumberOfJobs) {
  const std::string what =
      "run good.yaml --trials 6 --level 1 --noise walk --set sensing.detections=noisy --set "
      "pose_noise.position_sigma=0.01 ";
  ASSERT_EQ(run(what + "--jobs 1 --out a").status, 0);
  ASSERT_EQ(run(what + "--jobs 4 --out b").status, 0);
  const std::vector<std::string> a = lines_of(folder_ / "a" / "trials.jsonl"),
                                 b = lines_of(folder_ / "b" / "trials.jsonl");
  ASSERT_EQ(a.size(), 6u);
  ASSERT_EQ(b.size(), 6u);
  std::set<std::string> digests;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(without_timings(a[i]), without_timings(b[i]));
    digests.insert(nlohmann::json::parse(a[i]).at("digest").get<std::string>());
  }
  EXPECT_EQ(digests.size(), 6u);  // and the trials do differ from each other
}

TEST_F(Program, TellsWhatCannotBeWritten) {
  write("file", "x");
  for (const char* arguments :
       {"run good.yaml --out file", "run good.yaml --out file/below",
        "run good.yaml --json missing/row.jsonl", "run good.yaml --json .", "run good.yaml --json /dev/full",
        "parameters >/dev/full", "run good.yaml >/dev/full"}) {
    const std::string words = arguments;
    const std::size_t redirected = words.find('>');
    Finished finished;
    if (redirected == std::string::npos) {
      finished = run(words);
    } else {
      const fs::path error = folder_ / "stderr";
      const int status = std::system((command(words) + " 2>'" + error.string() + "'").c_str());
      finished = {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", text_of(error)};
    }
    EXPECT_EQ(finished.status, 2) << words;
    EXPECT_NE(finished.error, "") << words;
  }
  EXPECT_EQ(text_of(folder_ / "file"), "x");
}

TEST_F(Program, KeepsFinishedTrialsWhenInterrupted) {
  const fs::path trials = folder_ / "results" / "trials.jsonl";
  const pid_t child = ::fork();
  if (child == 0) {
    const int changed = ::chdir(folder_.c_str());
    const bool silenced = std::freopen("/dev/null", "w", stdout) != nullptr &&
                          std::freopen("/dev/null", "w", stderr) != nullptr;
    if (changed == 0 && silenced)
      ::execl(program_path().c_str(), program_path().c_str(), "run", "good.yaml", "--trials", "1000000",
              "--out", "results", nullptr);
    ::_exit(99);
  }
  ASSERT_GT(child, 0);
  // Wait for two trials; far longer than they ever take.
  for (int i = 0; i < 12000 && lines_of(trials).size() < 2; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds{10});
  // Meanwhile the folder is its own.
  const Finished second = run("run good.yaml --out results");
  EXPECT_EQ(second.status, 2);
  EXPECT_THAT(second.error, HasSubstr("is being written by another run"));
  ::kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  const std::vector<std::string> lines = lines_of(trials);
  ASSERT_GE(lines.size(), 2u);
  for (const std::string& line : lines) EXPECT_TRUE(nlohmann::json::accept(line));
  const nlohmann::json facts = nlohmann::json::parse(text_of(folder_ / "results" / "run.json"));
  EXPECT_EQ(facts.at("finished"), lines.size());
  EXPECT_EQ(facts.at("trials"), 1000000);
}

TEST_F(Program, ListsParameters) {
  const Finished table = run("parameters");
  EXPECT_EQ(table.status, 0);
  EXPECT_THAT(table.out, HasSubstr("agent.team.plan_period"));
  const Finished json = run("parameters --json");
  std::istringstream lines{json.out};
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const nlohmann::json row = nlohmann::json::parse(line);
    for (const char* name : {"key", "default", "unit", "range", "what"})
      EXPECT_TRUE(row.contains(name)) << line;
    EXPECT_FALSE(row.at("what").get<std::string>().empty()) << line;
  }
  EXPECT_GT(count, 100);
}

TEST_F(Program, ExplainsAScenario) {
  const Finished explained = run("parameters --explain good.yaml");
  ASSERT_EQ(explained.status, 0) << explained.error;
  write("explained.yaml", explained.out);
  EXPECT_EQ(run("parameters --explain explained.yaml").out, explained.out);
}

TEST_F(Program, ParameterPageIsUpToDate) {
  write("parameters.md", run("parameters --markdown").out);
  const std::vector<std::string> made = lines_of(folder_ / "parameters.md");
  const std::vector<std::string> kept = lines_of(kSource + "/docs/parameters.md");
  const auto [first_made, first_kept] = std::mismatch(made.begin(), made.end(), kept.begin(), kept.end());
  EXPECT_TRUE(first_made == made.end() && first_kept == kept.end())
      << "docs/parameters.md is old from line " << first_kept - kept.begin() + 1
      << " on; build the target spf_reference_files";
}

TEST_F(Program, MakesACrowdAndCrossesIt) {
  const Finished made = run("crowd --out crowd.csv --seed 3 --people 6 --duration 61");
  ASSERT_EQ(made.status, 0) << made.error;
  EXPECT_THAT(made.out, HasSubstr("crowd.csv: "));
  const std::string ped = "run '" + kSource + "/scenarios/ped.yaml' --set crowd=crowd.csv --quiet ";
  const Finished crossed = run(ped + "--trials 1 --json row.jsonl --out results");
  ASSERT_EQ(crossed.status, 0) << crossed.error;
  EXPECT_THAT(crossed.out, HasSubstr("contacts while moving"));
  const nlohmann::json row = nlohmann::json::parse(text_of(folder_ / "row.jsonl"));
  EXPECT_EQ(row.at("crossings"), 4);
  EXPECT_GT(row.at("robot_minutes"), 0.0);
  // The resolved scenario is run again from anywhere.
  EXPECT_EQ(run("run results/scenario.yaml --trials 1 --quiet").status, 0);
  const Finished beyond = run(ped + "--trials 2");
  EXPECT_EQ(beyond.status, 2);
  EXPECT_THAT(beyond.error, HasSubstr("has 1 window of 60 s: trials 0 to 0"));
  const Finished missing = run("run '" + kSource + "/scenarios/ped.yaml' --set crowd=nobody.csv");
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.error, HasSubstr("--set: crowd = nobody.csv is no file"));
  const Finished nobody = run("crowd --out crowd.csv --people 0");
  EXPECT_EQ(nobody.status, 2);
  EXPECT_THAT(nobody.error, HasSubstr("--people: 0 must lie in [0.1, 1000]"));
  const Finished slow = run("crowd --out crowd.csv --speed 0.1");
  EXPECT_THAT(slow.error, HasSubstr("--speed: 0.1 must lie in [0.2, 3] m/s"));
}

}  // namespace
}  // namespace spf
