// The folder below --out. Files appear whole or not at all: each is written beside its place and renamed; a
// growing file grows by whole lines.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace spf {

/// A result that could not be written; what() names the file and the system's reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes a file through a temporary one in the same folder, flushed to the disk, then renamed. Throws
/// OutputError and leaves what was there before.
void write_file_atomically(const std::filesystem::path& path, const std::string& text);

/// Throws OutputError unless a file of this name could be written now.
void require_writable(const std::filesystem::path& path);

/// A file that grows line by line. A line that does not fit on the disk is taken back whole.
class LineFile {
 public:
  /// Begins an empty file. Throws OutputError.
  explicit LineFile(const std::filesystem::path& path);
  /// Goes on with a file (a new one, when there is none) behind its first `keep` bytes; what follows them is
  /// dropped. Nobody else may be writing it this way: throws OutputError then, and when it cannot be written.
  LineFile(const std::filesystem::path& path, std::uintmax_t keep);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Appends the text and a line feed. Throws OutputError; the file then ends with the line before.
  void append(const std::string& line);

 private:
  std::filesystem::path path_;
  int descriptor_;
};

enum class EarlierResults { remove, keep };

class ResultsFolder {
 public:
  /// Makes the folder and removes the results of an earlier run from it, by the names that this program
  /// gives, unless they are to be kept; other files stay. Throws OutputError.
  explicit ResultsFolder(std::filesystem::path folder, EarlierResults earlier = EarlierResults::remove);

  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const {
    write_file_atomically(file(name), text);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// Name of the replay page of a trial: replay_trial_7.html.
[[nodiscard]] std::string replay_name(int trial);

}  // namespace spf
