#include "report/palette.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace spf {
namespace {

using Rgb = std::array<double, 3>;

/// Linear light of #rrggbb (sRGB).
Rgb linear(std::string_view hex) {
  Rgb rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = std::stoi(std::string{hex.substr(1 + 2 * i, 2)}, nullptr, 16) / 255.0;
    rgb[i] = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  }
  return rgb;
}

/// Contrast of WCAG 2.
double contrast(std::string_view a, std::string_view b) {
  const auto luminance = [](std::string_view hex) {
    const Rgb c = linear(hex);
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  };
  const double one = luminance(a) + 0.05;
  const double other = luminance(b) + 0.05;
  return std::max(one, other) / std::min(one, other);
}

void expect_contrast(std::string_view front, std::string_view back, double least) {
  const PaletteColor& a = palette_color(front);
  const PaletteColor& b = palette_color(back);
  EXPECT_GE(contrast(a.light, b.light), least) << front << " on " << back << ", light";
  EXPECT_GE(contrast(a.dark, b.dark), least) << front << " on " << back << ", dark";
}

TEST(Palette, TextReachesAaContrast) {
  for (const char* back : {"page", "panel", "raised"}) {
    for (const char* front : {"text", "muted", "accent", "good", "bad", "caution"})
      expect_contrast(front, back, 4.5);
  }
  expect_contrast("on-accent", "accent", 4.5);
  for (int i = 0; i < kRobotColors; ++i) expect_contrast("on-accent", robot_color(i).name, 4.5);
  for (const char* label : {"obstacle", "limit", "robot-0", "robot-1", "robot-2", "robot-3", "robot-4"})
    expect_contrast(label, "panel", 4.5);
}

TEST(Palette, MarksReachThreeToOne) {
  for (const char* mark : {"control", "wall", "perceived", "series-0", "series-1", "series-2"})
    expect_contrast(mark, "panel", 3.0);
}

/// Seen with red-blind or green-blind eyes: Machado, Oliveira and Fernandes 2009, severity 1, in linear
/// light.
Rgb seen(const Rgb& c, const std::array<std::array<double, 3>, 3>& matrix) {
  Rgb result{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) result[row] += matrix[row][column] * c[column];
    result[row] = std::clamp(result[row], 0.0, 1.0);
  }
  return result;
}

/// Distance in CIE L*a*b* (1976), white D65.
double difference(const Rgb& a, const Rgb& b) {
  const auto lab = [](const Rgb& c) {
    const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
    const double x = f((0.4124 * c[0] + 0.3576 * c[1] + 0.1805 * c[2]) / 0.9505);
    const double y = f(0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]);
    const double z = f((0.0193 * c[0] + 0.1192 * c[1] + 0.9505 * c[2]) / 1.089);
    return Rgb{116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
  };
  const Rgb p = lab(a);
  const Rgb q = lab(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

TEST(Palette, LinesOfOneChartStayApartForColourBlindEyes) {
  const std::array<std::array<double, 3>, 3> red_blind{
      {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};
  const std::array<std::array<double, 3>, 3> green_blind{
      {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};
  // 2.3 is just noticeable; 12 is plain at a glance. Robots against the obstacles, the lines of a chart among
  // themselves.
  const std::vector<std::pair<std::string, std::string>> pairs{
      {"series-0", "series-1"}, {"series-1", "series-2"}, {"series-0", "series-2"}, {"robot-0", "obstacle"},
      {"robot-2", "obstacle"},  {"robot-3", "obstacle"},  {"robot-4", "obstacle"},  {"robot-0", "robot-1"},
      {"robot-1", "robot-2"},   {"robot-3", "robot-4"}};
  for (const auto& matrix : {red_blind, green_blind}) {
    for (const auto& [first, second] : pairs) {
      const PaletteColor& a = palette_color(first);
      const PaletteColor& b = palette_color(second);
      EXPECT_GT(difference(seen(linear(a.light), matrix), seen(linear(b.light), matrix)), 12.0)
          << first << " " << second << ", light";
      EXPECT_GT(difference(seen(linear(a.dark), matrix), seen(linear(b.dark), matrix)), 12.0)
          << first << " " << second << ", dark";
    }
  }
}

TEST(Palette, DeclaresEachColourOnceAndBothThemes) {
  std::set<std::string_view> names;
  for (const PaletteColor& color : kPalette) EXPECT_TRUE(names.insert(color.name).second) << color.name;
  EXPECT_THAT(palette_css(), testing::HasSubstr(":root[data-theme=dark]{color-scheme:dark;--page:#"));
  EXPECT_THROW((void)palette_color("mauve"), std::out_of_range);
  EXPECT_EQ(robot_color(kRobotColors + 1).name, "robot-1");
  EXPECT_EQ(robot_color(-1).name, "robot-4");
}

}  // namespace
}  // namespace spf
