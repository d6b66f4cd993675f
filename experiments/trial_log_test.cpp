#include "experiments/trial_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "config/input_problem.hpp"

namespace spf {
namespace {

class TrialLogTest : public testing::Test {
 protected:
  ~TrialLogTest() override { std::filesystem::remove(path_); }
  void write(const std::string& text) const { std::ofstream{path_, std::ios::binary} << text; }

  static std::string line(int number) {
    TrialRecord record;
    record.key = {"t2", "orca", "walk", 1.0, "full", 7, number, "calm"};
    record.outcome = sim::TrialOutcome::collision;
    record.failure = "robot 1 touched disc 3";
    record.setup = "00ff";
    record.cause = CauseRecord{1, "unsafe", 0.25, "moving", 3};
    record.wheel_share = 0.75;
    record.new_plan_time.add(1e-3);
    record.robots.resize(2);
    record.digest = "0123456789abcdef";
    return to_json_line(record) + "\n";
  }

  std::filesystem::path path_ = std::filesystem::path{testing::TempDir()} /
                                ("spf_log_" + std::to_string(::getpid()) + "_" +
                                 testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(TrialLogTest, ReadsWhatWasWritten) {
  write(line(0) + line(1));
  const TrialLog log = read_trial_log(path_);
  ASSERT_EQ(log.records.size(), 2u);
  EXPECT_EQ(to_json_line(log.records[1]) + "\n", line(1));
  EXPECT_EQ(log.good_bytes, line(0).size() + line(1).size());
  EXPECT_FALSE(log.torn);
}

TEST_F(TrialLogTest, LeavesOutATornLastLineWhereverItWasCut) {
  const std::string whole = line(0), second = line(1);
  for (std::size_t cut = 1; cut < second.size(); ++cut) {
    write(whole + second.substr(0, cut));
    const TrialLog log = read_trial_log(path_);
    ASSERT_EQ(log.records.size(), 1u) << cut;
    EXPECT_EQ(log.good_bytes, whole.size());
    EXPECT_TRUE(log.torn);
  }
  write(whole + std::string(40, '\0') + "\n");  // as a crashed machine may leave it
  EXPECT_TRUE(read_trial_log(path_).torn);
  write(whole + second.substr(0, second.size() - 1) + std::string(40, '\0'));
  EXPECT_TRUE(read_trial_log(path_).torn);
}

TEST_F(TrialLogTest, RefusesAForeignLastLine) {
  const std::string second = line(1);
  const std::string half = second.substr(0, second.find(",\"contacts\""));
  for (const std::string& foreign :
       {std::string{"{}"}, std::string{"rows of something else"}, std::string{"{\"family\": 3}"}, half + "\n",
        half + "} ", std::string{"\n"}, second.substr(1), std::string{"[1]\n"},
        half + std::string(9, '\0') + "x"}) {
    write(line(0) + foreign);
    EXPECT_THAT([&] { static_cast<void>(read_trial_log(path_)); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr(path_.string() + ":2: is no line")))
        << foreign;
  }
}

TEST_F(TrialLogTest, NamesEveryLineThatItRefuses) {
  std::string bad = line(5);
  bad.replace(bad.find("\"collision\""), 11, "\"banana\"");
  write(line(0) + "{}\n" + line(1) + bad);
  const auto read = [&] { static_cast<void>(read_trial_log(path_)); };
  EXPECT_THAT(read,
              testing::ThrowsMessage<InputError>(testing::HasSubstr(path_.string() + ":2: is no line")));
  EXPECT_THAT(read, testing::ThrowsMessage<InputError>(testing::HasSubstr(
                        ":4: is no line of trial results: outcome = \"banana\" must be one of success, ")));
  std::string many;
  for (int i = 0; i < 1000; ++i) many += bad;
  write(many);
  EXPECT_THAT(read, testing::ThrowsMessage<InputError>(testing::HasSubstr("(and 900 more)")));
}

TEST_F(TrialLogTest, RefusesALineWithoutEnd) {
  write(line(0) + std::string(17u << 20, '['));
  EXPECT_THAT(
      [&] { static_cast<void>(read_trial_log(path_)); },
      testing::ThrowsMessage<InputError>(testing::HasSubstr(":2: is no line of trial results: is longer")));
}

TEST_F(TrialLogTest, HasNothingWithoutAFile) {
  const TrialLog log = read_trial_log(path_);
  EXPECT_TRUE(log.records.empty());
  EXPECT_EQ(log.good_bytes, 0u);
  EXPECT_FALSE(log.torn);
}

}  // namespace
}  // namespace spf
