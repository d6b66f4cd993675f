#include "spf/field/probability_field.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "spf/math/angles.hpp"
#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

struct Case {
  ObstacleState obstacle;
  double robot_radius = 0.3;
  Eigen::Vector2d query_world = Eigen::Vector2d::Zero();
};

/// Walking-size obstacles, queried within three radii, where the field matters.
Case draw_case(RandomStream& random) {
  Case drawn;
  const double x = random.uniform(-5.0, 5.0);
  const double y = random.uniform(-5.0, 5.0);
  drawn.obstacle.position_world = {x, y};
  const double vx = random.uniform(-2.0, 2.0);
  const double vy = random.uniform(-2.0, 2.0);
  drawn.obstacle.velocity_world = {vx, vy};
  drawn.obstacle.radius = random.uniform(0.1, 1.0);
  drawn.robot_radius = random.uniform(0.05, 0.5);
  const double dx = random.uniform(-3.0, 3.0);
  const double dy = random.uniform(-3.0, 3.0);
  drawn.query_world = drawn.obstacle.position_world + drawn.obstacle.radius * Eigen::Vector2d{dx, dy};
  return drawn;
}

/// Eq. 1-3 as printed, with rotation matrix and determinant spelled out.
double density_as_printed(const Case& c, const FieldParameters& parameters) {
  const Eigen::Vector2d& v = c.obstacle.velocity_world;
  const Eigen::Vector2d center =
      c.obstacle.position_world + (1.0 - parameters.attention) * v * parameters.shift_interval;
  const double a = c.obstacle.radius + c.robot_radius + v.norm() * parameters.stretch_time / 2.0;
  const double b = c.obstacle.radius + c.robot_radius;
  const double theta = std::atan(v.y() / v.x());
  Eigen::Matrix2d rotation;
  rotation << std::cos(theta), -std::sin(theta), std::sin(theta), std::cos(theta);
  const Eigen::Matrix2d sigma = rotation * Eigen::Vector2d{a * a, b * b}.asDiagonal() * rotation.transpose();
  Eigen::Matrix2d inverse;
  inverse << sigma(1, 1), -sigma(0, 1), -sigma(1, 0), sigma(0, 0);
  const double determinant = sigma(0, 0) * sigma(1, 1) - sigma(0, 1) * sigma(1, 0);
  inverse /= determinant;
  const Eigen::Vector2d d = c.query_world - center;
  return std::exp(-0.5 * d.dot(inverse * d)) / (2.0 * kPi * std::sqrt(determinant));
}

TEST(ProbabilityField, IsTheDensityOfEquations1To3) {
  RandomStream random{11};
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    const Case c = draw_case(random);
    const FieldParameters parameters;
    const double expected = density_as_printed(c, parameters);
    const ProbabilityField field{c.obstacle, c.robot_radius, parameters};
    EXPECT_NEAR(field.density(c.query_world), expected,
                1e-12 * field.density(field.center_world()));  // rounding: a few 1e-15
  }
}

TEST(ProbabilityField, IntegratesToOne) {
  ObstacleState obstacle;
  obstacle.position_world = {1.0, -2.0};
  obstacle.velocity_world = {0.8, 0.6};
  const ProbabilityField field{obstacle, 0.3, FieldParameters{}};
  // The midpoint rule on a Gaussian converges faster than any power; the window reaches 9 half axes.
  const double step = 0.1;
  double sum = 0.0;
  for (int i = -100; i < 100; ++i)
    for (int j = -100; j < 100; ++j)
      sum += field.density(field.center_world() + step * Eigen::Vector2d{i + 0.5, j + 0.5}) * step * step;
  EXPECT_NEAR(sum, 1.0, 1e-9);
}

TEST(ProbabilityField, GradientMatchesCentralDifferences) {
  RandomStream random{7};
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    const Case c = draw_case(random);
    const ProbabilityField field{c.obstacle, c.robot_radius, FieldParameters{}};
    const double step = 1e-5 * c.obstacle.radius;
    Eigen::Vector2d expected;
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d shift = step * Eigen::Vector2d::Unit(axis);
      expected[axis] =
          (field.density(c.query_world + shift) - field.density(c.query_world - shift)) / (2.0 * step);
    }
    // Relative to peak / radius, the scale of the slope: truncation is 2e-11, rounding of positions up to 8 m
    // with steps down to 1e-6 m 3e-10. Allow about 10x.
    const double scale = field.density(field.center_world()) / c.obstacle.radius;
    EXPECT_LT((field.density_gradient(c.query_world) - expected).norm(), 2e-9 * scale);
  }
}

TEST(ProbabilityField, TurnsWithTheScene) {
  RandomStream random{3};
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const Case c = draw_case(random);
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd{random.uniform(-kPi, kPi)}.toRotationMatrix();
    Case turned = c;
    turned.obstacle.position_world = turn * c.obstacle.position_world;
    turned.obstacle.velocity_world = turn * c.obstacle.velocity_world;
    turned.query_world = turn * c.query_world;
    const ProbabilityField field{c.obstacle, c.robot_radius, FieldParameters{}};
    const ProbabilityField other{turned.obstacle, c.robot_radius, FieldParameters{}};
    // Rounding of positions of a few metres.
    EXPECT_NEAR(other.mahalanobis(turned.query_world), field.mahalanobis(c.query_world), 1e-12);
    const Eigen::Vector2d side = Eigen::Vector2d::UnitX();
    const Eigen::Vector2d direction = field.escape_direction(c.query_world, side);
    EXPECT_LT((other.escape_direction(turned.query_world, turn * side) - turn * direction).norm(), 1e-11);
    EXPECT_LT((other.guide_point(turned.query_world, turn * direction, 1.4) -
               turn * field.guide_point(c.query_world, direction, 1.4))
                  .norm(),
              1e-11);
  }
}

TEST(ProbabilityField, EscapesAgainstTheGradient) {
  RandomStream random{5};
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const Case c = draw_case(random);
    const ProbabilityField field{c.obstacle, c.robot_radius, FieldParameters{}};
    const Eigen::Vector2d expected = -field.density_gradient(c.query_world).normalized();
    EXPECT_LT((field.escape_direction(c.query_world, Eigen::Vector2d::UnitX()) - expected).norm(), 1e-12);
  }
}

TEST(ProbabilityField, EscapesFromFarAwayWhereTheDensityUnderflows) {
  const ProbabilityField field{ObstacleState{}, 0.3, FieldParameters{}};
  const Eigen::Vector2d far{300.0, 400.0};
  EXPECT_EQ(field.density(far), 0.0);
  EXPECT_LT((field.escape_direction(far, Eigen::Vector2d::UnitX()) - Eigen::Vector2d{0.6, 0.8}).norm(),
            1e-15);
}

TEST(ProbabilityField, EscapesSidewaysToThePreferredSideAtTheCentre) {
  ObstacleState obstacle;
  obstacle.velocity_world = {0.0, 1.0};
  const ProbabilityField field{obstacle, 0.3, FieldParameters{}};
  const Eigen::Vector2d& center = field.center_world();
  EXPECT_EQ(field.escape_direction(center, {0.3, 5.0}), Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(field.escape_direction(center, {-0.3, 5.0}), Eigen::Vector2d(-1.0, 0.0));
}

TEST(ProbabilityField, GuidePointsLieOnTheEllipseAhead) {
  RandomStream random{13};
  int inside = 0;
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    const Case c = draw_case(random);
    const ProbabilityField field{c.obstacle, c.robot_radius, FieldParameters{}};
    const double angle = random.uniform(-kPi, kPi);
    const Eigen::Vector2d direction{std::cos(angle), std::sin(angle)};
    const Eigen::Vector2d guide = field.guide_point(c.query_world, direction, field.threshold());
    if (field.mahalanobis(c.query_world) >= field.threshold()) {
      EXPECT_EQ(guide, c.query_world);
      continue;
    }
    ++inside;
    EXPECT_NEAR(field.mahalanobis(guide), field.threshold(), 1e-12);
    EXPECT_GE((guide - c.query_world).dot(direction), 0.0);
    EXPECT_NEAR((guide - c.query_world).norm(), (guide - c.query_world).dot(direction), 1e-12);
  }
  EXPECT_GT(inside, 200);
}

TEST(ProbabilityField, DefaultThresholdIsTheSmallestEllipseThatHoldsBothDiscs) {
  RandomStream random{17};
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    Case c = draw_case(random);
    FieldParameters parameters;
    if (i % 3 == 1) parameters.attention = random.uniform();  // centre off the middle of the two discs
    if (i % 3 == 2) parameters.stretch_time = random.uniform(0.0, 3.0);
    const ProbabilityField field{c.obstacle, c.robot_radius, parameters};
    const double radius = c.obstacle.radius + c.robot_radius;
    double largest = 0.0;
    for (const double ahead : {0.0, parameters.stretch_time}) {
      const Eigen::Vector2d center = c.obstacle.position_world + ahead * c.obstacle.velocity_world;
      for (int k = 0; k < 20000; ++k) {
        const double angle = 2.0 * kPi * k / 20000.0;
        largest = std::max(
            largest, field.mahalanobis(center + radius * Eigen::Vector2d{std::cos(angle), std::sin(angle)}));
      }
    }
    EXPECT_NEAR(field.threshold(), largest, 1e-6);  // brute force: 2e4 points, quadratic error about 1e-7
  }
}

TEST(ProbabilityField, DefaultThresholdIsAsThePaperNotesSay) {
  const auto threshold = [](double radius, double speed) {
    ObstacleState obstacle;
    obstacle.radius = radius / 2.0;
    obstacle.velocity_world = {speed, 0.0};
    return ProbabilityField{obstacle, radius / 2.0, FieldParameters{}}.threshold();
  };
  EXPECT_NEAR(threshold(0.3, 1.0), 1.27, 0.005);  // ends of the range 1.08-1.27 for r 0.3-0.7 m at 0.3-1 m/s
  EXPECT_NEAR(threshold(0.7, 0.3), 1.08, 0.005);
}

TEST(ProbabilityField, IsRoundAtRestAndContinuousTowardsIt) {
  ObstacleState obstacle;
  obstacle.radius = 0.4;
  const ProbabilityField resting{obstacle, 0.3, FieldParameters{}};
  EXPECT_EQ(resting.half_axis_along(), resting.half_axis_across());
  EXPECT_EQ(resting.threshold(), 1.0);
  EXPECT_EQ(resting.center_world(), obstacle.position_world);
  for (const double angle : {0.3, 1.9, -2.2}) {
    obstacle.velocity_world = 1e-4 * Eigen::Vector2d{std::cos(angle), std::sin(angle)};
    const ProbabilityField creeping{obstacle, 0.3, FieldParameters{}};
    const Eigen::Vector2d query{0.5, -0.2};
    EXPECT_NEAR(creeping.mahalanobis(query), resting.mahalanobis(query), 2e-4);  // first order in the speed
    EXPECT_NEAR(creeping.threshold(), 1.0, 2e-4);
  }
}

TEST(ProbabilityField, IsRoundAndUnshiftedWithoutDirection) {
  ObstacleState obstacle;
  obstacle.velocity_world = {1.0, 0.5};
  FieldParameters parameters;
  parameters.directional = false;
  const ProbabilityField field{obstacle, 0.3, parameters};
  EXPECT_EQ(field.center_world(), obstacle.position_world);
  EXPECT_EQ(field.half_axis_along(), field.half_axis_across());
}

TEST(ProbabilityField, ClearanceIsASafeDistanceToTheEllipse) {
  RandomStream random{19};
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const Case c = draw_case(random);
    const ProbabilityField field{c.obstacle, c.robot_radius, FieldParameters{}};
    const FieldEllipse ellipse = field.ellipse(field.threshold());
    const Eigen::Rotation2Dd turn{ellipse.heading};
    double nearest = 1e9;
    for (int k = 0; k < 5000; ++k) {
      const double angle = 2.0 * kPi * k / 5000.0;
      const Eigen::Vector2d rim{ellipse.half_axes.x() * std::cos(angle),
                                ellipse.half_axes.y() * std::sin(angle)};
      nearest = std::min(nearest, (ellipse.center_world + turn * rim - c.query_world).norm());
    }
    const double clearance = field.clearance(c.query_world, field.threshold());
    EXPECT_LE(std::abs(clearance), nearest + 1e-9);
    EXPECT_EQ(clearance < 0.0, field.mahalanobis(c.query_world) < field.threshold());
  }
}

TEST(FieldParameters, RefusesWhatIsOutOfRange) {
  FieldParameters parameters;
  EXPECT_TRUE(problems(parameters).empty());
  parameters.attention = 1.5;
  parameters.stretch_time = std::nan("");
  EXPECT_EQ(problems(parameters).size(), 2U);
  EXPECT_THROW((void)validated(parameters), std::invalid_argument);
}

}  // namespace
}  // namespace spf
