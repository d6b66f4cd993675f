// The guard: a scan of 720 beams in a crowded room taken in, and a command held against it, which takes in
// the older scans too. Commands lead straight on or along a curve.
#include <benchmark/benchmark.h>

#include <cmath>

#include "host/scan_guard.hpp"
#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::host {
namespace {

/// A room of 6 m x 6 m with twenty legs in it: everything is near enough to matter.
RangeScan room(int beams) {
  RandomStream random{3};
  std::vector<Eigen::Vector2d> legs;
  for (int i = 0; i < 20; ++i) {
    const double angle = random.uniform(-kPi, kPi);
    legs.emplace_back(random.uniform(0.8, 2.8) * Eigen::Vector2d{std::cos(angle), std::sin(angle)});
  }
  RangeScan scan;
  scan.angle_min = -kPi;
  scan.angle_increment = 2.0 * kPi / beams;
  for (int i = 0; i < beams; ++i) {
    const double angle = scan.angle_min + i * scan.angle_increment;
    const Eigen::Vector2d direction{std::cos(angle), std::sin(angle)};
    double range = 3.0 / std::max(std::abs(direction.x()), std::abs(direction.y()));
    for (const Eigen::Vector2d& leg : legs) {
      const double along = leg.dot(direction);
      const double room = 0.05 * 0.05 - (leg.squaredNorm() - along * along);
      if (along > 0.0 && room > 0.0) range = std::min(range, along - std::sqrt(room));
    }
    scan.ranges.push_back(range + 0.02 * random.normal());
  }
  return scan;
}

void take_in(benchmark::State& state) {
  ScanGuard guard{GuardParameters{}, AgentParameters{}, 0.1};
  const RangeScan scan = room(static_cast<int>(state.range(0)));
  double now = 10.0;
  for (auto _ : state) {
    now += 0.1;
    benchmark::DoNotOptimize(guard.add_scan(now, scan, Pose2{}, now));
  }
}

void judge(benchmark::State& state) {
  ScanGuard guard{GuardParameters{}, AgentParameters{}, 0.1};
  const RangeScan scan = room(static_cast<int>(state.range(0)));
  for (const double now : {9.8, 9.9, 10.0}) guard.add_scan(now, scan, Pose2{}, now);
  const Eigen::Vector3d twist{1.0, 0.0, state.range(1) == 0 ? 0.0 : 0.8};
  for (auto _ : state) benchmark::DoNotOptimize(guard.judge(10.0, twist));
}

BENCHMARK(take_in)->Name("guard_takes_in_a_scan")->Arg(720)->Arg(3600)->Unit(benchmark::kMicrosecond);
BENCHMARK(judge)
    ->Name("guard_judges_a_command")
    ->ArgNames({"beams", "curve"})
    ->ArgsProduct({{720, 3600}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace spf::host
