#include "experiments/results_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

namespace spf {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* what, int error) {
  throw OutputError{path.string() + ": " + what + ": " + std::strerror(error)};
}

/// 0 when everything was written, else the reason.
int write_all(int descriptor, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    if (written == 0) return ENOSPC;
    done += static_cast<std::size_t>(written);
  }
  return 0;
}

bool is_ours(const std::string& name) {
  for (const char* ours : {"summary.csv", "summary.jsonl", "scenario.yaml", "run.json", "replay.html"})
    if (name == ours) return true;
  const std::string prefix = "replay_trial_", suffix = ".html";
  if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) || !name.ends_with(suffix))
    return false;
  const std::string number = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
  return number.find_first_not_of("0123456789") == std::string::npos;
}

/// Terminals, pipes and the like are written to, not replaced by a renamed file.
bool is_stream(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  return std::filesystem::is_character_file(status) || std::filesystem::is_fifo(status);
}

/// Writes the pieces into an open file; 0 when all were written, else the reason.
int write_pieces(int descriptor, const std::function<std::string()>& next) {
  int error = 0;
  for (std::string piece = next(); error == 0 && !piece.empty(); piece = next())
    error = write_all(descriptor, piece);
  return error;
}

void write_stream(const std::filesystem::path& path, const std::function<std::string()>& next) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(path, "cannot be written", errno);
  const int error = write_pieces(descriptor, next);
  ::close(descriptor);
  if (error != 0) fail(path, "cannot be written", error);
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, const std::string& text) {
  bool given = false;
  write_file_atomically(path, [&] { return std::exchange(given, true) ? std::string{} : text; });
}

void write_file_atomically(const std::filesystem::path& path, const std::function<std::string()>& next) {
  if (is_stream(path)) return write_stream(path, next);
  const std::string temporary = path.string() + "." + std::to_string(::getpid()) + ".tmp";
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) fail(path, "cannot be written", errno);
  int error = 0;
  try {
    error = write_pieces(descriptor, next);
  } catch (...) {
    ::close(descriptor);
    ::unlink(temporary.c_str());
    throw;
  }
  if (error == 0 && ::fsync(descriptor) != 0 && errno != EINVAL)
    error = errno;  // EINVAL: not that kind of file system
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(temporary.c_str());
  fail(path, "cannot be written", error);
}

std::string text_of_file(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream{path, std::ios::binary}.rdbuf();
  return text.str();
}

void require_writable(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw OutputError{path.string() + ": is a folder, not a file"};
  const std::filesystem::path probe = path.string() + "." + std::to_string(::getpid()) + ".probe.tmp";
  const int descriptor = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) fail(path, "cannot be written", errno);
  ::close(descriptor);
  ::unlink(probe.c_str());
}

LineFile::LineFile(const std::filesystem::path& path)
    : path_{path}, descriptor_{::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644)} {
  if (descriptor_ < 0) fail(path_, "cannot be written", errno);
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  const int error = errno;
  ::close(descriptor_);
  fail(path_, "is being written by another run", error);
}

LineFile::~LineFile() {
  ::close(descriptor_);
}

void LineFile::cut(std::uintmax_t bytes) {
  if (::ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0) fail(path_, "cannot be written", errno);
}

std::uintmax_t LineFile::append(const std::string& line) {
  const off_t before = ::lseek(descriptor_, 0, SEEK_END);
  if (before < 0) fail(path_, "cannot be written", errno);
  const int error = write_all(descriptor_, line + "\n");
  if (error == 0) return static_cast<std::uintmax_t>(before);
  if (::ftruncate(descriptor_, before) != 0) fail(path_, "ends with half a line", errno);
  fail(path_, "cannot be written", error);
}

ResultsFolder::ResultsFolder(std::filesystem::path folder) : folder_{std::move(folder)} {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw OutputError{folder_.string() + ": cannot make this folder: " + error.message()};
  if (!std::filesystem::is_directory(folder_)) throw OutputError{folder_.string() + ": is no folder"};
  require_writable(folder_ / "trials.jsonl");  // better now than after an hour of simulation
}

void ResultsFolder::remove_earlier_results() const {
  std::error_code error;
  for (std::filesystem::directory_iterator entry{folder_, error}, end; !error && entry != end;
       entry.increment(error))
    if (is_ours(entry->path().filename().string())) std::filesystem::remove(entry->path(), error);
  if (error)
    throw OutputError{folder_.string() + ": cannot be cleared of earlier results: " + error.message()};
}

std::string replay_name(int trial) {
  return "replay_trial_" + std::to_string(trial) + ".html";
}

}  // namespace spf
