#include "host/peer_clocks.hpp"

#include <algorithm>
#include <cmath>

#include "spf/world/peer_table.hpp"

namespace spf::host {
namespace {

constexpr double kSpan = 5.0;        // [s] two of them are looked back on
constexpr int kEnoughMessages = 10;  // of which one would have come in time

/// Enters one more into the smallest of `count` in order, as far as there is room for it.
template <std::size_t kRoom>
void keep_smallest(std::array<double, kRoom>& smallest, int count, double value) {
  std::size_t slot = std::min(static_cast<std::size_t>(count), kRoom);
  for (; slot > 0 && value < smallest[slot - 1]; --slot)
    if (slot < kRoom) smallest[slot] = smallest[slot - 1];
  if (slot < kRoom) smallest[slot] = value;
}

}  // namespace

void PeerClocks::hear(int robot_id, double sent_time, double now) {
  if (!std::isfinite(sent_time) || !std::isfinite(now)) return;
  if (known_.count(robot_id) == 0 && !has_room(now)) return;
  Record& record = known_[robot_id];
  if (now - record.now.begun > kSpan) {
    record.before = now - record.now.begun > 2.0 * kSpan ? Span{} : record.now;
    record.now = {now, 0, 0, {}};
  }
  record.last = now;
  Span& span = record.now;
  const double age = now - sent_time;
  keep_smallest(span.ages, span.count, age);
  ++span.count;
  if (age < -tolerance_) ++span.of_future;
}

double PeerClocks::error_of(const Record& record, double now) const {
  if (now - record.last > kSpan) return 0.0;
  std::array<double, kSmallest> ages{};
  int kept = 0;
  int count = 0;
  int of_future = 0;
  for (const Span* span : {&record.now, &record.before}) {
    if (now - span->begun > 2.0 * kSpan) continue;
    const int known = std::min(span->count, static_cast<int>(kSmallest));
    for (int i = 0; i < known; ++i) keep_smallest(ages, kept++, span->ages[static_cast<std::size_t>(i)]);
    count += span->count;
    of_future += span->of_future;
  }
  if (kept < static_cast<int>(kSmallest)) return 0.0;
  const double age = ages[kSmallest - 1];
  const bool ahead = age < -tolerance_ && 2 * of_future >= count;
  const bool behind = age > tolerance_ && count >= kEnoughMessages;
  return ahead || behind ? -age : 0.0;
}

double PeerClocks::error(int robot_id, double now) const {
  const auto entry = known_.find(robot_id);
  return entry == known_.end() ? 0.0 : error_of(entry->second, now);
}

std::map<int, double> PeerClocks::errors(double now) const {
  std::map<int, double> errors;
  for (const auto& [robot_id, record] : known_)
    if (const double error = error_of(record, now); error != 0.0) errors[robot_id] = error;
  return errors;
}

bool PeerClocks::has_room(double now) {
  if (known_.size() < kMostPeers) return true;
  const auto silent = std::find_if(known_.begin(), known_.end(),
                                   [&](const auto& entry) { return now - entry.second.last > kSpan; });
  if (silent == known_.end()) return false;
  known_.erase(silent);
  return true;
}

}  // namespace spf::host
