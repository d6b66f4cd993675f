// The safety probability field: construction and queries.
#include <benchmark/benchmark.h>

#include <vector>

#include "spf/field/probability_field.hpp"
#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

ObstacleState draw_obstacle(RandomStream& random) {
  ObstacleState obstacle;
  obstacle.position_world = 5.0 * random.normal2();
  obstacle.velocity_world = 0.7 * random.normal2();
  obstacle.radius = random.uniform(0.2, 0.6);
  return obstacle;
}

void build_field(benchmark::State& state) {
  RandomStream random{1};
  std::vector<ObstacleState> obstacles;
  for (int i = 0; i < 256; ++i) obstacles.push_back(draw_obstacle(random));
  std::size_t next = 0;
  for (auto _ : state) {
    const ProbabilityField field{obstacles[next++ % obstacles.size()], 0.3, FieldParameters{}};
    benchmark::DoNotOptimize(field);
  }
}
BENCHMARK(build_field);

/// Queries at one point: those of a node (distance, direction, guide point), and the density with its
/// gradient.
template <class Query>
void ask_field(benchmark::State& state, const Query& query) {
  RandomStream random{2};
  const ProbabilityField field{draw_obstacle(random), 0.3, FieldParameters{}};
  std::vector<Eigen::Vector2d> positions;
  for (int i = 0; i < 256; ++i) positions.emplace_back(field.center_world() + 0.7 * random.normal2());
  std::size_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(query(field, positions[next++ % positions.size()]));
}

void field_mahalanobis(benchmark::State& state) {
  ask_field(state,
            [](const ProbabilityField& field, const Eigen::Vector2d& p) { return field.mahalanobis(p); });
}
BENCHMARK(field_mahalanobis);

void field_density_and_gradient(benchmark::State& state) {
  ask_field(state, [](const ProbabilityField& field, const Eigen::Vector2d& p) {
    return Eigen::Vector3d{field.density(p), field.density_gradient(p).x(), field.density_gradient(p).y()};
  });
}
BENCHMARK(field_density_and_gradient);

void field_guide_point(benchmark::State& state) {
  ask_field(state, [](const ProbabilityField& field, const Eigen::Vector2d& p) {
    const Eigen::Vector2d direction = field.escape_direction(p, Eigen::Vector2d::UnitX());
    return field.guide_point(p, direction, field.threshold());
  });
}
BENCHMARK(field_guide_point);

}  // namespace
}  // namespace spf
