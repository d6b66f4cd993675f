// Progress on stderr: one line that is rewritten on a terminal, an occasional line elsewhere, nothing when
// quiet.
#pragma once

#include <string>

namespace spf {

/// Seconds of a steady clock.
[[nodiscard]] double steady_seconds();

/// "1:05" or "2:03:09" of a duration [s].
[[nodiscard]] std::string clock_text(double seconds);

class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows the text when an update is due; may be called at any rate.
  void show(const std::string& text);
  /// Ends the line, so that other output starts on a fresh one.
  void end();

 private:
  bool quiet_;
  bool terminal_;
  double next_ = 0.0;  // [s] when to show again
  bool open_ = false;
};

}  // namespace spf
