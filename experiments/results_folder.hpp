// The folder given by --out. Files appear complete or not at all: each is written under a temporary name and
// renamed; a growing file grows by whole lines.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

namespace spf {

/// A result that could not be written; what() names the file and the system's reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes a file through a temporary one in the same folder, flushed to the disk, then renamed. Throws
/// OutputError and leaves an earlier file unchanged.
void write_file_atomically(const std::filesystem::path& path, const std::string& text);

/// The same, piece by piece: `next` gives the pieces of the text, and an empty one after the last.
void write_file_atomically(const std::filesystem::path& path, const std::function<std::string()>& next);

/// Text of a file; empty when there is none.
[[nodiscard]] std::string text_of_file(const std::filesystem::path& path);

/// Throws OutputError unless a file of this name could be written now.
void require_writable(const std::filesystem::path& path);

/// A file that grows line by line. A line that does not fit on the disk is taken back whole.
class LineFile {
 public:
  /// Continues a file, or begins it. Throws OutputError when another process is writing it this way, or when
  /// it cannot be written.
  explicit LineFile(const std::filesystem::path& path);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Drops all but the first `bytes`. Throws OutputError.
  void cut(std::uintmax_t bytes);
  /// Appends the text and a line feed; returns where the line begins. Throws OutputError; the file then ends
  /// with the line before.
  std::uintmax_t append(const std::string& line);

 private:
  std::filesystem::path path_;
  int descriptor_;
};

enum class EarlierResults { remove, keep };

class ResultsFolder {
 public:
  /// Makes the folder. Throws OutputError, also when it cannot be written into.
  explicit ResultsFolder(std::filesystem::path folder);

  /// Removes the files of an earlier run except trials.jsonl, by the names that this program gives; other
  /// files stay. Throws OutputError.
  void remove_earlier_results() const;

  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const {
    write_file_atomically(file(name), text);
  }
  void write(const std::string& name, const std::function<std::string()>& next) const {
    write_file_atomically(file(name), next);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// Name of the replay page of a trial: replay_trial_7.html.
[[nodiscard]] std::string replay_name(int trial);

}  // namespace spf
