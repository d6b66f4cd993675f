#include "host/health.hpp"

#include <algorithm>
#include <utility>

namespace spf::host {
namespace {

constexpr double kRecent = 2.0;          // [s] for which a refusal counts
constexpr std::size_t kMostInputs = 64;  // that are told apart

}  // namespace

void worsen(Health& health, Level level, const std::string& reason) {
  health.level = std::max(health.level, level);
  if (!health.text.empty()) health.text += "; ";
  health.text += reason;
}

void RefusalLog::note(const std::string& input, const std::string& why, double now, bool harmless) {
  ++count_;
  last_ = input + ": " + why;
  if (harmless) return;
  if (entries_.size() >= kMostInputs && entries_.count(input) == 0) return;
  entries_[input] = {why, now};
}

void RefusalLog::add_to(Health& health, double now) const {
  for (const auto& [input, entry] : entries_)
    if (entry.time <= now && now - entry.time <= kRecent)
      worsen(health, Level::warn, input + ": " + entry.why);
}

RobotHealth::RobotHealth(const std::vector<std::string>& parts, std::string own, double now)
    : own_{std::move(own)}, begun_{now} {
  for (const std::string& name : parts) parts_.push_back({name, {}, std::nullopt});
}

void RobotHealth::hear(const std::string& part, const Health& health, double now) {
  for (Part& known : parts_) {
    if (known.name != part) continue;
    known.health = health;
    known.time = now;
  }
}

/// After a jump of the clock the old words are of no known age.
bool RobotHealth::silent(const Part& part, double now) const {
  const double last = part.time.value_or(begun_);
  return now - last > kSilence || last > now + kSilence;
}

bool RobotHealth::speaks(double now) const {
  for (const Part& part : parts_) {
    if (part.name == own_) return true;
    if (!silent(part, now)) return false;
  }
  return false;
}

Health RobotHealth::overall(double now) const {
  Health health;
  for (const Part& part : parts_) {
    if (silent(part, now))
      worsen(health, Level::error, part.name + ": silent");
    else if (!part.time)
      worsen(health, Level::warn, part.name + ": not heard yet");
    else if (part.health.level != Level::ok)
      worsen(health, part.health.level, part.name + ": " + part.health.text);
  }
  if (health.level != Level::ok) return health;
  for (const Part& part : parts_)
    if (part.name == "planner" || health.text.empty()) health.text = part.health.text;
  return health;
}

}  // namespace spf::host
