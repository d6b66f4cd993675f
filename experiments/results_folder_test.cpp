#include "experiments/results_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace spf {
namespace {

class ResultsFolderTest : public testing::Test {
 protected:
  ResultsFolderTest() {
    std::filesystem::remove_all(base_);
    std::filesystem::create_directories(base_);
  }
  ~ResultsFolderTest() override { std::filesystem::remove_all(base_); }

  [[nodiscard]] std::size_t files_in(const std::filesystem::path& folder) const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator{folder}, std::filesystem::directory_iterator{}));
  }

  std::filesystem::path base_ = std::filesystem::path{testing::TempDir()} /
                                ("spf_results_" + std::to_string(::getpid()) + "_" +
                                 testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(ResultsFolderTest, WritesWholeFilesAndLeavesNothingElse) {
  write_file_atomically(base_ / "a.txt", "first");
  write_file_atomically(base_ / "a.txt", "second");
  EXPECT_EQ(text_of_file(base_ / "a.txt"), "second");
  EXPECT_EQ(files_in(base_), 1u);
}

TEST_F(ResultsFolderTest, NamesTheFileThatCannotBeWritten) {
  std::filesystem::create_directories(base_ / "folder");
  const std::vector<std::filesystem::path> bad{base_ / "missing" / "a.txt", base_ / "folder"};
  for (const std::filesystem::path& path : bad) {
    EXPECT_THAT([&] { write_file_atomically(path, "x"); },
                testing::ThrowsMessage<OutputError>(testing::StartsWith(path.string() + ":")));
    EXPECT_THROW(require_writable(path), OutputError);
  }
  EXPECT_EQ(files_in(base_), 1u);  // no temporary file stays behind
}

// /dev/full answers every write with "no space left".
TEST_F(ResultsFolderTest, ReportsAFullDisk) {
  EXPECT_THAT([] { write_file_atomically("/dev/full", "x"); },
              testing::ThrowsMessage<OutputError>(testing::HasSubstr("No space left")));
}

TEST_F(ResultsFolderTest, LinesGrowAFile) {
  LineFile lines{base_ / "trials.jsonl"};
  lines.append("one");
  EXPECT_EQ(text_of_file(base_ / "trials.jsonl"), "one\n");  // on the disk at once
  lines.append("two");
  EXPECT_EQ(text_of_file(base_ / "trials.jsonl"), "one\ntwo\n");
}

TEST_F(ResultsFolderTest, LinesHaveOneWriter) {
  LineFile lines{base_ / "trials.jsonl"};
  EXPECT_EQ(lines.append("one"), 0u);
  EXPECT_EQ(lines.append("two"), 4u);
  EXPECT_THAT([&] { LineFile{base_ / "trials.jsonl"}; },
              testing::ThrowsMessage<OutputError>(testing::HasSubstr("is being written by another run")));
  lines.cut(4);
  EXPECT_EQ(lines.append("three"), 4u);
  EXPECT_EQ(text_of_file(base_ / "trials.jsonl"), "one\nthree\n");
}

TEST_F(ResultsFolderTest, WritesPieceByPiece) {
  int piece = 0;
  write_file_atomically(base_ / "a.txt", [&] { return ++piece < 4 ? std::to_string(piece) : std::string{}; });
  EXPECT_EQ(text_of_file(base_ / "a.txt"), "123");
  const auto fails = []() -> std::string { throw OutputError{"no more"}; };
  EXPECT_THROW(write_file_atomically(base_ / "a.txt", fails), OutputError);
  EXPECT_EQ(text_of_file(base_ / "a.txt"), "123");
  EXPECT_EQ(files_in(base_), 1u);
}

TEST_F(ResultsFolderTest, ClearsOnlyWhatThisProgramMade) {
  for (const char* name : {"run.json", "summary.csv", "replay.html", "replay_trial_12.html"})
    std::ofstream{base_ / name} << "old";
  for (const char* name : {"notes.txt", "replay_trial_.html", "replay_trial_x.html"})
    std::ofstream{base_ / name} << "mine";
  ResultsFolder{base_}.remove_earlier_results();
  EXPECT_EQ(files_in(base_), 3u);
  EXPECT_TRUE(std::filesystem::exists(base_ / "notes.txt"));
}

TEST_F(ResultsFolderTest, MakesFoldersAndRefusesFiles) {
  const ResultsFolder folder{base_ / "a" / "b"};
  folder.write("scenario.yaml", "family: t2\n");
  EXPECT_EQ(text_of_file(base_ / "a" / "b" / "scenario.yaml"), "family: t2\n");
  std::ofstream{base_ / "file"} << "x";
  EXPECT_THROW(ResultsFolder{base_ / "file"}, OutputError);
  EXPECT_THROW(ResultsFolder{base_ / "file" / "below"}, OutputError);
}

}  // namespace
}  // namespace spf
