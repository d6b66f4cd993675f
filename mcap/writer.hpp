// Writes a recording of messages of any kind as an MCAP file (https://mcap.dev/spec): in chunks with an index
// of their messages and a summary, so that players seek without reading all. Times are nanoseconds since
// 1970. Memory is bounded: one chunk, and 100 bytes for each chunk and channel that was written.
#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spf::mcap {

/// What the messages of channels are: a name, and a definition in some language.
struct Schema {
  std::string name;      ///< "nav_msgs/msg/Path"
  std::string encoding;  ///< of the definition: ros2msg, jsonschema
  std::string definition;
};

class Writer {
 public:
  using Id = std::uint16_t;

  /// Begins a file; one that is there is replaced. Throws std::runtime_error that names it when it cannot be
  /// written. `profile` says what its messages are, as "ros2"; `chunk_size` [byte], after which one ends.
  Writer(const std::string& path, const std::string& profile, std::size_t chunk_size = 1U << 20U);
  /// Ends it if close() has not, and says nothing of what fails.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Schemas are told apart by their name: the first of a name counts.
  Id add_schema(const Schema& schema);
  /// `encoding` of its messages: cdr, json.
  Id add_channel(Id schema, const std::string& topic, const std::string& encoding);
  void write(Id id, std::uint64_t time, std::string_view message);

  /// Ends the file with its summary. Throws std::runtime_error when something could not be written, now or
  /// before.
  void close();

 private:
  struct Channel {
    std::string record;  ///< as it stands in the file
    Id schema = 0;
    bool told = false;  ///< is in a chunk already
    std::uint32_t sequence = 0;
    std::uint64_t count = 0;
  };
  using Index = std::vector<std::pair<std::uint64_t, std::uint64_t>>;  // time, offset in the chunk
  struct Times {
    std::uint64_t first = 0, last = 0;
    void add(std::uint64_t time, bool only);
  };

  void put(std::string_view bytes);
  void end_chunk();
  [[nodiscard]] std::string statistics() const;
  void write_summary();

  std::string path_;
  std::ofstream file_;
  std::uint64_t position_ = 0;  // in the file
  std::size_t chunk_size_;
  std::vector<std::string> schema_names_, schemas_;  // records by id - 1
  std::vector<bool> schemas_told_;                   // likewise: in a chunk already
  std::vector<Channel> channels_;                    // by id - 1
  struct {
    std::string records;
    std::map<Id, Index> index;
    Times times;
  } chunk_;
  std::vector<std::string> chunk_indices_;  // records
  Times times_;
  std::uint64_t messages_ = 0;
  bool closed_ = false;
};

}  // namespace spf::mcap
