// The control tick and its parts: observer, MPC, whole tracker, with Ipopt on the same problem for
// comparison. Each benchmark cycles through the same 2000 random instances; counters give median, 99th
// percentile and maximum of single calls [us], timed one by one (the clock itself costs some 0.03 us).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "spf/localisation/observer.hpp"
#include "spf/tracking/test/closed_loop.hpp"
#include "spf/tracking/test/mpc_instances.hpp"
#include "spf/tracking/test/plan_through.hpp"
#ifdef SPF_HAVE_IPOPT
#include "spf/tracking/test/mpc_ipopt_oracle.hpp"
#endif

namespace spf {
namespace {

constexpr int kInstances = 2000;

/// Times single calls and reports their distribution.
class CallTimes {
 public:
  CallTimes() { times_.reserve(1 << 20); }
  template <class Call>
  void time(Call&& call) {
    const auto start = std::chrono::steady_clock::now();
    call();
    const auto end = std::chrono::steady_clock::now();
    if (times_.size() < times_.capacity())
      times_.push_back(std::chrono::duration<double, std::micro>(end - start).count());
  }
  void report(benchmark::State& state) {
    if (times_.empty()) return;
    std::sort(times_.begin(), times_.end());
    const auto quantile = [this](double share) {
      return times_[static_cast<std::size_t>(share * static_cast<double>(times_.size() - 1))];
    };
    state.counters["median_us"] = quantile(0.5);
    state.counters["p99_us"] = quantile(0.99);
    state.counters["worst_us"] = quantile(1.0);
  }

 private:
  std::vector<double> times_;
};

struct Prepared {
  MpcInstance instance;
  std::unique_ptr<ModelPredictiveController> mpc;
};

std::vector<Prepared> prepare(int horizon, int iterations, bool walls, int count) {
  std::vector<Prepared> prepared;
  for (int i = 0; i < count; ++i) {
    MpcInstanceOptions options;
    options.horizon = horizon;
    options.wall_share = walls ? 0.2 : 0.0;
    options.rate_weight = MpcParameters{}.rate_weight;
    Prepared next{make_mpc_instance(mix(900, static_cast<std::uint64_t>(i)), options), nullptr};
    next.instance.parameters.iterations = iterations;
    next.mpc =
        std::make_unique<ModelPredictiveController>(next.instance.parameters, Drive{next.instance.robot});
    prepared.push_back(std::move(next));
  }
  return prepared;
}

// Arguments: horizon, iterations, warm.
void BM_Mpc(benchmark::State& state) {
  const std::vector<Prepared> prepared =
      prepare(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), true, 500);
  const bool warm = state.range(2) != 0;
  CallTimes times;
  std::size_t next = 0;
  for (auto _ : state) {
    const Prepared& current = prepared[next++ % prepared.size()];
    if (!warm) current.mpc->forget();
    times.time(
        [&] { benchmark::DoNotOptimize(current.mpc->solve(current.instance.problem).wheel_speeds[0]); });
  }
  times.report(state);
}
BENCHMARK(BM_Mpc)
    ->ArgNames({"H", "iterations", "warm"})
    ->Args({5, 1, 0})
    ->Args({5, 2, 0})
    ->Args({5, 2, 1})
    ->Args({5, 8, 0})
    ->Args({10, 2, 0})
    ->Args({10, 2, 1})
    ->Args({20, 2, 0})
    ->Args({20, 2, 1})
    ->Unit(benchmark::kMicrosecond);

#ifdef SPF_HAVE_IPOPT
void BM_Ipopt(benchmark::State& state) {
  const std::vector<Prepared> prepared = prepare(static_cast<int>(state.range(0)), 2, true, 100);
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = make_ipopt(1e-8);
  CallTimes times;
  std::size_t next = 0;
  for (auto _ : state) {
    const MpcInstance& instance = prepared[next++ % prepared.size()].instance;
    auto* oracle = new MpcIpoptProblem{instance.parameters, Drive{instance.robot}};
    const Ipopt::SmartPtr<Ipopt::TNLP> handle = oracle;
    oracle->set_problem(instance.problem);
    times.time([&] { application->OptimizeTNLP(handle); });
  }
  times.report(state);
}
BENCHMARK(BM_Ipopt)->ArgName("H")->Arg(5)->Arg(10)->Arg(20)->Unit(benchmark::kMicrosecond);
#endif

void BM_Observer(benchmark::State& state) {
  ObserverParameters parameters;
  parameters.kind = state.range(0) != 0 ? ObserverKind::kalman : ObserverKind::eso;
  parameters.pose_sigma = 0.1;
  PoseObserver observer{parameters};
  RandomStream random{1};
  std::vector<Pose2> measured(kInstances);
  for (Pose2& pose : measured) pose.position_world = 0.1 * random.normal2();
  std::size_t next = 0;
  for (auto _ : state) {
    observer.predict(0.01, {0.1, 0.0, 0.1});
    benchmark::DoNotOptimize(observer.correct(measured[next++ % measured.size()]));
  }
}
BENCHMARK(BM_Observer)->ArgName("kalman")->Arg(0)->Arg(1);

/// A smooth wavy line driven at about 0.8 m/s.
Trajectory wavy() {
  Eigen::Matrix2Xd positions(2, 31);
  for (int i = 0; i <= 30; ++i) positions.col(i) << 0.35 * i, std::sin(0.25 * i);
  return plan_through(positions, 0.5, {0.7, 0.5}, {0.7, 0.0},
                      HeadingProfile{0.0, HeadingState{}, 2.0, 0.5, 1.0});
}

// One control tick as the agent runs it: five poses at 100 Hz taken in, then reference and MPC.
void BM_ControlTick(benchmark::State& state) {
  const Trajectory trajectory = wavy();
  TrackerParameters parameters;
  parameters.mpc.horizon = static_cast<int>(state.range(0));
  parameters.observer.pose_sigma = 0.02;
  Tracker tracker{parameters, RobotParameters{}};
  RandomStream random{2};
  std::vector<Eigen::Vector2d> noise(kInstances);
  for (Eigen::Vector2d& sample : noise) sample = 0.02 * random.normal2();
  CallTimes times;
  std::size_t next = 0;
  double time = 0.0;
  for (auto _ : state) {
    Pose2 measured{trajectory.position(time) + noise[next++ % noise.size()], 0.0};
    measured.heading = trajectory.heading_state(time).heading;
    times.time([&] {
      for (int i = 4; i >= 0; --i) tracker.observe(time - 0.01 * i, measured);
      benchmark::DoNotOptimize(tracker.step(time, trajectory).wheel_speeds);
    });
    time += 0.05;
    if (time > 15.0) {
      time = 0.0;
      tracker.reset();
    }
  }
  times.report(state);
}
BENCHMARK(BM_ControlTick)->ArgName("H")->Arg(5)->Arg(10)->Arg(20)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace spf
