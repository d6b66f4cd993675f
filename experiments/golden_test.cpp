// The golden file: what every method did on trials 0, 1, ... of every family, down to the bits of the
// positions. A change that is not meant to change behaviour leaves it untouched; docs/architecture.md says
// how it is renewed.
#include <gtest/gtest.h>

#if defined(__GLIBC__)
#include <gnu/libc-version.h>
#endif

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/run_configuration_test.hpp"
#include "parallel/worker_pool.hpp"
#include "report/table.hpp"
#include "sim/families.hpp"
#include "spf/team/method_table.hpp"
#include "spf/testing/source_dir.hpp"
#include "study/scenario_file.hpp"

namespace spf {
namespace {

const std::string kFile = source_dir() + "/experiments/test_data/golden.txt";

/// One family and method; its trials in one line.
struct GoldenRow {
  std::string family;
  std::string method;
  std::string outcomes;  ///< a letter for each trial from 0: s(uccess), c(ollision), o(vertime)
  std::string
      time_ratio;  ///< [1] mean over all robots that arrived, of travel time to the obstacle-free; - = none
  std::string digest;  ///< of the digests of the trials

  [[nodiscard]] std::string name() const { return family + " " + method; }
  [[nodiscard]] std::string facts() const { return outcomes + " " + time_ratio; }
  [[nodiscard]] std::string text() const { return name() + " " + facts() + " " + digest; }
};

struct Golden {
  std::string platform;
  std::map<std::string, GoldenRow> rows;  ///< by name
};

/// What decides the last bits of sines and exponentials: the C library, and whether it may fuse products and
/// sums.
std::string platform() {
  std::string text = "other C library";
#if defined(__GLIBC__)
  text = std::string{"glibc "} + gnu_get_libc_version();
#endif
#if defined(__x86_64__)
  text += __builtin_cpu_supports("fma") ? ", x86_64 with FMA" : ", x86_64 without FMA";
#else
  text += ", not x86_64";
#endif
  return text;
}

constexpr const char* kPlatformKey = "platform: ";

Golden read_golden(std::istream& file) {
  Golden golden;
  std::string line;
  while (std::getline(file, line)) {
    if (line.rfind(kPlatformKey, 0) == 0) golden.platform = line.substr(std::string{kPlatformKey}.size());
    std::istringstream words{line};
    GoldenRow row;
    if (line.empty() || line[0] == '#' || line.rfind(kPlatformKey, 0) == 0) continue;
    if (words >> row.family >> row.method >> row.outcomes >> row.time_ratio >> row.digest)
      golden.rows[row.name()] = row;
    else
      ADD_FAILURE() << "not a row: " << line;
  }
  return golden;
}

int successes(const GoldenRow& row) {
  return static_cast<int>(std::count(row.outcomes.begin(), row.outcomes.end(), 's'));
}

/// Where sines differ in their last bit, a trial is another draw of the same experiment from some near miss
/// on. Of n trials 0.2 n (at least one) may then change sides, and the mean time ratio by a tenth. With the
/// other sines of the same C library (GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4) 42 of 56 digests
/// change, 6 of 312 outcomes, one success of a row at most, and 3 % of a time ratio.
bool alike(const GoldenRow& before, const GoldenRow& after) {
  if (before.outcomes.size() != after.outcomes.size()) return false;
  const int tolerance = std::max(1, static_cast<int>(before.outcomes.size()) / 5);
  if (std::abs(successes(before) - successes(after)) > tolerance) return false;
  if (before.time_ratio == "-" || after.time_ratio == "-") return true;
  const double ratio = std::stod(after.time_ratio) / std::stod(before.time_ratio);
  return ratio > 0.9 && ratio < 1.1;
}

/// Why a row is not as recorded, empty when it is.
std::string difference(const Golden& golden, const GoldenRow& row, const std::string& where) {
  const auto recorded = golden.rows.find(row.name());
  if (recorded == golden.rows.end()) return row.name() + ": no such row; now " + row.facts();
  const GoldenRow& before = recorded->second;
  if (golden.platform == where ? before.text() == row.text() : alike(before, row)) return "";
  return row.name() + ": " + before.facts() + " -> " + row.facts() +
         (before.facts() == row.facts() ? " (other positions alone)" : "");
}

GoldenRow row_of(const std::vector<TrialRecord>& records) {
  GoldenRow row{records.front().key.family, records.front().key.method, "", "-", ""};
  std::uint64_t digest = 14695981039346656037U;  // FNV-1a
  double sum = 0.0;
  int arrived = 0;
  for (const TrialRecord& record : records) {
    row.outcomes += *enum_name(record.outcome);
    for (const char letter : record.digest)
      digest = (digest ^ static_cast<unsigned char>(letter)) * 1099511628211U;
    for (const RobotRecord& robot : record.robots) {
      if (!robot.arrived) continue;
      sum += robot.travel_time_ratio;
      ++arrived;
    }
  }
  if (arrived > 0) row.time_ratio = fixed(sum / arrived, 4);
  std::ostringstream digits;
  digits << std::hex << std::setfill('0') << std::setw(16) << digest;
  row.digest = digits.str();
  return row;
}

constexpr int kTrials = 10;  // of every family and method

/// A family's scenes, full loop. Costly ones have fewer robots.
struct GoldenScenes {
  const char* family;
  std::vector<Setting> settings;
};

const std::vector<GoldenScenes>& all_scenes() {
  static const std::vector<GoldenScenes> scenes{{"t2", {}},
                                                {"t2_hard", {}},
                                                {"f7", {{"robots=4"}}},
                                                {"p8", {}},
                                                {"swap", {}},
                                                {"field", {{"robots=5"}}},
                                                {"ped", {}},
                                                {"clutter", {{"trial.time_limit=30"}}},
                                                {"doors", {{"trial.time_limit=30"}}},
                                                {"corridor", {{"trial.time_limit=40"}}}};
  return scenes;
}

void PrintTo(const GoldenScenes& scenes, std::ostream* out) {
  *out << scenes.family;
}

class GoldenSlow : public testing::TestWithParam<GoldenScenes> {
 protected:
  static const char* renewed_file() { return std::getenv("SPF_GOLDEN_OUT"); }

  /// All rows of the program's run, where a file was asked for.
  static void TearDownTestSuite() {
    if (renewed_file() == nullptr) return;
    std::ofstream file{renewed_file()};
    file << "# What every method does on every family (experiments/golden_test.cpp): family, method, outcome "
            "of trials 0, 1, ...\n"
            "# (s success, c collision, o overtime), mean ratio of travel time to the obstacle-free, digest "
            "of all positions.\n"
            "# Written by script/golden --renew, in a commit of its own that says why "
            "(docs/architecture.md).\n"
         << kPlatformKey << platform() << "\n";
    for (const GoldenRow& row : rows_) file << row.text() << "\n";
  }

  static inline std::vector<GoldenRow> rows_;
};

TEST_P(GoldenSlow, BehaviourIsAsRecorded) {
  std::ifstream file{kFile};
  const Golden golden = read_golden(file);
  std::string differences;
  const MethodTable methods;
  for (const Method& method : methods.all()) {
    std::vector<Setting> settings = GetParam().settings;
    settings.push_back({"method=" + method.name});
    const RunConfiguration config =
        read_run_configuration(source_dir() + "/scenarios/" + GetParam().family + ".yaml", settings);
    CampaignRequest request;
    request.jobs = thread_count(renewed_file() != nullptr ? 0 : 1);
    const GoldenRow row = row_of(run_configuration(config, 0, kTrials, request));
    rows_.push_back(row);
    const std::string changed = difference(golden, row, platform());
    if (!changed.empty()) differences += changed + "\n";
  }
  if (renewed_file() != nullptr) {
    std::cout << differences;
    return;
  }
  EXPECT_EQ(differences, "") << "recorded on " << golden.platform << ", now on " << platform()
                             << "; meant? script/golden --renew";
}

INSTANTIATE_TEST_SUITE_P(All, GoldenSlow, testing::ValuesIn(all_scenes()),
                         [](const auto& scenes) { return std::string{scenes.param.family}; });

// What is compared is what is recorded: a row that is no longer run would never be missed.
TEST(Golden, RecordsTenTrialsOfEveryFamilyAndMethodAndNothingElse) {
  std::set<std::string> run;
  std::set<std::string> families;
  const MethodTable methods;
  for (const GoldenScenes& scenes : all_scenes()) {
    families.insert(scenes.family);
    for (const Method& method : methods.all()) run.insert(std::string{scenes.family} + " " + method.name);
  }
  std::set<std::string> wanted_families;
  for (const auto& [family, name] : EnumNames<sim::Family>::values) wanted_families.insert(name);
  EXPECT_EQ(families, wanted_families);

  std::ifstream file{kFile};
  std::set<std::string> recorded;
  for (const auto& [name, row] : read_golden(file).rows) {
    recorded.insert(name);
    EXPECT_EQ(row.outcomes.size(), static_cast<std::size_t>(kTrials)) << name;
  }
  EXPECT_EQ(recorded, run);
}

Golden one_row(const std::string& outcomes, const std::string& ratio) {
  std::istringstream file{"# head\nplatform: here\nt2 orca " + outcomes + " " + ratio + " abc\n"};
  return read_golden(file);
}

TEST(Golden, OnTheSamePlatformEveryBitCounts) {
  const Golden golden = one_row("sssssssscc", "1.0500");
  EXPECT_EQ(difference(golden, {"t2", "orca", "sssssssscc", "1.0500", "abc"}, "here"), "");
  EXPECT_EQ(difference(golden, {"t2", "orca", "sssssssscc", "1.0500", "abd"}, "here"),
            "t2 orca: sssssssscc 1.0500 -> sssssssscc 1.0500 (other positions alone)");
  EXPECT_EQ(difference(golden, {"t2", "orca", "sssssssccc", "1.0600", "abd"}, "here"),
            "t2 orca: sssssssscc 1.0500 -> sssssssccc 1.0600");
  EXPECT_NE(difference(golden, {"t2", "es2", "sssssssscc", "1.0500", "abc"}, "here"), "");
}

TEST(Golden, ElsewhereOutcomesAndTimesCountWithinTheirTolerance) {
  const Golden golden = one_row("sssssssscc", "1.0500");
  EXPECT_EQ(difference(golden, {"t2", "orca", "ccssssssco", "1.0900", "abd"}, "there"), "");
  EXPECT_NE(difference(golden, {"t2", "orca", "ccccsssssc", "1.0500", "abd"}, "there"), "");
  EXPECT_NE(difference(golden, {"t2", "orca", "sssssssscc", "1.1600", "abd"}, "there"), "");
  EXPECT_NE(difference(golden, {"t2", "orca", "ssssssssc", "1.0500", "abd"}, "there"), "");
}

}  // namespace
}  // namespace spf
