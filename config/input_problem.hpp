// Problems of an input with their locations, and the exception that carries all of them at once.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace spf {

/// A location in an input. `line` and `column` count from 1; 0 means the whole input (a file that cannot be
/// read, an option of the command line).
struct SourceLocation {
  std::string source;  ///< file name, or "--set"
  int line = 0;
  int column = 0;
};

/// "file:line:column", "file:line" or "file".
[[nodiscard]] std::string to_string(const SourceLocation& location);

struct InputProblem {
  SourceLocation location;
  std::string sentence;  ///< "noise.level = -1 must lie in [0, 100]"
  std::string key;  ///< path of the refused value, "noise.level"; empty when it is no value of a document
};

/// Collects problems in the order in which they are found. Stores the first `kMostProblems` and counts the
/// rest, so that a file with a million bad lines does not fill the terminal.
class InputProblems {
 public:
  static constexpr std::size_t kMostProblems = 100;

  void add(const SourceLocation& location, std::string sentence, std::string key = {});
  /// Whether the value at a key path was refused, or a parent or a part of it.
  [[nodiscard]] bool refuses(std::string_view key) const;
  /// True when further problems are only counted.
  [[nodiscard]] bool full() const { return kept_.size() == kMostProblems; }
  [[nodiscard]] bool empty() const { return kept_.empty(); }
  [[nodiscard]] const std::vector<InputProblem>& kept() const { return kept_; }
  [[nodiscard]] std::size_t left_out() const { return left_out_; }
  /// One problem a line, sorted by location.
  [[nodiscard]] std::string to_text() const;
  /// Throws InputError unless empty.
  void throw_if_any() const;

 private:
  std::vector<InputProblem> kept_;
  std::size_t left_out_ = 0;
};

/// Bad input from outside; what() is InputProblems::to_text().
class InputError : public std::runtime_error {
 public:
  explicit InputError(InputProblems problems)
      : std::runtime_error{problems.to_text()}, problems_{std::move(problems)} {}
  InputError(const SourceLocation& location, std::string sentence);
  [[nodiscard]] const InputProblems& problems() const { return problems_; }

 private:
  InputProblems problems_;
};

}  // namespace spf
