#include "report/polyline.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace spf {
namespace {

double deviation(const ReplayPoint& first, const ReplayPoint& last, const ReplayPoint& point) {
  const double dx = last.x - first.x;
  const double dy = last.y - first.y;
  const double length_squared = dx * dx + dy * dy;
  const double along = (point.x - first.x) * dx + (point.y - first.y) * dy;
  const double share = length_squared > 0.0 ? std::clamp(along / length_squared, 0.0, 1.0) : 0.0;
  return std::hypot(point.x - first.x - share * dx, point.y - first.y - share * dy);
}

double deviation(const ReplayTimedPoint& first, const ReplayTimedPoint& last, const ReplayTimedPoint& point) {
  const double duration = last.time - first.time;
  const double share = duration > 0.0 ? (point.time - first.time) / duration : 0.0;
  return std::hypot(point.x - first.x - share * (last.x - first.x),
                    point.y - first.y - share * (last.y - first.y));
}

template <class Point>
std::vector<Point> douglas_peucker(const std::vector<Point>& points, double tolerance) {
  if (points.size() < 3) return points;
  std::vector<bool> keep(points.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    std::size_t farthest = first;
    double largest = tolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double distance = deviation(points[first], points[last], points[i]);
      if (!(distance <= largest)) {  // also keeps what is not a number
        largest = distance;
        farthest = i;
      }
    }
    if (farthest == first) continue;
    keep[farthest] = true;
    open.emplace_back(first, farthest);
    open.emplace_back(farthest, last);
  }
  std::vector<Point> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keep[i]) kept.push_back(points[i]);
  }
  return kept;
}

}  // namespace

std::vector<ReplayPoint> thinned(const std::vector<ReplayPoint>& points, double tolerance) {
  return douglas_peucker(points, tolerance);
}

std::vector<ReplayTimedPoint> thinned(const std::vector<ReplayTimedPoint>& points, double tolerance) {
  return douglas_peucker(points, tolerance);
}

std::vector<ReplayPoint> column_extremes(const std::vector<ReplayPoint>& points, double width) {
  std::vector<ReplayPoint> kept;
  for (std::size_t first = 0, end = 0; first < points.size(); first = end) {
    std::size_t low = first, high = first;
    const double column = std::floor(points[first].x / width);
    for (; end < points.size() && std::floor(points[end].x / width) == column; ++end) {
      if (points[end].y < points[low].y) low = end;
      if (points[end].y > points[high].y) high = end;
    }
    for (const std::size_t i : std::set{first, low, high, end - 1}) kept.push_back(points[i]);
  }
  return kept;
}

std::string path_data(const std::vector<std::vector<ReplayPoint>>& pieces, std::string_view mark) {
  std::string text;
  long last_x = 0, last_y = 0;  // a path's first step counts from the origin
  const auto add = [&text](long number) {
    if (number >= 0 && text.back() <= '9') text += ' ';  // it would run into the number before
    text += std::to_string(number);
  };
  for (const std::vector<ReplayPoint>& piece : pieces)
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const long x = std::lround(piece[i].x), y = std::lround(piece[i].y);
      if (i == 0 || !mark.empty()) text += 'm';
      if (i == 1 && mark.empty()) text += 'l';
      add(x - last_x);
      add(y - last_y);
      text += mark;
      last_x = x;
      last_y = y;
    }
  return text;
}

}  // namespace spf
