// The paper's planner: one evaluation of the total cost with its gradient, and complete plans, cold and warm,
// among 30 static obstacles and 10 peers. Counters give the 99th percentile and the maximum besides the mean.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "spf/math/random_stream.hpp"
#include "spf/planning/field/field_planner.hpp"

namespace spf {
namespace {

/// A field of 30 m with 30 boxes, moving peers and moving obstacles, for one robot that crosses it.
struct Scene {
  OccupancyMap map{GridFrame::covering({-15.0, -15.0}, {15.0, 15.0}, 0.1), 2.0};
  std::vector<ObstacleTrack> tracks;
  std::vector<Peer> peers;
  CostToGo guide{CostToGoParameters{}, 0.2};
  PlanRequest request;

  Scene(std::uint64_t seed, int boxes, int peer_count, int obstacles) {
    RandomStream random{seed};
    const auto position = [&random](double half) {
      const double x = random.uniform(-half, half);
      const double y = random.uniform(-half, half);
      return Eigen::Vector2d{x, y};
    };
    const double angle = random.uniform(-3.1, 3.1);
    const Eigen::Vector2d start = 12.0 * Eigen::Vector2d{std::cos(angle), std::sin(angle)};
    map.add_border({-15.0, -15.0}, {15.0, 15.0});
    std::vector<Eigen::Vector2d> centers;
    while (static_cast<int>(centers.size()) < boxes) {
      const Eigen::Vector2d center = position(10.0);
      const bool crowded = std::any_of(centers.begin(), centers.end(), [&](const Eigen::Vector2d& other) {
        return (other - center).norm() < 1.9;
      });
      if (crowded || (center - start).norm() < 2.0 || (center + start).norm() < 2.0) continue;
      centers.push_back(center);
      const double half = random.uniform(0.25, 0.5);
      map.add_box(center - Eigen::Vector2d{half, half}, center + Eigen::Vector2d{half, half});
    }
    for (int i = 0; i < peer_count; ++i) {
      Peer peer;
      peer.robot_id = i;
      peer.state = PeerState::moving;
      Trajectory course{0.0};
      Eigen::Vector2d from = start + 4.0 * random.normal2();
      if ((from - start).norm() < 1.5) from = start + 1.5 * (from - start).normalized();
      const Eigen::Vector2d velocity = 0.7 * random.normal2().normalized();
      for (int k = 0; k < 5; ++k) {
        QuinticPiece piece;
        piece.duration = 1.5;
        piece.coefficients.row(0) = (from + 1.5 * k * velocity).transpose();
        piece.coefficients.row(1) = velocity.transpose();
        course.append(piece);
      }
      peer.trajectory = course;
      peers.push_back(peer);
    }
    for (int i = 0; i < obstacles; ++i) {
      ObstacleTrack track;
      track.id = i;
      track.state = {0.5 * start + 3.0 * random.normal2(), 0.6 * random.normal2(), 0.4};
      tracks.push_back(track);
    }
    request.head.position_world = start;
    request.goal_world = -start;
    request.world = {0.0, peer_count, &map, &tracks, &peers};
    guide.update(map, request.goal_world, start);
    request.guide = &guide;
  }
};

/// Arguments: pieces, peers.
void whole_cost(benchmark::State& state) {
  const auto pieces = static_cast<int>(state.range(0));
  RandomStream random{3};
  TrajectoryOptimizer optimizer{PlannerParameters{}, RobotParameters{}};
  TrajectorySeed seed;
  seed.resize(pieces);
  for (int i = 0; i < pieces; ++i) {
    seed.durations[i] = 1.5;
    if (i + 1 < pieces)
      seed.waypoints_world.col(i) = Eigen::Vector2d{1.4 * (i + 1), 0.0} + 0.1 * random.normal2();
  }
  const Scene scene{5, 0, static_cast<int>(state.range(1)), 0};
  ClearanceModel clearance{PlannerParameters{}, RobotParameters{}, FieldParameters{}};
  clearance.prepare(scene.request.world, 0.0, PeerSelection::yield_to);
  std::vector<GuidePair> pairs;
  for (int k = 2; k < 5 * pieces; k += 3) pairs.push_back({k, {0.28 * k, 0.1}, Eigen::Vector2d::UnitY(), -1});
  TrajectoryProblem problem;
  problem.ends.tail.position_world = {1.4 * pieces, 0.0};
  problem.discs = &clearance.discs();
  problem.static_pairs = problem.field_pairs = &pairs;
  optimizer.set(problem, seed);
  const DecisionLayout layout{pieces};
  Eigen::VectorXd decision(layout.size());
  layout.pack(seed.waypoints_world, seed.durations, decision);
  Eigen::VectorXd gradient(layout.size());
  for (auto _ : state) benchmark::DoNotOptimize(optimizer.evaluate(decision, gradient));
}
BENCHMARK(whole_cost)->ArgsProduct({{5, 8}, {0, 4, 10}});

void report(benchmark::State& state, std::vector<double>& milliseconds, int successes) {
  std::sort(milliseconds.begin(), milliseconds.end());
  const auto at = [&](double share) {
    return milliseconds[static_cast<std::size_t>(share * static_cast<double>(milliseconds.size() - 1))];
  };
  state.counters["median_ms"] = at(0.5);
  state.counters["p99_ms"] = at(0.99);
  state.counters["max_ms"] = at(1.0);
  state.counters["ok_share"] = static_cast<double>(successes) / static_cast<double>(milliseconds.size());
}

/// Arguments: dynamic model, moving obstacles, 1 = warm. A new scene each time; warm plans start 0.5 s into a
/// cold one.
void one_plan(benchmark::State& state) {
  PlannerParameters parameters;
  parameters.dynamic_model = static_cast<DynamicModel>(state.range(0));
  const bool warm = state.range(2) != 0;
  FieldPlanner planner{parameters, RobotParameters{}, FieldParameters{}};
  std::vector<std::unique_ptr<Scene>> scenes;
  for (std::uint64_t i = 0; i < 50; ++i)
    scenes.push_back(std::make_unique<Scene>(100 + i, 30, 10, static_cast<int>(state.range(1))));
  std::vector<double> milliseconds;
  int successes = 0;
  std::size_t next = 0;
  PlanResult result;
  for (auto _ : state) {
    Scene& scene = *scenes[next++ % scenes.size()];
    PlanRequest request = scene.request;
    Trajectory committed;
    if (warm) {
      planner.plan(request, result);
      committed = result.trajectory;
      request.time = request.world.time = 0.5;
      request.head = committed.state(0.5);
      request.committed = &committed;
    }
    const auto begin = std::chrono::steady_clock::now();
    planner.plan(request, result);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    state.SetIterationTime(seconds);
    milliseconds.push_back(1e3 * seconds);
    successes += result.outcome == PlanOutcome::success ? 1 : 0;
  }
  report(state, milliseconds, successes);
}
constexpr auto kField = static_cast<std::int64_t>(DynamicModel::probability_field);
constexpr auto kConstant = static_cast<std::int64_t>(DynamicModel::constant_velocity);
BENCHMARK(one_plan)
    ->Args({kField, 0, 0})
    ->Args({kField, 0, 1})
    ->Args({kField, 4, 0})
    ->Args({kField, 4, 1})
    ->Args({kConstant, 4, 0})
    ->Args({kConstant, 4, 1})
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace spf
