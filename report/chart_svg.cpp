#include "report/chart_svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "report/html_text.hpp"
#include "report/palette.hpp"
#include "report/polyline.hpp"
#include "report/table.hpp"

namespace spf {
namespace {

/// Width of a chart, edges of its plotting area, and what line charts keep free inside of it [px].
struct Layout {
  double width, left, right, top, bottom, aside, above;
};
constexpr Layout kFile{460.0, 46.0, 446.0, 44.0, 250.0, 12.0, 0.0};
constexpr Layout kPage{370.0, 46.0, 356.0, 24.0, 164.0, 0.0, 8.0};
constexpr double kRowsTop = 30.0;
constexpr double kPathUnits = 2.0;  // [1/px] paths are whole numbers of half pixels: short, and fine enough
constexpr double kPathTolerance = 0.5;  // [half px] by which a line may be thinned

struct SeriesStyle {
  const char* color;
  const char* dash;  // [half px]
};
constexpr std::array<SeriesStyle, 8> kStyles{{{"robot-0", ""},
                                              {"series-1", "14 6"},
                                              {"robot-3", "4 6"},
                                              {"robot-2", "18 6 4 6"},
                                              {"robot-1", "24 8"},
                                              {"robot-4", "10 4"},
                                              {"bad", "6 12"},
                                              {"text", "2 4"}}};
const SeriesStyle& style_of(int index) {
  return kStyles[static_cast<std::size_t>(std::max(index, 0)) % kStyles.size()];
}
std::string color_of(int index) {
  return std::string{"var(--"} + style_of(index).color + ")";
}

std::string px(double value) {
  return fixed(value, 1);
}
std::string tick_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", std::abs(value) < 1e-12 ? 0.0 : value);
  return text.data();
}

std::string text_at(double x, double y, const std::string& text, const char* anchor,
                    const char* color = "muted", const char* more = "") {
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + anchor + "\" fill=\"var(--" +
         color + ")\"" + more + ">" + escape_html(text) + "</text>\n";
}
std::string line_between(double x1, double y1, double x2, double y2, const std::string& stroke,
                         const std::string& more = "") {
  return "<line x1=\"" + px(x1) + "\" y1=\"" + px(y1) + "\" x2=\"" + px(x2) + "\" y2=\"" + px(y2) +
         "\" stroke=\"" + stroke + "\"" + more + "/>\n";
}

std::string rectangle(double x1, double x2, double y, double height, const std::string& attributes) {
  return "<rect x=\"" + px(x1) + "\" y=\"" + px(y) + "\" width=\"" + px(std::max(0.5, x2 - x1)) +
         "\" height=\"" + px(height) + "\" " + attributes + "/>\n";
}

/// Maps values to pixels, with the ticks to label.
class Scale {
 public:
  Scale(const ChartAxis& axis, double low, double high, double from_px, double to_px)
      : log_{axis.logarithmic}, from_px_{from_px}, to_px_{to_px} {
    if (axis.low < axis.high) {
      low = axis.low;
      high = axis.high;
    } else if (axis.from_zero && !log_) {
      low = std::min(low, 0.0);
    }
    if (!std::isfinite(low) || !std::isfinite(high)) {
      low = log_ ? 0.1 : 0.0;
      high = 1.0;
    }
    if (log_) {
      low = std::max(low, 1e-12);
      high = std::max(high, 1.5 * low);
      low = std::log10(low);
      high = std::log10(high);
    } else if (!(high - low > 1e-9 * std::max(std::abs(low), std::abs(high)))) {
      low -= 0.5;
      high += 0.5;
    }
    low_ = low;
    high_ = high;
  }

  [[nodiscard]] double operator()(double value) const {
    const double shown = log_ ? std::log10(std::max(value, 1e-12)) : value;
    const double share = std::clamp((shown - low_) / (high_ - low_), -0.02, 1.02);
    return from_px_ + share * (to_px_ - from_px_);
  }

  [[nodiscard]] std::vector<double> ticks() const { return log_ ? log_ticks() : linear_ticks(); }

 private:
  [[nodiscard]] std::vector<double> log_ticks() const {
    std::vector<double> found;
    const bool few = high_ - low_ < 1.5;
    for (int decade = static_cast<int>(std::floor(low_)); decade <= static_cast<int>(std::ceil(high_));
         ++decade)
      for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor != 1.0 && !few) continue;
        const double value = factor * std::pow(10.0, decade);
        if (std::log10(value) >= low_ - 1e-9 && std::log10(value) <= high_ + 1e-9) found.push_back(value);
      }
    return found;
  }
  [[nodiscard]] std::vector<double> linear_ticks() const {
    const double rough = (high_ - low_) / 5.0;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10.0 * power;
    for (const double factor : {1.0, 2.0, 2.5, 5.0})
      if (factor * power >= rough) {
        step = factor * power;
        break;
      }
    std::vector<double> found;
    for (double i = std::ceil(low_ / step - 1e-9); i * step <= high_ + 1e-9 * step; i += 1.0)
      found.push_back(i * step);
    return found;
  }

  bool log_;
  double from_px_, to_px_;
  double low_ = 0.0, high_ = 1.0;
};

/// Smallest and largest of the finite values offered.
struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

ReplayPoint half_px(double x, double y) {
  return {kPathUnits * x, kPathUnits * y};
}

std::string opened(const std::string& title, double width, double height) {
  return "<svg viewBox=\"0 0 " + px(width) + " " + px(height) + "\" role=\"img\" aria-label=\"" +
         escape_html(title) + "\" font-family=\"system-ui, sans-serif\" font-size=\"13\" fill=\"none\">\n";
}
std::string heading(const std::string& title) {
  return text_at(4.0, 16.0, title, "start", "text", " font-weight=\"650\"");
}

std::string x_axis(const ChartAxis& axis, const Scale& x, const Layout& area) {
  std::string svg;
  for (const double tick : x.ticks()) {
    svg += line_between(x(tick), area.top, x(tick), area.bottom, "var(--grid)");
    svg += text_at(x(tick), area.bottom + 16.0, tick_text(tick), "middle");
  }
  svg += line_between(area.left, area.bottom, area.right, area.bottom, "var(--control)");
  return svg + text_at(0.5 * (area.left + area.right), area.bottom + 33.0, axis.label, "middle");
}

std::string y_axis(const ChartAxis& axis, const Scale& y, const Layout& area) {
  std::string svg;
  for (const double tick : y.ticks()) {
    svg += line_between(area.left, y(tick), area.right, y(tick), "var(--grid)");
    svg += text_at(area.left - 6.0, y(tick) + 4.0, tick_text(tick), "end");
  }
  return svg + text_at(area.left - 40.0, area.top - 8.0, axis.label, "start");
}

std::string marker(double x, double y, int style) {
  const std::string fill = " fill=\"" + color_of(style) + "\"";
  const double r = 4.0;
  switch (style % 4) {
    case 0:
      return "<circle cx=\"" + px(x) + "\" cy=\"" + px(y) + "\" r=\"" + px(r) + "\"" + fill + "/>\n";
    case 1:
      return "<rect x=\"" + px(x - r) + "\" y=\"" + px(y - r) + "\" width=\"" + px(2.0 * r) + "\" height=\"" +
             px(2.0 * r) + "\"" + fill + "/>\n";
    case 2:
      return "<polygon points=\"" + px(x) + "," + px(y - 5.0) + " " + px(x + 5.0) + "," + px(y + r) + " " +
             px(x - 5.0) + "," + px(y + r) + "\"" + fill + "/>\n";
    default:
      return "<polygon points=\"" + px(x) + "," + px(y - 5.5) + " " + px(x + 5.5) + "," + px(y) + " " +
             px(x) + "," + px(y + 5.5) + " " + px(x - 5.5) + "," + px(y) + "\"" + fill + "/>\n";
  }
}

/// Unbroken pieces [half px] as a line, or their points as dots or crosses.
std::string path_of(std::vector<std::vector<ReplayPoint>> pieces, const ChartSeries& series) {
  std::string data, more;
  if (series.look == SeriesLook::dots) {
    data = path_data(pieces, "h0");
    more = " stroke-width=\"9\" stroke-linecap=\"round\"";
  } else if (series.look == SeriesLook::crosses) {
    data = path_data(pieces, "m-6-6l12 12m0-12l-12 12m6-6");
    more = " stroke-width=\"3\"";
  } else {
    for (std::vector<ReplayPoint>& piece : pieces)
      piece = thinned(column_extremes(piece, kPathUnits), kPathTolerance);
    data = path_data(pieces, "");
    const std::string dash = style_of(series.style).dash;
    more = " stroke-width=\"4\" stroke-linejoin=\"round\"" +
           (dash.empty() ? "" : " stroke-dasharray=\"" + dash + "\"");
  }
  if (data.empty()) return "";
  return "<path transform=\"scale(.5)\" stroke=\"" + color_of(series.style) + "\"" + more + " d=\"" + data +
         "\"/>\n";
}

std::string legend(const std::vector<ChartSeries>& series, double left, double top) {
  std::string svg;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double y = top + 17.0 * static_cast<double>(i);
    svg += path_of({{half_px(left, y), half_px(left + 34.0, y)}}, series[i]);
    if (series[i].look == SeriesLook::line_and_markers) svg += marker(left + 17.0, y, series[i].style);
    svg += text_at(left + 42.0, y + 4.5, series[i].name, "start", "text");
  }
  return svg;
}

std::string series_marks(const ChartSeries& series, const Scale& x, const Scale& y, double shift) {
  std::string marks;
  std::vector<std::vector<ReplayPoint>> pieces(1);
  for (const ChartPoint& point : series.points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
      pieces.emplace_back();
      continue;
    }
    const double at = x(point.x) + shift;
    pieces.back().push_back(half_px(at, y(point.y)));
    if (point.low < point.high)
      marks +=
          line_between(at, y(point.low), at, y(point.high), color_of(series.style), " stroke-width=\"1.5\"");
    if (series.look == SeriesLook::line_and_markers) marks += marker(at, y(point.y), series.style);
  }
  return path_of(std::move(pieces), series) + marks;
}

void span_of_row(const ChartRow& row, RowKind kind, Span& span) {
  switch (kind) {
    case RowKind::box:
      for (const double value : row.quantiles) span.add(value);
      return;
    case RowKind::bar:
      span.add(row.bar);
      span.add(row.whisker);
      return;
    case RowKind::histogram:
      for (std::size_t i = 0; i < row.shares.size(); ++i)
        if (row.shares[i] > 0.0) {
          span.add(row.edges[i]);
          span.add(row.edges[i + 1]);
        }
      return;
  }
}

std::string box_marks(const ChartRow& row, const Scale& x, double y) {
  if (row.quantiles.size() != 5 || !std::isfinite(row.quantiles[0])) return "";
  const std::string color = color_of(row.style);
  const auto at = [&](std::size_t i) { return x(row.quantiles[i]); };
  return line_between(at(0), y + 6.0, at(4), y + 6.0, color, " stroke-width=\"2\"") +
         rectangle(at(1), at(3), y, 12.0,
                   "fill=\"var(--panel)\" stroke=\"" + color + "\" stroke-width=\"2\"") +
         line_between(at(2), y, at(2), y + 12.0, color, " stroke-width=\"4\"");
}

std::string bar_marks(const ChartRow& row, const Scale& x, double y) {
  if (!std::isfinite(row.bar)) return "";
  const std::string color = color_of(row.style);
  std::string svg = rectangle(kFile.left, x(row.bar), y, 12.0, "fill=\"" + color + "\"");
  if (std::isfinite(row.whisker))
    svg += line_between(x(row.bar), y + 6.0, x(row.whisker), y + 6.0, color, " stroke-width=\"2\"") +
           line_between(x(row.whisker), y + 1.0, x(row.whisker), y + 11.0, color, " stroke-width=\"2\"");
  return svg;
}

std::string histogram_marks(const ChartRow& row, const Scale& x, double y, double height) {
  double most = 0.0;
  for (const double share : row.shares) most = std::max(most, share);
  if (!(most > 0.0)) return "";
  std::string points;
  double last = 0.0;
  for (std::size_t i = 0; i < row.shares.size(); ++i) {
    if (row.shares[i] <= 0.0 && (points.empty() || row.shares[i] == last)) continue;
    const double top = y + height * (1.0 - row.shares[i] / most);
    if (points.empty()) points = px(x(row.edges[i])) + "," + px(y + height);
    points += " " + px(x(row.edges[i])) + "," + px(top) + " " + px(x(row.edges[i + 1])) + "," + px(top);
    last = row.shares[i];
  }
  points +=
      " " +
      points.substr(points.find_last_of(' ') + 1, points.find_last_of(',') - points.find_last_of(' ') - 1) +
      "," + px(y + height);
  const std::string color = color_of(row.style);
  return "<polygon points=\"" + points + "\" fill=\"" + color + "\" fill-opacity=\"0.35\" stroke=\"" + color +
         "\"/>\n";
}

}  // namespace

std::string line_chart(const LineChart& chart) {
  Span xs, ys;
  for (const ChartSeries& series : chart.series)
    for (const ChartPoint& point : series.points) {
      xs.add(point.x);
      ys.add(point.y);
      if (point.low < point.high) {
        ys.add(point.low);
        ys.add(point.high);
      }
    }
  for (const ChartLimit& limit : chart.limits) ys.add(limit.y);
  const Layout& area = chart.in_page ? kPage : kFile;
  const Scale x{chart.x, xs.low, xs.high, area.left + area.aside, area.right - area.aside};
  const Scale y{chart.y, ys.low, ys.high, area.bottom - area.above, area.top + area.above};
  const double legend_top = area.bottom + 48.0;
  const double height =
      chart.in_page ? legend_top - 10.0 : legend_top + 17.0 * static_cast<double>(chart.series.size());
  std::string svg = opened(chart.title, area.width, height) +
                    rectangle(area.left, area.right, area.top, area.bottom - area.top, "class=\"area\"") +
                    x_axis(chart.x, x, area) + y_axis(chart.y, y, area);
  for (const ChartLimit& limit : chart.limits)
    svg += line_between(area.left, y(limit.y), area.right, y(limit.y), "var(--limit)",
                        " stroke-width=\"1.5\" stroke-dasharray=\"6 4\"") +
           text_at(area.right - 2.0, y(limit.y) - 5.0, limit.name, "end", "limit");
  // Intervals side by side, where several series have points at the same level.
  const double middle = 0.5 * (static_cast<double>(chart.series.size()) - 1.0);
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const bool has_markers = chart.series[i].look == SeriesLook::line_and_markers;
    svg += series_marks(chart.series[i], x, y, has_markers ? 3.5 * (static_cast<double>(i) - middle) : 0.0);
  }
  if (!chart.in_page) svg += heading(chart.title) + legend(chart.series, area.left, legend_top);
  return svg + "</svg>\n";
}

std::string row_chart(const RowChart& chart) {
  Span span;
  for (const ChartRow& row : chart.rows) span_of_row(row, chart.kind, span);
  if (chart.kind == RowKind::bar && chart.x.logarithmic) span.low *= 0.5;
  const double mark_height = chart.kind == RowKind::histogram ? 34.0 : 12.0;
  const double row_height = 24.0 + mark_height;
  const double bottom = kRowsTop + row_height * static_cast<double>(chart.rows.size()) + 6.0;
  const Scale x{chart.x, span.low, span.high, kFile.left, kFile.right};
  std::string svg = opened(chart.title, kFile.width, bottom + 42.0) + heading(chart.title) +
                    x_axis(chart.x, x, {kFile.width, kFile.left, kFile.right, kRowsTop, bottom, 0.0, 0.0});
  for (std::size_t i = 0; i < chart.rows.size(); ++i) {
    const ChartRow& row = chart.rows[i];
    const double top = kRowsTop + row_height * static_cast<double>(i);
    svg += "<text x=\"4\" y=\"" + px(top + 14.0) + "\" fill=\"var(--text)\">" + escape_html(row.label) +
           " <tspan fill=\"var(--muted)\">" + escape_html(row.note) + "</tspan></text>\n";
    const double y = top + 19.0;
    switch (chart.kind) {
      case RowKind::box:
        svg += box_marks(row, x, y);
        break;
      case RowKind::bar:
        svg += bar_marks(row, x, y);
        break;
      case RowKind::histogram:
        svg += histogram_marks(row, x, y, mark_height);
        break;
    }
  }
  return svg + "</svg>\n";
}

std::string standalone(const std::string& chart) {
  const std::string tag = "<svg ";
  std::string file = chart;
  const std::size_t end = file.find('>');
  file.insert(end + 1, "\n<style>" + palette_css() +
                           "</style>\n<rect width=\"100%\" height=\"100%\" "
                           "fill=\"var(--panel)\"/>");
  file.insert(tag.size(), "xmlns=\"http://www.w3.org/2000/svg\" ");
  return file;
}

}  // namespace spf
