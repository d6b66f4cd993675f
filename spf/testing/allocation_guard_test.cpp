#include "spf/testing/allocation_guard.hpp"

#include <gtest/gtest.h>
#include <Eigen/Core>

#include <memory>
#include <new>
#include <string>
#include <thread>
#include <vector>

namespace spf {
namespace {

template <class Value>
void keep(Value& value) {  // the compiler may leave out an allocation that nobody can observe
  asm volatile("" : : "g"(&value) : "memory");
}

struct alignas(64) Wide {
  double values[8];
};

TEST(AllocationGuard, SeesNothingWhereNothingIsAllocated) {
  const AllocationGuard guard;
  Eigen::Matrix4d product = Eigen::Matrix4d::Identity() * 2.0;
  product = product * product;
  keep(product);
  EXPECT_EQ(guard.allocations(), 0);
}

TEST(AllocationGuard, SeesEveryFormOfNew) {
  const AllocationGuard guard;
  auto* single = new int{1};
  auto* array = new int[3];
  auto* wide = new Wide{};
  auto* wide_array = new Wide[2];
  auto* quiet = new (std::nothrow) int{2};
  auto* quiet_array = new (std::nothrow) int[2];
  keep(single);
  keep(array);
  keep(wide);
  keep(wide_array);
  keep(quiet);
  keep(quiet_array);
  EXPECT_EQ(guard.allocations(), 6);
  delete single;
  delete[] array;
  delete wide;
  delete[] wide_array;
  delete quiet;
  delete[] quiet_array;
  EXPECT_EQ(guard.allocations(), 6);  // giving back is no allocation
}

TEST(AllocationGuard, SeesContainersAndEigen) {
  const AllocationGuard guard;
  std::vector<int> numbers(100);
  keep(numbers);
  EXPECT_EQ(guard.allocations(), 1);
  Eigen::VectorXd vector = Eigen::VectorXd::Zero(50);
  keep(vector);
  EXPECT_EQ(guard.allocations(), 2);
  vector.conservativeResize(500);
  keep(vector);
  EXPECT_EQ(guard.allocations(), 3);
}

TEST(AllocationGuard, SeesTheCallOfMallocItself) {
  const AllocationGuard guard;
  void* memory = std::malloc(10);
  keep(memory);
  std::free(memory);
  EXPECT_EQ(guard.allocations(), 1);
}

TEST(AllocationGuard, KnowsHowMuchIsHeld) {
  constexpr long kRounding = 64;  // [byte] by which an allocator may give more
  const AllocationGuard guard;
  {
    std::vector<char> bytes(1000);
    keep(bytes);
    EXPECT_GE(guard.bytes(), 1000);
    EXPECT_LE(guard.bytes(), 1000 + kRounding);
    Eigen::VectorXd numbers = Eigen::VectorXd::Zero(100);
    numbers.conservativeResize(200);
    keep(numbers);
    EXPECT_GE(guard.bytes(), 1000 + 1600);
    EXPECT_LE(guard.bytes(), 1000 + 1600 + 2 * kRounding);
  }
  EXPECT_EQ(guard.bytes(), 0);
}

TEST(AllocationGuard, CountsOnlyItsOwnThread) {
  std::thread other{[] {
    std::string text(1000, 'x');
    keep(text);
  }};
  other.join();
  const AllocationGuard guard;
  std::thread another;
  EXPECT_EQ(guard.allocations(), 0);
  {
    std::vector<double> values;
    values.reserve(8);
    keep(values);
  }
  EXPECT_EQ(guard.allocations(), 1);
}

}  // namespace
}  // namespace spf
