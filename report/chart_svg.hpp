// Charts as SVG: values against levels with intervals, quantile boxes, histograms, bars, and profiles over
// time. Colours are the palette's CSS variables, so a chart inside a page follows its theme; standalone()
// makes a file of its own out of one. Series differ by colour, dash and marker. Values that are not finite
// are gaps. Lines are thinned to what can be seen, so series may be long.
#pragma once

#include <string>
#include <vector>

namespace spf {

/// An axis; without low and high it spans the values.
struct ChartAxis {
  std::string label;  ///< with its unit
  bool logarithmic = false;
  bool from_zero = false;  ///< a linear axis begins at 0
  double low = 0.0, high = 0.0;
};

struct ChartPoint {
  double x = 0.0, y = 0.0;
  double low = 0.0, high = 0.0;  ///< of the interval around y; drawn where low < high
};
enum class SeriesLook { line_and_markers, line, dots, crosses };
struct ChartSeries {
  std::string name;
  int style = 0;  ///< series of equal style look alike
  std::vector<ChartPoint> points;
  SeriesLook look = SeriesLook::line_and_markers;
};
/// A horizontal line with its name, such as a limit.
struct ChartLimit {
  std::string name;
  double y = 0.0;
};
struct LineChart {
  std::string title;
  ChartAxis x, y;
  std::vector<ChartSeries> series;
  std::vector<ChartLimit> limits;
  /// For a page that writes heading and legend itself: smaller, without them. The x axis then spans exactly
  /// the rectangle of class "area".
  bool in_page = false;
};
[[nodiscard]] std::string line_chart(const LineChart& chart);

/// One row of a chart whose rows share their axis: what is filled in is drawn.
struct ChartRow {
  std::string label;
  std::string note;  ///< behind the label, quieter
  int style = 0;
  /// Quantiles 5, 25, 50, 75, 95 %: a box with whiskers. Empty: none.
  std::vector<double> quantiles;
  /// A bar up to here, and a whisker up to there. Not finite: none.
  double bar = 0.0, whisker = 0.0;
  /// A histogram: left edges, one more than the shares; shares of each bin.
  std::vector<double> edges, shares;
};
enum class RowKind { box, bar, histogram };
struct RowChart {
  std::string title;
  RowKind kind = RowKind::box;
  ChartAxis x;
  std::vector<ChartRow> rows;
};
[[nodiscard]] std::string row_chart(const RowChart& chart);

/// The chart as a file: namespace, colours for light and dark.
[[nodiscard]] std::string standalone(const std::string& chart);

}  // namespace spf
