#include "mcap/writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <stdexcept>

namespace spf::mcap {
namespace {

namespace fs = std::filesystem;

class File {
 public:
  [[nodiscard]] std::string path() const { return path_.string(); }
  [[nodiscard]] std::string bytes() const {
    std::ifstream file{path_, std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, {}};
  }
  ~File() { fs::remove(path_); }

 private:
  fs::path path_ = fs::path{testing::TempDir()} /
                   ("spf_writer_test_" +
                    std::string{testing::UnitTest::GetInstance()->current_test_info()->name()} + ".mcap");
};

/// Records of a kind in the data section or the summary: opcode, length (8 bytes), content.
std::vector<std::string> records(const std::string& bytes, char opcode) {
  std::vector<std::string> found;
  for (std::size_t at = 8; at + 9 <= bytes.size() - 8;) {
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < 8; ++i)
      length |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + 1 + i])) << (8 * i);
    if (bytes[at] == opcode) found.push_back(bytes.substr(at + 9, length));
    at += 9 + length;
  }
  return found;
}

TEST(Writer, EndsChunksAtTheirSizeAndIndexesEach) {
  const File file;
  Writer writer{file.path(), "ros2", 1000};
  const Writer::Id schema = writer.add_schema({"spf.Event", "jsonschema", "{}"});
  const Writer::Id one = writer.add_channel(schema, "/one", "json");
  const Writer::Id two = writer.add_channel(schema, "/two", "json");
  for (std::uint64_t i = 0; i < 10; ++i) {
    writer.write(one, 100 + i, std::string(300, 'a'));
    if (i % 2 == 0) writer.write(two, 100 + i, std::string(300, 'b'));
  }
  writer.close();
  const std::string bytes = file.bytes();
  EXPECT_EQ(bytes.substr(0, 8), bytes.substr(bytes.size() - 8));
  // 15 records of 331 bytes: four fill a chunk, and three the first, which holds schema and channels too.
  EXPECT_EQ(records(bytes, '\x06').size(), 4U);
  EXPECT_EQ(records(bytes, '\x08').size(), 4U);
  EXPECT_EQ(records(bytes, '\x03').size(), 1U) << "in the summary; the other is in a chunk";
  EXPECT_EQ(records(bytes, '\x04').size(), 2U);
  ASSERT_EQ(records(bytes, '\x0B').size(), 1U);
  EXPECT_EQ(records(bytes, '\x0B')[0][0], 15) << "messages, by the statistics";
}

TEST(Writer, KnowsASchemaByItsName) {
  const File file;
  Writer writer{file.path(), "ros2"};
  const Writer::Id first = writer.add_schema({"nav_msgs/msg/Path", "ros2msg", "x"});
  EXPECT_EQ(writer.add_schema({"nav_msgs/msg/Path", "ros2msg", "x"}), first);
  EXPECT_NE(writer.add_schema({"nav_msgs/msg/Odometry", "ros2msg", "y"}), first);
}

TEST(Writer, SaysWhichFileItCannotWrite) {
  try {
    const Writer writer{"/nowhere/trial.mcap", "ros2"};
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("/nowhere/trial.mcap cannot be written"));
  }
}

TEST(Writer, SaysWhenTheDiskIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  Writer writer{"/dev/full", "ros2", 1000};
  const Writer::Id channel = writer.add_channel(writer.add_schema({"s", "jsonschema", "{}"}), "/one", "json");
  for (int i = 0; i < 100; ++i) writer.write(channel, 0, std::string(1000, 'a'));
  EXPECT_THROW(writer.close(), std::runtime_error);
}

}  // namespace
}  // namespace spf::mcap
