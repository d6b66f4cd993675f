#include "spf/localisation/noise_meter.hpp"

#include <gtest/gtest.h>

#include "spf/math/random_stream.hpp"

namespace spf {
namespace {

/// Of a value that moves otherwise than expected by `motion` from measurement to measurement.
double measured_variance(double sigma, double motion, int measurements = 400) {
  NoiseMeter meter{100};
  RandomStream random{9};
  double last = 0.0;
  for (int i = 0; i < measurements; ++i) {
    const double measured = motion * i + sigma * random.normal();
    if (i > 0) meter.note(measured - last);
    last = measured;
  }
  return meter.variance();
}

TEST(NoiseMeter, FindsTheVarianceOfTheNoise) {
  for (const double sigma : {0.001, 0.02, 0.5})
    EXPECT_NEAR(measured_variance(sigma, 0.0) / (sigma * sigma), 1.0, 0.5) << sigma;
}

TEST(NoiseMeter, TakesNoMotionForNoise) {
  EXPECT_EQ(measured_variance(0.0, 0.0), 0.0);
  EXPECT_EQ(measured_variance(0.0, 0.01), 0.0);
  EXPECT_EQ(measured_variance(0.001, 0.01), 0.0);
}

TEST(NoiseMeter, SaysNothingBeforeItKnows) {
  NoiseMeter meter{10};
  EXPECT_EQ(meter.variance(), 0.0);
  meter.note(0.3);
  EXPECT_EQ(meter.variance(), 0.0);
  meter.note(-0.3);
  EXPECT_GT(meter.variance(), 0.0);
  meter.reset();
  EXPECT_EQ(meter.variance(), 0.0);
}

}  // namespace
}  // namespace spf
