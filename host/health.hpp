// How well a robot and its parts are, for whoever watches it: one level, and what is wrong. Times are the
// host's [s].
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace spf::host {

enum class Level {
  ok,    ///< does what it was told, and lacks nothing
  warn,  ///< does not, for a reason that is none of its own; or something was refused
  error  ///< lacks something that it relies on, or is at odds with another robot
};

struct Health {
  Level level = Level::ok;
  std::string text;  ///< one or several reasons, separated by "; "
};

/// At least this level, and one more reason.
void worsen(Health& health, Level level, const std::string& reason);

/// What was refused of each input: how often, and why the last time.
class RefusalLog {
 public:
  /// A `harmless` one, such as a message that came twice, is counted and kept, and worsens nothing.
  void note(const std::string& input, const std::string& why, double now, bool harmless = false);
  /// Warns of what was refused in the last moments.
  void add_to(Health& health, double now) const;
  [[nodiscard]] std::uint32_t count() const { return count_; }
  /// Input and reason; empty without one.
  [[nodiscard]] const std::string& last() const { return last_; }

 private:
  struct Entry {
    std::string why;
    double time = 0.0;  // [s]
  };
  std::map<std::string, Entry> entries_;  // by input, of which there are few
  std::string last_;
  std::uint32_t count_ = 0;
};

/// A robot's health from that of its parts, which may be processes of their own: each tells the others, and
/// the first of them that lives speaks for the robot.
class RobotHealth {
 public:
  /// [s] after which a part that tells nothing is taken for dead; they tell twice a second.
  static constexpr double kSilence = 1.5;

  /// `parts` in the order in which they speak for the robot, `own` among them.
  RobotHealth(const std::vector<std::string>& parts, std::string own, double now);

  /// Parts that are none of the robot's are ignored.
  void hear(const std::string& part, const Health& health, double now);
  [[nodiscard]] Health overall(double now) const;
  /// Whether the own part is the one that speaks.
  [[nodiscard]] bool speaks(double now) const;

 private:
  struct Part {
    std::string name;
    Health health;
    std::optional<double> time;  // [s] of the last word
  };
  [[nodiscard]] bool silent(const Part& part, double now) const;

  std::vector<Part> parts_;
  std::string own_;
  double begun_;  // [s]
};

}  // namespace spf::host
