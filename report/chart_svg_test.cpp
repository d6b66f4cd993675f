#include "report/chart_svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <regex>

namespace spf {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++count;
  return count;
}

LineChart rising() {
  LineChart chart;
  chart.title = "a <b> & c";
  chart.x = {"level [Sigma]"};
  chart.y = {"success [%]", false, false, 0.0, 100.0};
  chart.series = {{"first", 0, {{0.0, 90.0, 80.0, 95.0}, {1.0, 50.0, 40.0, 60.0}, {2.0, kNan}}},
                  {"second", 1, {{0.0, 20.0}}}};
  return chart;
}

TEST(LineChart, DrawsEveryKnownPointAndItsInterval) {
  const std::string svg = line_chart(rising());
  EXPECT_EQ(count_of(svg, "<circle"), 2 + 1);  // two points and the legend; the third is not known
  EXPECT_EQ(count_of(svg, "stroke-width=\"1.5\""), 2);
  EXPECT_THAT(svg, HasSubstr("a &lt;b&gt; &amp; c"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(LineChart, PutsHigherValuesHigher) {
  const std::string svg = line_chart(rising());
  const std::regex line{"polyline points=\"[0-9.]+,([0-9.]+) [0-9.]+,([0-9.]+)\""};
  std::smatch match;
  ASSERT_TRUE(std::regex_search(svg, match, line));
  EXPECT_LT(std::stod(match[1]), std::stod(match[2]));  // 90 % above 50 %: y points down
}

TEST(LineChart, SurvivesChartsWithoutValues) {
  LineChart chart = rising();
  for (ChartSeries& series : chart.series) series.points.clear();
  EXPECT_THAT(line_chart(chart), HasSubstr("</svg>"));
  chart.series.clear();
  EXPECT_THAT(line_chart(chart), Not(HasSubstr("nan")));
}

TEST(RowChart, DrawsWhatItsRowsKnow) {
  RowChart chart{"times", RowKind::box, {"time [s]"}, {}};
  chart.rows.push_back({"known", "n = 5", 0, {1.0, 2.0, 3.0, 4.0, 5.0}, kNan, kNan, {}, {}});
  chart.rows.push_back({"unknown", "", 1, {}, kNan, kNan, {}, {}});
  EXPECT_EQ(count_of(row_chart(chart), "<rect"), 1);
  chart.kind = RowKind::bar;
  chart.x.logarithmic = true;
  chart.rows[1].bar = 20.0;
  chart.rows[1].whisker = 300.0;
  const std::string bars = row_chart(chart);
  EXPECT_EQ(count_of(bars, "<rect"), 1);
  EXPECT_THAT(bars, HasSubstr(">100</text>"));  // a decade's tick
}

// The areas of bins are shares: the highest bin reaches the full height, half of it half.
TEST(RowChart, ScalesHistogramsToTheirHighestBin) {
  RowChart chart{"histogram", RowKind::histogram, {"time [us]", true}, {}};
  chart.rows.push_back({"row", "", 0, {}, kNan, kNan, {1.0, 10.0, 100.0}, {0.5, 0.25}});
  const std::string svg = row_chart(chart);
  const std::regex polygon{
      "polygon points=\"[0-9.]+,([0-9.]+) [0-9.]+,([0-9.]+) [0-9.]+,[0-9.]+ [0-9.]+,([0-9.]+)"};
  std::smatch match;
  ASSERT_TRUE(std::regex_search(svg, match, polygon));
  const double base = std::stod(match[1]), high = std::stod(match[2]), half = std::stod(match[3]);
  EXPECT_NEAR(base - half, 0.5 * (base - high), 0.11);  // coordinates have one decimal
}

TEST(StandaloneChart, IsAFileOfItsOwn) {
  const std::string file = standalone(line_chart(rising()));
  EXPECT_THAT(file, testing::StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_THAT(file, HasSubstr("--series-1:#"));
  EXPECT_EQ(count_of(file, "<svg"), 1);
}

}  // namespace
}  // namespace spf
