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
}

TEST_F(TrialLogTest, RefusesABadLineInTheMiddle) {
  write(line(0) + "{}\n" + line(1));
  EXPECT_THAT([&] { static_cast<void>(read_trial_log(path_)); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr(path_.string() + ":2: is no line")));
}

TEST_F(TrialLogTest, HasNothingWithoutAFile) {
  const TrialLog log = read_trial_log(path_);
  EXPECT_TRUE(log.records.empty());
  EXPECT_EQ(log.good_bytes, 0u);
  EXPECT_FALSE(log.torn);
}

}  // namespace
}  // namespace spf
