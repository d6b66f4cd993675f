#include "ros2/node/executor.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace ros2 {
namespace {

constexpr double kLongestWait = 0.1;  // [s] so that what is to be looked at `always` is

}  // namespace

StopSwitch::StopSwitch(const Participant& participant)
    : condition_{dds_create_guardcondition(participant.entity()), "guard condition"} {}

void StopSwitch::stop() {
  dds_set_guardcondition(condition_.get(), true);
}

bool StopSwitch::stopped() const {
  bool stopped = false;
  dds_read_guardcondition(condition_.get(), &stopped);
  return stopped;
}

Executor::Executor(const Participant& participant)
    : waitset_{dds_create_waitset(participant.entity()), "waitset"} {}

Executor::Registration Executor::add(Item item) {
  const int number = next_++;
  items_.emplace(number, std::move(item));
  return {*this, number};
}

Executor::Registration Executor::when(dds_entity_t entity, Callback callback) {
  const dds_return_t code = dds_waitset_attach(waitset_.get(), entity, next_);
  if (code < 0) throw DdsError{"attach", code};
  Item item;
  item.callback = std::move(callback);
  item.entity = entity;
  return add(std::move(item));
}

Executor::Registration Executor::every(Nanoseconds period, const Clock& clock, Callback callback) {
  Item item;
  item.callback = std::move(callback);
  item.clock = &clock;
  item.period = period;
  item.due = clock.now() + period;
  return add(std::move(item));
}

Executor::Registration Executor::always(Callback callback) {
  Item item;
  item.callback = std::move(callback);
  return add(std::move(item));
}

void Executor::forget(int number) {
  const auto item = items_.find(number);
  if (item == items_.end()) return;
  if (item->second.entity != 0) dds_waitset_detach(waitset_.get(), item->second.entity);
  items_.erase(item);
}

/// It may have been forgotten meanwhile, and may forget itself.
void Executor::call(int number) {
  const auto item = items_.find(number);
  if (item == items_.end()) return;
  const Callback callback = item->second.callback;
  callback();
}

void Executor::call_timers() {
  std::vector<int> due;
  for (auto& [number, item] : items_) {
    if (item.clock == nullptr) {
      if (item.entity == 0) due.push_back(number);
      continue;
    }
    const Nanoseconds now = item.clock->now();
    if (item.due > now + item.period) item.due = now + item.period;
    if (item.due > now) continue;
    item.due += (1 + (now - item.due) / item.period) * item.period;
    due.push_back(number);
  }
  for (const int number : due) call(number);
}

dds_duration_t Executor::patience(double at_most) const {
  Nanoseconds wait = nanoseconds_of(std::clamp(at_most, 0.0, kLongestWait));
  for (const auto& [number, item] : items_)
    if (item.clock != nullptr && !item.clock->simulated())
      wait = std::min(wait, std::max<Nanoseconds>(0, item.due - item.clock->now()));
  return wait;
}

void Executor::spin_once(double at_most) {
  std::array<dds_attach_t, 64> triggered{};
  const dds_return_t count =
      dds_waitset_wait(waitset_.get(), triggered.data(), triggered.size(), patience(at_most));
  if (count < 0) throw DdsError{"wait", count};
  const std::size_t filled = std::min(static_cast<std::size_t>(count), triggered.size());
  for (std::size_t i = 0; i < filled; ++i) call(static_cast<int>(triggered[i]));
  call_timers();
}

bool Executor::spin_until(const std::function<bool()>& done, double at_most) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>{at_most};
  while (!done()) {
    const double left = std::chrono::duration<double>{end - std::chrono::steady_clock::now()}.count();
    if (left <= 0.0) return false;
    spin_once(left);
  }
  return true;
}

void Executor::spin(const StopSwitch& until) {
  const Registration woken = when(until.entity(), [] {});
  while (!until.stopped()) spin_once();
}

}  // namespace ros2
