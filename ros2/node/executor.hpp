// Waits for what nodes listen to, and calls whoever waits for it: one executor, one thread.
#pragma once

#include <functional>
#include <map>
#include <memory>

#include "ros2/node/participant.hpp"
#include "ros2/node/time.hpp"

namespace ros2 {

/// Ends executors, from any thread.
class StopSwitch {
 public:
  explicit StopSwitch(const Participant& participant);
  void stop();
  [[nodiscard]] bool stopped() const;
  [[nodiscard]] dds_entity_t entity() const { return condition_.get(); }

 private:
  Entity condition_;
};

class Executor {
 public:
  using Callback = std::function<void()>;

  explicit Executor(const Participant& participant);
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  /// Keeps a callback registered.
  class Registration {
   public:
    Registration() = default;
    Registration(Executor& executor, int number) : executor_{&executor}, number_{number} {}
    Registration(Registration&& other) noexcept
        : executor_{std::exchange(other.executor_, nullptr)}, number_{other.number_} {}
    Registration& operator=(Registration&& other) noexcept {
      std::swap(executor_, other.executor_);
      std::swap(number_, other.number_);
      return *this;
    }
    ~Registration() {
      if (executor_ != nullptr) executor_->forget(number_);
    }

   private:
    Executor* executor_ = nullptr;
    int number_ = 0;
  };

  /// Calls when the entity, a condition or one with a status mask, triggers.
  [[nodiscard]] Registration when(dds_entity_t entity, Callback callback);
  /// Calls every `period` of a clock, which must outlive the registration. Times that were missed are left
  /// out; when the clock jumps back, the next is a period later.
  [[nodiscard]] Registration every(Nanoseconds period, const Clock& clock, Callback callback);
  /// Calls after each waiting: at least ten times a second.
  [[nodiscard]] Registration always(Callback callback);

  /// Waits until something happens, for no longer than `at_most` [s] nor 0.1 s, and calls whoever waited for
  /// it.
  void spin_once(double at_most = 0.1);
  /// Until `done` says so (true), or `at_most` [s] are over (false).
  bool spin_until(const std::function<bool()>& done, double at_most);
  /// Until somebody stops it.
  void spin(const StopSwitch& until);

 private:
  struct Item {
    Callback callback;
    dds_entity_t entity = 0;       // that triggers it,
    const Clock* clock = nullptr;  // or by which it is due,
    Nanoseconds period = 0, due = 0;
  };
  [[nodiscard]] Registration add(Item item);
  void forget(int number);
  void call(int number);
  void call_timers();
  /// How long to wait.
  [[nodiscard]] dds_duration_t patience(double at_most) const;

  Entity waitset_;
  std::map<int, Item> items_;
  int next_ = 1;
};

}  // namespace ros2
