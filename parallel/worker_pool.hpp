// The only threads of the library: a pool that runs independent jobs. A job may depend on its number alone
// and write only its own data; results are then the same for any number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace spf {

/// Processors of this machine, at least 1.
[[nodiscard]] int processor_count();
/// Number of threads for a user's setting, where 0 means one per processor.
[[nodiscard]] int thread_count(int asked);

class WorkerPool {
 public:
  /// `threads` of at least 1 in all: the thread that calls for_each works too, so 1 starts no thread.
  explicit WorkerPool(int threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  [[nodiscard]] int threads() const { return threads_; }

  /// Calls job(i) once for every i of 0 ... count - 1, begun in this order, and returns when all have ended.
  /// When jobs throw, no further ones begin, and the exception of the least i is thrown again. One call at a
  /// time: a job must not use its own pool.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& job);

  /// The same, with results: make(i) returns a std::optional on any thread, and take(i, result) receives it,
  /// called by one thread at a time in the order in which the jobs end. An empty optional, or false from
  /// take, stops the run: no further jobs begin, and the results of running ones are dropped.
  template <class Make, class Take>
  void collect(std::size_t count, Make&& make, Take&& take) {
    std::mutex mutex;  // guards what follows, and `take`
    bool stopped = false;
    run(count, [&](std::size_t i) {
      auto result = make(i);
      const std::lock_guard<std::mutex> lock{mutex};
      if (stopped) return false;
      stopped = true;  // stays so when `take` throws
      stopped = !result || !take(i, std::move(*result));
      return !stopped;
    });
  }

 private:
  class Round;
  struct Shared;
  /// A job that returns false stops the run: no further ones begin.
  void run(std::size_t count, const std::function<bool(std::size_t)>& job);

  int threads_;
  std::unique_ptr<Shared> shared_;
};

}  // namespace spf
