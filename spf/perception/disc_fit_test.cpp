#include "spf/perception/disc_fit.hpp"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "spf/perception/test/scan_scene.hpp"

namespace spf {
namespace {

struct Sample {
  RangeScan scan;
  SensorSweep sweep;
  std::vector<ScanReturn> returns;
  DiscFitProblem problem;
};

/// One disc, seen whole from the origin; tangents half a beam beside the outermost returns.
void sample_disc(const SceneDisc& disc, RandomStream& random, Sample& sample) {
  ScanScene scene;
  scene.discs = {disc};
  scene.scan(sample.sweep, sample.scan, random);
  collect_returns(sample.sweep, sample.returns);
  sample.problem.returns = sample.returns.data();
  sample.problem.count = static_cast<int>(sample.returns.size());
  const double sigma = disc.centre.norm() * sample.scan.angle_increment / std::sqrt(12.0) + 0.005;
  sample.problem.tangents[0] = {sample.sweep.ray(sample.returns.front().beam - 0.5), 1.0, sigma};
  sample.problem.tangents[1] = {sample.sweep.ray(sample.returns.back().beam + 0.5), -1.0, sigma};
}

/// The sum that the fit minimises, written down once more.
double cost_at(const DiscFitProblem& problem, const Eigen::Vector3d& x) {
  double cost = std::pow((x.z() - problem.prior_radius) / problem.prior_radius_sigma, 2);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int k = 0; k < problem.count; ++k) {
    const Eigen::Vector2d& p = problem.returns[k].position_world;
    mean += p / problem.count;
    cost += std::pow((std::hypot(p.x() - x.x(), p.y() - x.y()) - x.z()) / problem.range_sigma, 2);
  }
  for (const TangentRay& tangent : problem.tangents) {
    const Eigen::Vector2d o = tangent.ray.origin_world;
    const Eigen::Vector2d d = tangent.ray.direction_world;
    const double gap = tangent.side * (d.x() * (x.y() - o.y()) - d.y() * (x.x() - o.x()));
    if (tangent.side != 0.0) cost += std::pow((gap - x.z()) / tangent.sigma, 2);
  }
  const Eigen::Vector2d away = (mean - problem.sensor_world).normalized();
  if (away.dot(x.head<2>() - mean) < 0.0) return 1e9;  // bent the wrong way: nobody sees the inside of a disc
  const double beside = away.x() * (x.y() - mean.y()) - away.y() * (x.x() - mean.x());
  return cost + std::pow(beside / problem.prior_radius, 2);
}

/// Compass search: no derivatives, nothing in common with the fit.
Eigen::Vector3d search_minimum(const DiscFitProblem& problem, Eigen::Vector3d best) {
  double cost = cost_at(problem, best);
  for (double step = 0.1; step > 1e-8; step *= 0.5) {
    bool better = true;
    while (better) {
      better = false;
      for (int direction = 0; direction < 26; ++direction) {
        const int code = direction < 13 ? direction : direction + 1;
        const Eigen::Vector3d offset(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
        const Eigen::Vector3d next = best + step * offset;
        const double there = cost_at(problem, next);
        if (there >= cost) continue;
        best = next;
        cost = there;
        better = true;
      }
    }
  }
  return best;
}

TEST(DiscFit, FindsTheMinimumThatAGenericSearchFinds) {
  RandomStream random{5};
  Sample sample;
  for (int round = 0; round < 100; ++round) {
    const double bearing = random.uniform(-3.0, 3.0);
    const double distance = random.uniform(1.5, 7.0);
    sample_disc({distance * Eigen::Vector2d{std::cos(bearing), std::sin(bearing)}, random.uniform(0.1, 0.6)},
                random, sample);
    if (random.uniform() < 0.3) sample.problem.tangents[0].side = 0.0;
    const DiscFit fit = fit_disc(sample.problem);
    const Eigen::Vector3d found(fit.centre_world.x(), fit.centre_world.y(), fit.radius);
    const Eigen::Vector3d best = search_minimum(sample.problem, found + Eigen::Vector3d(0.03, -0.02, 0.04));
    // 0.1 mm: a fifth of a hundredth of the noise. The fit stops where steps fall below it.
    EXPECT_LT((found - best).norm(), 1e-4)
        << "round " << round << " n " << sample.problem.count << " found " << found.transpose() << " best "
        << best.transpose() << " costs " << cost_at(sample.problem, found) << " "
        << cost_at(sample.problem, best) << " mean " << sample.problem.returns[0].position_world.transpose();
    EXPECT_LT(cost_at(sample.problem, found), cost_at(sample.problem, best) + 1e-3);
  }
}

TEST(DiscFit, SaysHowUncertainItIs) {
  RandomStream random{6};
  Sample sample;
  const SceneDisc disc{{3.0, 2.0}, 0.4};
  constexpr int kRounds = 400;
  double normalised = 0.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    sample_disc(disc, random, sample);
    sample.problem.prior_radius = disc.radius + 0.15 * random.normal();
    const DiscFit fit = fit_disc(sample.problem);
    const Eigen::Vector2d error = fit.centre_world - disc.centre;
    mean += error / kRounds;
    normalised += error.dot(fit.covariance.topLeftCorner<2, 2>().inverse() * error) / kRounds;
  }
  // Chi-square of two degrees has mean 2; the model is cautious where beams graze, so less is allowed.
  EXPECT_LT(normalised, 2.5);
  EXPECT_GT(normalised, 0.4);
  EXPECT_LT(mean.norm(), 0.02);
}

TEST(DiscFit, OfOneReturnRestsOnWhatIsExpected) {
  const ScanReturn single{0, 3.0, {3.0, 0.0}};
  DiscFitProblem problem;
  problem.returns = &single;
  problem.count = 1;
  const DiscFit fit = fit_disc(problem);
  EXPECT_LT((fit.centre_world - Eigen::Vector2d{3.3, 0.0}).norm(), 0.05);
  EXPECT_NEAR(fit.radius, 0.3, 0.02);
  EXPECT_NEAR(std::sqrt(fit.covariance(1, 1)), 0.3, 0.03);   // beside the beam: anywhere within the disc
  EXPECT_NEAR(std::sqrt(fit.covariance(2, 2)), 0.15, 0.01);  // as expected beforehand
}

}  // namespace
}  // namespace spf
