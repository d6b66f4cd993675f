#include "sim/moving_obstacles.hpp"

#include <algorithm>
#include <cmath>

#include "sim/geometry.hpp"

namespace spf::sim {
namespace {

constexpr double kVelocityVariance = 1e-2;  // [(m/s)^2] at 1 Sigma
constexpr double kPositionVariance = 1e-4;  // [m^2] at 1 Sigma

std::uint64_t noise_seed(const Scenario& scenario) {
  const auto level = static_cast<std::uint64_t>(std::llround(1000.0 * scenario.simulation.noise.level));
  return mix(mix(scenario.seed ^ 0xABCDEFULL, static_cast<std::uint64_t>(scenario.trial)), level);
}

/// Mirrors one coordinate at the border's two sides; the velocity turns inwards.
void reflect_at_border(const Box& border, ObstacleState& disc) {
  for (int axis = 0; axis < 2; ++axis) {
    const double low = border.low[axis] + disc.radius;
    const double high = border.high[axis] - disc.radius;
    double& coordinate = disc.position_world[axis];
    double& speed = disc.velocity_world[axis];
    if (low > high) {  // larger than the field: it stays in the middle
      coordinate = 0.5 * (low + high);
    } else if (coordinate < low) {
      coordinate = std::min(2.0 * low - coordinate, high);
      speed = std::abs(speed);
    } else if (coordinate > high) {
      coordinate = std::max(2.0 * high - coordinate, low);
      speed = -std::abs(speed);
    }
  }
}

/// The box grown by the radius: from inside, out along the axis of least depth, with that component turned
/// outwards.
void push_out_of_box(const Box& box, ObstacleState& disc) {
  const Eigen::Vector2d to_low = disc.position_world - box.low + Eigen::Vector2d::Constant(disc.radius);
  const Eigen::Vector2d to_high = box.high - disc.position_world + Eigen::Vector2d::Constant(disc.radius);
  if (to_low.minCoeff() <= 0.0 || to_high.minCoeff() <= 0.0) return;
  const double depth_x = std::min(to_low.x(), to_high.x());
  const double depth_y = std::min(to_low.y(), to_high.y());
  const int axis = depth_x <= depth_y ? 0 : 1;
  if (to_low[axis] <= to_high[axis]) {
    disc.position_world[axis] -= to_low[axis];
    disc.velocity_world[axis] = -std::abs(disc.velocity_world[axis]);
  } else {
    disc.position_world[axis] += to_high[axis];
    disc.velocity_world[axis] = std::abs(disc.velocity_world[axis]);
  }
}

/// Likewise from a point of a static shape, to a distance `gap` (our addition: the families have boxes only).
void push_away_from(const Eigen::Vector2d& point, double gap, ObstacleState& disc) {
  const Eigen::Vector2d away = disc.position_world - point;
  const double distance = away.norm();
  if (distance >= gap || distance == 0.0) return;
  const Eigen::Vector2d normal = away / distance;
  disc.position_world = point + gap * normal;
  const double inwards = std::min(disc.velocity_world.dot(normal), 0.0);
  disc.velocity_world -= 2.0 * inwards * normal;
}

/// Likewise from the surfaces around it. The nearest point of all is the one that it touches; in a corner
/// there is another one then.
void push_away_from(const Outlines& outlines, ObstacleState& disc) {
  constexpr int kMostTouched = 4;
  for (int i = 0; i < kMostTouched; ++i) {
    const std::optional<Eigen::Vector2d> point = outlines.nearest(disc.position_world, disc.radius);
    if (!point) return;
    push_away_from(*point, disc.radius, disc);
  }
}

}  // namespace

MovingObstacles::MovingObstacles(const Scenario& scenario)
    : border_{scenario.border},
      boxes_{scenario.boxes},
      discs_{scenario.discs},
      walls_{scenario.walls},
      outlines_{scenario},
      noise_{scenario.simulation.noise},
      random_{noise_seed(scenario)},
      now_{scenario.moving},
      next_{scenario.moving} {}

void MovingObstacles::change_shapes(const Scenario& scenario) {
  border_ = scenario.border;
  boxes_ = scenario.boxes;
  discs_ = scenario.discs;
  walls_ = scenario.walls;
  outlines_ = Outlines{scenario};
}

void MovingObstacles::place(std::size_t index, const Eigen::Vector2d& position) {
  now_[index].position_world = next_[index].position_world = position;
}

void MovingObstacles::advance() {
  std::swap(now_, next_);
  const double velocity_sigma = std::sqrt(noise_.level * noise_.scale * kVelocityVariance);
  const double position_sigma = std::sqrt(noise_.level * noise_.scale * kPositionVariance);
  for (std::size_t i = 0; i < now_.size(); ++i) {
    const Eigen::Vector2d velocity_noise = velocity_sigma * random_.normal2();
    const Eigen::Vector2d position_noise = position_sigma * random_.normal2();
    ObstacleState& disc = next_[i];
    disc = now_[i];
    Eigen::Vector2d velocity = disc.velocity_world + velocity_noise;
    if (noise_.model == NoiseModel::walk) {
      const double speed = velocity.norm();
      if (speed > noise_.speed_limit) velocity *= noise_.speed_limit / speed;
      disc.velocity_world = velocity;
    }
    disc.position_world += velocity * kStep + position_noise;
    if (border_) reflect_at_border(*border_, disc);
    for (const Box& box : boxes_) push_out_of_box(box, disc);
    for (const Disc& fixed : discs_) push_away_from(fixed.center, fixed.radius + disc.radius, disc);
    for (const Segment& wall : walls_)
      push_away_from(nearest_on_segment(disc.position_world, wall), disc.radius, disc);
    push_away_from(outlines_, disc);
  }
}

}  // namespace spf::sim
