#include "parallel/worker_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace spf {
namespace {

TEST(WorkerPoolThreads, RunEveryJobOnceForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 3, 8}) {
    WorkerPool pool{threads};
    EXPECT_EQ(pool.threads(), threads);
    for (const std::size_t count : {0U, 1U, 2U, 7U, 1000U}) {
      std::vector<int> calls(count, 0);
      pool.for_each(count, [&calls](std::size_t i) { ++calls[i]; });
      EXPECT_EQ(std::count(calls.begin(), calls.end(), 1), static_cast<std::ptrdiff_t>(count))
          << threads << " threads";
    }
  }
}

TEST(WorkerPoolThreads, ServeManyShortRounds) {
  WorkerPool pool{4};
  std::array<std::size_t, 5> sums{};
  for (std::size_t round = 1; round <= 2000; ++round)
    pool.for_each(sums.size(), [&sums, round](std::size_t i) { sums[i] += i * round; });
  for (std::size_t i = 0; i < sums.size(); ++i) EXPECT_EQ(sums[i], i * 2000 * 2001 / 2);
}

TEST(WorkerPoolThreads, WorkAtTheSameTime) {
  WorkerPool pool{3};
  std::mutex mutex;
  std::condition_variable arrived;
  int here = 0;
  std::atomic<int> met{0};
  pool.for_each(3, [&](std::size_t) {
    std::unique_lock lock{mutex};
    ++here;
    arrived.notify_all();
    if (arrived.wait_for(lock, std::chrono::seconds{60}, [&] { return here == 3; })) ++met;
  });
  EXPECT_EQ(met, 3);
}

TEST(WorkerPoolThreads, ThrowTheEarliestFailureAfterAllHaveEnded) {
  for (const int threads : {1, 4}) {
    WorkerPool pool{threads};
    for (int repeat = 0; repeat < 50; ++repeat) {
      std::atomic<int> begun{0}, ended{0};
      try {
        pool.for_each(100, [&](std::size_t i) {
          ++begun;
          if (i == 5 || i == 6) throw std::runtime_error{"job " + std::to_string(i)};
          ++ended;
        });
        FAIL() << "nothing was thrown";
      } catch (const std::runtime_error& error) {
        // Jobs begin in order, so that 5 has begun whenever 6 has.
        EXPECT_STREQ(error.what(), "job 5");
      }
      const int failed = begun - ended;
      EXPECT_TRUE(failed == 1 || failed == 2) << failed;
      EXPECT_TRUE(threads > 1 || begun == 6);
    }
    int calls = 0;
    pool.for_each(1, [&calls](std::size_t) { ++calls; });
    EXPECT_EQ(calls, 1) << "a pool is of use after a failure";
  }
}

TEST(WorkerPoolThreads, HandOverResultsOneAtATime) {
  WorkerPool pool{4};
  std::vector<std::size_t> squares(200, 0);
  std::vector<std::size_t> order;  // unguarded: `take` never runs twice at once
  pool.collect(
      squares.size(), [](std::size_t i) { return std::optional<std::size_t>{i * i}; },
      [&](std::size_t i, std::size_t square) {
        squares[i] = square;
        order.push_back(i);
        return true;
      });
  for (std::size_t i = 0; i < squares.size(); ++i) EXPECT_EQ(squares[i], i * i);
  EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), squares.size());
}

TEST(WorkerPoolThreads, StopWhenToldTo) {
  for (const int threads : {1, 4}) {
    WorkerPool pool{threads};
    std::size_t taken = 0;
    pool.collect(
        1000, [](std::size_t i) { return std::optional<std::size_t>{i}; },
        [&](std::size_t, std::size_t) { return ++taken < 3; });
    EXPECT_EQ(taken, 3U) << "and what was under way is dropped";

    taken = 0;
    pool.collect(
        1000, [](std::size_t i) { return i < 10 ? std::optional<std::size_t>{i} : std::nullopt; },
        [&taken](std::size_t, std::size_t) { return ++taken > 0; });
    EXPECT_LE(taken, 10U);
  }
}

TEST(WorkerPoolThreads, TakeNothingAfterAFailureToTake) {
  WorkerPool pool{4};
  int taken = 0;
  const auto take = [&taken](std::size_t, int) -> bool {
    if (++taken == 2) throw std::runtime_error{"the disk is full"};
    return true;
  };
  EXPECT_THROW(pool.collect(
                   100, [](std::size_t) { return std::optional<int>{1}; }, take),
               std::runtime_error);
  EXPECT_EQ(taken, 2);
}

TEST(ThreadCount, IsWhatIsAskedForOrTheProcessors) {
  EXPECT_GE(processor_count(), 1);
  EXPECT_EQ(thread_count(0), processor_count());
  EXPECT_EQ(thread_count(3), 3);
}

}  // namespace
}  // namespace spf
