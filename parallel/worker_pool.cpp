#include "parallel/worker_pool.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <thread>
#include <vector>

namespace spf {

/// The jobs of one call.
class WorkerPool::Round {
 public:
  Round(std::size_t count, const std::function<bool(std::size_t)>& job) : count_{count}, job_{job} {}

  /// Runs jobs until none is left to begin.
  void work() {
    while (!stopped_) {
      const std::size_t index = next_++;
      if (index >= count_) return;
      try {
        if (!job_(index)) stopped_ = true;
      } catch (...) {
        stopped_ = true;
        const std::lock_guard lock{mutex_};
        if (!failure_ || index < failed_) {
          failure_ = std::current_exception();
          failed_ = index;
        }
      }
    }
  }
  /// To be called when no job is running any more.
  void rethrow_failure() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::size_t count_;
  const std::function<bool(std::size_t)>& job_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;  // guards what follows
  std::exception_ptr failure_;
  std::size_t failed_ = 0;
};

/// State shared by the threads. A thread takes part in every round once, however late it wakes.
struct WorkerPool::Shared {
  std::mutex mutex;  // guards what follows
  std::condition_variable begins, ended;
  Round* round = nullptr;
  std::uint64_t rounds = 0;  // begun so far
  std::size_t busy = 0;      // threads that have not left the round
  bool closing = false;
  std::vector<std::thread> threads;

  void serve() {
    std::uint64_t served = 0;
    std::unique_lock lock{mutex};
    while (true) {
      begins.wait(lock, [&] { return closing || rounds != served; });
      if (closing) return;
      served = rounds;
      Round& current = *round;
      lock.unlock();
      current.work();
      lock.lock();
      if (--busy == 0) ended.notify_one();
    }
  }
  void close() {
    {
      const std::lock_guard lock{mutex};
      closing = true;
    }
    begins.notify_all();
    for (std::thread& thread : threads) thread.join();
  }
};

int processor_count() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

int thread_count(int asked) {
  return asked > 0 ? asked : processor_count();
}

WorkerPool::WorkerPool(int threads) : threads_{std::max(threads, 1)}, shared_{std::make_unique<Shared>()} {
  try {
    for (int i = 1; i < threads_; ++i) shared_->threads.emplace_back([this] { shared_->serve(); });
  } catch (...) {  // the system gives no more threads
    shared_->close();
    throw;
  }
}

WorkerPool::~WorkerPool() {
  shared_->close();
}

void WorkerPool::for_each(std::size_t count, const std::function<void(std::size_t)>& job) {
  run(count, [&job](std::size_t index) {
    job(index);
    return true;
  });
}

void WorkerPool::run(std::size_t count, const std::function<bool(std::size_t)>& job) {
  Round round{count, job};
  const bool alone = shared_->threads.empty() || count < 2;
  if (!alone) {
    const std::lock_guard lock{shared_->mutex};
    assert(shared_->round == nullptr);
    shared_->round = &round;
    shared_->busy = shared_->threads.size();
    ++shared_->rounds;
  }
  if (!alone) shared_->begins.notify_all();
  round.work();
  if (!alone) {
    std::unique_lock lock{shared_->mutex};
    shared_->ended.wait(lock, [this] { return shared_->busy == 0; });
    shared_->round = nullptr;
  }
  round.rethrow_failure();
}

}  // namespace spf
