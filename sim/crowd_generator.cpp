#include "sim/crowd_generator.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/walker.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::sim {
namespace {

constexpr double kStep = 0.1;      // [s]
constexpr double kBodies = 0.5;    // [m] centres of two people who touch
constexpr double kEntryGap = 0.9;  // [m] from others to an entering person
constexpr double kPairGap = 0.7;   // [m] between the two of a pair

struct Walker : Body {
  int id = 0;
  Eigen::Vector2d goal;                 // [m]
  double wanted_speed = 1.3;            // [m/s]
  std::optional<Eigen::Vector2d> stop;  // [m] where to stop on the way
  double stop_left = 0.0;               // [s]
  [[nodiscard]] bool standing() const { return !stop && stop_left > 0.0; }
};

class Plaza {
 public:
  Plaza(const CrowdGeneratorParameters& parameters, std::uint64_t seed)
      : parameters_{parameters}, random_{mix(seed, 0x43524F5744ULL)} {
    // Little's law: people at once = arrivals a second x time of a stay.
    const double path = 0.9 * 0.5 * (parameters_.width + parameters_.height);
    const double stay = path / parameters_.speed + parameters_.stops * 0.6 * parameters_.longest_stop;
    const double arrivals = parameters_.people / stay / (1.0 + parameters_.pairs);
    arrival_chance_ = 1.0 - std::exp(-arrivals * kStep);
  }

  void step() {
    if (random_.uniform() < arrival_chance_) ++waiting_;
    if (waiting_ > 0 && arrive()) --waiting_;
    move();
  }

  /// Ids start at the first sample, so that people who left before it leave no gap.
  void record(double time, std::vector<CrowdSample>& samples) {
    for (Walker& walker : walkers_) {
      if (walker.id == 0) walker.id = ++last_id_;
      samples.push_back({time, walker.id, walker.position});
    }
  }

 private:
  Eigen::Vector2d on_side(int side, double share) const {
    const Eigen::Vector2d size{parameters_.width, parameters_.height};
    const int axis = side < 2 ? 0 : 1;
    Eigen::Vector2d position = share * size;
    position[axis] = side % 2 == 0 ? 0.0 : size[axis];
    return position;
  }

  bool is_free(const Eigen::Vector2d& position) const {
    return std::none_of(walkers_.begin(), walkers_.end(), [&](const Walker& walker) {
      return (walker.position - position).norm() < kEntryGap;
    });
  }

  /// One or two people enter at a side and head for another, mostly the opposite one. False when the entry is
  /// occupied.
  bool arrive() {
    const int side = static_cast<int>(4.0 * random_.uniform());
    const bool straight = random_.uniform() < 0.6;
    const int turn = random_.uniform() < 0.5 ? 2 : 3;
    const int leaving = straight ? (side ^ 1) : (side < 2 ? turn : turn - 2);
    Walker walker;
    walker.position = on_side(side, random_.uniform(0.1, 0.9));
    walker.goal = on_side(leaving, random_.uniform(0.1, 0.9));
    walker.wanted_speed = std::clamp(parameters_.speed + parameters_.speed_sigma * random_.normal(),
                                     0.5 * parameters_.speed, 1.6 * parameters_.speed);
    const bool pair = random_.uniform() < parameters_.pairs;
    const bool stops = random_.uniform() < parameters_.stops;
    const double stop_at = random_.uniform(0.3, 0.7);
    const double stop_for = random_.uniform(0.2, 1.0) * parameters_.longest_stop;
    if (stops) {
      walker.stop = walker.position + stop_at * (walker.goal - walker.position);
      walker.stop_left = stop_for;
    }
    const Eigen::Vector2d ahead = (walker.goal - walker.position).normalized();
    walker.velocity = walker.wanted_speed * ahead;
    const Eigen::Vector2d beside = kPairGap * Eigen::Vector2d{-ahead.y(), ahead.x()};
    if (!is_free(walker.position) || (pair && !is_free(walker.position + beside))) return false;
    walkers_.push_back(walker);
    if (!pair) return true;
    walker.position += beside;
    walker.goal += beside;
    if (walker.stop) *walker.stop += beside;
    walkers_.push_back(walker);
    return true;
  }

  Eigen::Vector2d wanted_velocity(Walker& walker) const {
    if (walker.stop && (*walker.stop - walker.position).norm() < 0.4) walker.stop.reset();
    if (walker.standing()) {
      walker.stop_left -= kStep;
      return Eigen::Vector2d::Zero();
    }
    return walker.wanted_speed * (walker.stop.value_or(walker.goal) - walker.position).normalized();
  }

  void move() {
    std::vector<Eigen::Vector2d> accelerations;
    for (Walker& walker : walkers_) {
      Eigen::Vector2d acceleration = (wanted_velocity(walker) - walker.velocity) / kWalkerRelaxation;
      for (const Walker& other : walkers_)
        if (&other != &walker) acceleration += avoidance(walker, other, kBodies, walker.standing());
      accelerations.push_back(within_strength(acceleration));
    }
    for (std::size_t i = 0; i < walkers_.size(); ++i)
      advance(walkers_[i], accelerations[i], walkers_[i].wanted_speed, kStep);
    walkers_.erase(std::remove_if(walkers_.begin(), walkers_.end(),
                                  [this](const Walker& walker) { return has_left(walker); }),
                   walkers_.end());
  }

  /// Beyond a side, or at its goal. Entering people may start slightly outside.
  [[nodiscard]] bool has_left(const Walker& walker) const {
    constexpr double kOutside = 1.0;  // [m]
    const Eigen::Vector2d size{parameters_.width, parameters_.height};
    const double inside = std::min(walker.position.minCoeff(), (size - walker.position).minCoeff());
    return inside < -kOutside || (walker.goal - walker.position).norm() < 0.3;
  }

  CrowdGeneratorParameters parameters_;
  RandomStream random_;
  double arrival_chance_ = 0.0;  // in a step
  int waiting_ = 0;              // arrivals that found no free entry yet
  int last_id_ = 0;
  std::vector<Walker> walkers_;
};

}  // namespace

std::vector<CrowdSample> generate_crowd(const CrowdGeneratorParameters& parameters, std::uint64_t seed) {
  const CrowdGeneratorParameters checked = validated(parameters);
  Plaza plaza{checked, seed};
  const double filling = 3.0 * (checked.width + checked.height) / checked.speed;  // [s] until steady
  for (int i = 0; i < static_cast<int>(filling / kStep); ++i) plaza.step();
  const int steps = static_cast<int>(std::floor(checked.duration / kStep + 1e-9));
  const int every = std::max(1, static_cast<int>(std::lround(checked.sample_interval / kStep)));
  std::vector<CrowdSample> samples;
  for (int i = 0; i <= steps; ++i) {
    if (i % every == 0) plaza.record(i * kStep, samples);
    plaza.step();
  }
  return samples;
}

}  // namespace spf::sim
