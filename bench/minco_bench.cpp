// One optimiser evaluation's share of MINCO: solve, smoothness with gradient, adjoint; and the parts alone.
#include <benchmark/benchmark.h>

#include <Eigen/Core>

#include "spf/math/random_stream.hpp"
#include "spf/trajectory/decision_vector.hpp"
#include "spf/trajectory/minco.hpp"

namespace {

/// A motion like those of a local plan: waypoints 1.5 m apart, about 1 m/s.
struct Scene {
  explicit Scene(int pieces) : layout{pieces}, decision(layout.size()), gradient(layout.size()) {
    spf::RandomStream random{static_cast<std::uint64_t>(pieces)};
    ends.head.velocity_world = {0.8, 0.1};
    ends.tail.position_world = {1.5 * pieces, 0.0};
    Eigen::Matrix2Xd waypoints(2, pieces - 1);
    Eigen::VectorXd durations(pieces);
    for (int i = 0; i + 1 < pieces; ++i)
      waypoints.col(i) = Eigen::Vector2d{1.5 * (i + 1), 0.0} + 0.3 * random.normal2();
    for (int i = 0; i < pieces; ++i) durations[i] = random.uniform(1.2, 1.8);
    layout.pack(waypoints, durations, decision);
    wrt_coefficients.setZero(6 * pieces, 2);
    wrt_durations.setZero(pieces);
    solve();
  }

  void solve() { minco.solve(ends, layout.waypoints(decision), layout.durations(decision)); }

  spf::DecisionLayout layout;
  spf::MincoEnds ends;
  Eigen::VectorXd decision;
  Eigen::VectorXd gradient;
  spf::Minco minco;
  spf::Minco::Coefficients wrt_coefficients;
  spf::Minco::Durations wrt_durations;
};

int pieces_of(const benchmark::State& state) {
  return static_cast<int>(state.range(0));
}

void minco_solve(benchmark::State& state) {
  Scene scene{pieces_of(state)};
  for (auto _ : state) {
    scene.solve();
    benchmark::DoNotOptimize(scene.minco.coefficients().data());
  }
}

void minco_adjoint(benchmark::State& state) {
  Scene scene{pieces_of(state)};
  scene.minco.add_smoothness_gradient(1.0, scene.wrt_coefficients, scene.wrt_durations);
  for (auto _ : state) {
    spf::MincoGradient gradient = scene.minco.propagate(scene.wrt_coefficients, scene.wrt_durations);
    benchmark::DoNotOptimize(gradient);
  }
}

void minco_evaluation(benchmark::State& state) {
  Scene scene{pieces_of(state)};
  for (auto _ : state) {
    scene.solve();
    double cost = scene.minco.smoothness();
    scene.wrt_coefficients.setZero();
    scene.wrt_durations.setZero();
    scene.minco.add_smoothness_gradient(1.0, scene.wrt_coefficients, scene.wrt_durations);
    scene.layout.pack_gradient(scene.minco.propagate(scene.wrt_coefficients, scene.wrt_durations),
                               scene.decision, scene.gradient);
    benchmark::DoNotOptimize(cost);
    benchmark::DoNotOptimize(scene.gradient.data());
  }
}

void trajectory_limits(benchmark::State& state) {
  const Scene scene{pieces_of(state)};
  const spf::Trajectory trajectory = scene.minco.trajectory(0.0);
  for (auto _ : state) {
    double largest = trajectory.max_speed() + trajectory.max_acceleration();
    benchmark::DoNotOptimize(largest);
  }
}

BENCHMARK(minco_solve)->Arg(3)->Arg(5)->Arg(8);
BENCHMARK(minco_adjoint)->Arg(3)->Arg(5)->Arg(8);
BENCHMARK(minco_evaluation)->Arg(3)->Arg(5)->Arg(8);
BENCHMARK(trajectory_limits)->Arg(3)->Arg(5)->Arg(8);

}  // namespace
