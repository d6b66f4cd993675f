#include "report/chart_svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <regex>
#include <string>
#include <vector>

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
  const std::regex line{"cy=\"([0-9.]+)\"[^|]*cy=\"([0-9.]+)\""};
  std::smatch match;
  ASSERT_TRUE(std::regex_search(svg, match, line));
  EXPECT_LT(std::stod(match[1]), std::stod(match[2]));  // 90 % above 50 %: y points down
}

/// Points [px] that the chart's n-th path visits, without its marks.
std::vector<ChartPoint> visited(const std::string& svg, int which) {
  std::size_t at = svg.find(" d=\"");
  for (; which > 0; --which) at = svg.find(" d=\"", at + 1);
  const std::string data = svg.substr(at + 4, svg.find('"', at + 4) - at - 4);
  std::vector<ChartPoint> points;
  double x = 0.0, y = 0.0;
  const std::regex pair{"(-?[0-9]+)[ ]?(-[0-9]+|[0-9]+)"};
  for (std::sregex_iterator i{data.begin(), data.end(), pair}, end; i != end; ++i) {
    x += 0.5 * std::stod((*i)[1]);
    y += 0.5 * std::stod((*i)[2]);
    points.push_back({x, y});
  }
  return points;
}

LineChart in_page(std::vector<ChartPoint> points) {
  LineChart chart;
  chart.title = "<name>";
  chart.x = {"time [s]", false, false, 0.0, 10.0};
  chart.y = {"speed [m/s]", false, false, -1.0, 1.0};
  chart.series = {{"named", 0, std::move(points), SeriesLook::line}};
  chart.in_page = true;
  return chart;
}

TEST(LineChart, LeavesGapsWhereNothingIsKnown) {
  const std::string svg = line_chart(in_page({{0.0, 0.0}, {1.0, 0.5}, {2.0, kNan}, {3.0, 0.5}, {4.0, 0.0}}));
  EXPECT_TRUE(std::regex_search(svg, std::regex{" d=\"m[^m\"]+m[^m\"]+\""}));
  EXPECT_EQ(visited(svg, 0).size(), 4U);
}

TEST(LineChart, SpansItsAreaInAPageThatHasHeadingAndLegend) {
  const std::string svg = line_chart(in_page({{0.0, -0.5}, {5.0, 0.5}, {10.0, -0.5}}));
  EXPECT_THAT(svg, HasSubstr("aria-label=\"&lt;name&gt;\""));
  EXPECT_EQ(count_of(svg, "name"), 1);
  std::smatch area;
  ASSERT_TRUE(std::regex_search(
      svg, area,
      std::regex{"x=\"([0-9.]+)\" y=\"[0-9.]+\" width=\"([0-9.]+)\" height=\"[0-9.]+\" class=\"area\""}));
  const std::vector<ChartPoint> drawn = visited(svg, 0);
  ASSERT_EQ(drawn.size(), 3U);
  EXPECT_DOUBLE_EQ(drawn.front().x, std::stod(area[1]));
  EXPECT_DOUBLE_EQ(drawn.back().x, std::stod(area[1]) + std::stod(area[2]));
}

TEST(LineChart, ThinsALongLineToItsPixelsAndKeepsThePeak) {
  std::vector<ChartPoint> points;
  for (int i = 0; i <= 100000; ++i) points.push_back({1e-4 * i, i % 2 == 0 ? 0.1 : -0.1});
  points[54321].y = 0.9;
  const std::string svg = line_chart(in_page(points));
  const std::vector<ChartPoint> drawn = visited(svg, 0);
  EXPECT_LE(drawn.size(), 4U * 311U);
  double top = 1e9, bottom = -1e9;
  for (const ChartPoint& point : drawn) {
    top = std::min(top, point.y);
    bottom = std::max(bottom, point.y);
  }
  EXPECT_GT(bottom - top, 4.5 * (visited(line_chart(in_page({{0.0, -0.1}, {5.0, 0.1}})), 0)[0].y -
                                 visited(line_chart(in_page({{0.0, -0.1}, {5.0, 0.1}})), 0)[1].y));
}

TEST(LineChart, ScattersDotsAndCrosses) {
  LineChart chart = in_page({{2.0, 0.0}, {4.0, kNan}, {6.0, 0.5}});
  chart.series[0].look = SeriesLook::dots;
  EXPECT_EQ(count_of(line_chart(chart), "h0"), 2);
  chart.series[0].look = SeriesLook::crosses;
  const std::string svg = line_chart(chart);
  EXPECT_EQ(count_of(svg, "l12 12m0-12l-12 12"), 2);
  EXPECT_THAT(svg, Not(HasSubstr("h0")));
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
