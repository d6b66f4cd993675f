#include "report/frame_svg.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/html_text.hpp"
#include "report/palette.hpp"
#include "report/polyline.hpp"
#include "report/table.hpp"

namespace spf {
namespace {

constexpr double kTrailTolerance = 0.005;  // [m]
constexpr double kMargin = 12.0;           // [px]

bool is_known(const ReplayPoint& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Collects elements; positions and lengths go in as metres and come out as pixels.
class Drawing {
 public:
  Drawing(const ReplayBox& bounds, const FrameSvgOptions& options)
      : bounds_{bounds},
        dark_{options.dark},
        pixels_per_metre_{std::max(1.0, options.width - 2.0 * kMargin) / (bounds.high.x - bounds.low.x)} {}

  [[nodiscard]] double x(double metres) const {
    return kMargin + (metres - bounds_.low.x) * pixels_per_metre_;
  }
  [[nodiscard]] double y(double metres) const {
    return kMargin + (bounds_.high.y - metres) * pixels_per_metre_;
  }
  [[nodiscard]] double scaled(double metres) const { return metres * pixels_per_metre_; }
  [[nodiscard]] std::string color(std::string_view name) const { return shade(palette_color(name)); }
  [[nodiscard]] std::string shade(const PaletteColor& color) const {
    return std::string{dark_ ? color.dark : color.light};
  }

  void circle(const ReplayPoint& center, double radius_metres, const std::string& style) {
    if (!is_known(center) || !std::isfinite(radius_metres)) return;
    add("<circle cx=\"" + px(x(center.x)) + "\" cy=\"" + px(y(center.y)) + "\" r=\"" +
        px(scaled(radius_metres)) + "\" " + style + "/>");
  }
  void box(const ReplayBox& box, const std::string& style) {
    add("<rect x=\"" + px(x(box.low.x)) + "\" y=\"" + px(y(box.high.y)) + "\" width=\"" +
        px(scaled(box.high.x - box.low.x)) + "\" height=\"" + px(scaled(box.high.y - box.low.y)) + "\" " +
        style + "/>");
  }
  void ellipse(const ReplayEllipse& e, const std::string& style) {
    if (!is_known(e.center) || !(e.half_axis_long > 0.0)) return;
    const double degrees = -e.angle * 180.0 / std::numbers::pi;  // y points down in SVG
    add("<ellipse rx=\"" + px(scaled(e.half_axis_long)) + "\" ry=\"" + px(scaled(e.half_axis_short)) +
        "\" transform=\"translate(" + px(x(e.center.x)) + " " + px(y(e.center.y)) + ") rotate(" +
        px(degrees) + ")\" " + style + "/>");
  }
  void polygon(const std::vector<ReplayPoint>& corners, const std::string& style) {
    std::string list;
    for (const ReplayPoint& corner : corners) list += px(x(corner.x)) + "," + px(y(corner.y)) + " ";
    add("<polygon points=\"" + list + "\" " + style + "/>");
  }
  void polyline(const std::vector<ReplayPoint>& points, const std::string& style) {
    std::string list;
    for (const ReplayPoint& p : points) {
      if (is_known(p)) list += px(x(p.x)) + "," + px(y(p.y)) + " ";
    }
    if (!list.empty()) list.pop_back();
    if (!list.empty()) add("<polyline points=\"" + list + "\" fill=\"none\" " + style + "/>");
  }
  template <class Points>
  void polygon(const Points& points, const std::string& style) {
    std::string list;
    for (const ReplayPoint& p : points) list += (list.empty() ? "" : " ") + px(x(p.x)) + "," + px(y(p.y));
    add("<polygon points=\"" + list + "\" " + style + "/>");
  }
  void label(const ReplayPoint& center, const std::string& text, double size, const std::string& style) {
    if (!is_known(center)) return;
    add("<text x=\"" + px(x(center.x)) + "\" y=\"" + px(y(center.y) + 0.35 * size) + "\" font-size=\"" +
        px(size) + "\" text-anchor=\"middle\" " + style + ">" + escape_html(text) + "</text>");
  }
  void add(const std::string& element) { elements_ += "  " + element + "\n"; }

  /// `caption` is shown below the scene and read aloud.
  [[nodiscard]] std::string finished(const std::string& caption) const {
    const std::string width = px(scaled(bounds_.high.x - bounds_.low.x) + 2.0 * kMargin);
    const std::string height = px(scaled(bounds_.high.y - bounds_.low.y) + 2.0 * kMargin + 22.0);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " + height + "\" width=\"" +
           width + "\" height=\"" + height +
           "\" role=\"img\" font-family=\"system-ui, sans-serif\">\n  <title>" + escape_html(caption) +
           "</title>\n  <rect width=\"100%\" height=\"100%\" fill=\"" + color("panel") + "\"/>\n" +
           elements_ + "  <text x=\"" + px(kMargin) + "\" y=\"" +
           px(scaled(bounds_.high.y - bounds_.low.y) + kMargin + 20.0) + "\" font-size=\"13\" fill=\"" +
           color("muted") + "\">" + escape_html(caption) + "</text>\n</svg>\n";
  }

  [[nodiscard]] static std::string px(double pixels) { return fixed(pixels, 1); }

 private:
  ReplayBox bounds_;
  bool dark_;
  double pixels_per_metre_;
  std::string elements_;
};

void draw_map(Drawing& drawing, const ReplayData& data) {
  const std::string wall =
      "fill=\"" + drawing.color("wall") + "\" fill-opacity=\"0.35\" stroke=\"" + drawing.color("wall") + "\"";
  drawing.box(data.bounds, "fill=\"none\" stroke=\"" + drawing.color("control") + "\"");
  for (const ReplayBox& box : data.shapes.boxes) drawing.box(box, wall);
  for (const ReplayDisc& disc : data.shapes.discs) drawing.circle(disc.center, disc.radius, wall);
  for (const std::vector<ReplayPoint>& polygon : data.shapes.polygons) drawing.polygon(polygon, wall);
  const std::string block = "fill=\"" + drawing.color("wall") + "\" fill-opacity=\"0.6\"";
  for (const std::array<ReplayPoint, 4>& corners : data.shapes.blocks) drawing.polygon(corners, block);
}

void draw_obstacle(Drawing& drawing, const ReplayObstacle& obstacle, std::size_t frame) {
  const ReplayObstacleFrame& now = obstacle.frames[frame];
  const std::string color = drawing.color("obstacle");
  drawing.ellipse(now.field, "fill=\"" + color + "\" fill-opacity=\"0.14\" stroke=\"" + color +
                                 "\" stroke-dasharray=\"4 3\"");
  drawing.circle(now.position, obstacle.radius,
                 "fill=\"" + color + "\" fill-opacity=\"0.55\" stroke=\"" + color + "\"");
  drawing.polyline({now.position, {now.position.x + now.velocity.x, now.position.y + now.velocity.y}},
                   "stroke=\"" + color + "\" stroke-width=\"2\"");
}

/// The part of the newest plan that still lies ahead.
std::vector<ReplayPoint> plan_ahead(const ReplayRobot& robot, double time) {
  const ReplayPlan* newest = nullptr;
  for (const ReplayPlan& plan : robot.plans) {
    if (plan.time <= time && !plan.points.empty()) newest = &plan;
  }
  std::vector<ReplayPoint> ahead;
  if (newest == nullptr) return ahead;
  for (const ReplayTimedPoint& p : newest->points) {
    if (p.time >= time) ahead.push_back({p.x, p.y});
  }
  return ahead;
}

std::vector<ReplayPoint> placed(std::vector<ReplayPoint> corners, const ReplayPose& pose) {
  const double cosine = std::cos(pose.heading);
  const double sine = std::sin(pose.heading);
  for (ReplayPoint& corner : corners)
    corner = {pose.x + cosine * corner.x - sine * corner.y, pose.y + sine * corner.x + cosine * corner.y};
  return corners;
}

void draw_robot(Drawing& drawing, const ReplayRobot& robot, int index, std::size_t frame, double time,
                const FrameSvgOptions& options) {
  const std::string color = drawing.shade(robot_color(index));
  const ReplayPose& pose = robot.frames[frame].pose;
  const ReplayPoint here{pose.x, pose.y};
  if (options.trails) {
    std::vector<ReplayPoint> trail;
    for (std::size_t k = 0; k <= frame; ++k) {
      const ReplayPoint at{robot.frames[k].pose.x, robot.frames[k].pose.y};
      if (is_known(at)) trail.push_back(at);
    }
    drawing.polyline(thinned(trail, kTrailTolerance),
                     "stroke=\"" + color + "\" stroke-opacity=\"0.45\" stroke-width=\"1.5\"");
  }
  if (!is_known(here)) return;  // not in the scene
  if (options.plans) {
    std::vector<ReplayPoint> plan = plan_ahead(robot, time);
    plan.insert(plan.begin(), here);
    if (plan.size() > 1)
      drawing.polyline(plan, "stroke=\"" + color +
                                 "\" stroke-width=\"2\" stroke-dasharray=\"1 4\" stroke-linecap=\"round\"");
  }
  drawing.circle(goal_at(robot, time), 0.4 * robot.radius,
                 "fill=\"none\" stroke=\"" + color + "\" stroke-width=\"1.5\"");
  if (robot.corners.empty())
    drawing.circle(here, robot.radius, "fill=\"" + color + "\"");
  else
    drawing.polygon(placed(robot.corners, pose), "fill=\"" + color + "\"");
  const double size = std::clamp(1.1 * drawing.scaled(robot.radius), 7.0, 14.0);
  drawing.label(here, std::to_string(robot.id), size,
                "font-weight=\"600\" fill=\"" + drawing.color("on-accent") + "\"");
}

void draw_contacts(Drawing& drawing, const ReplayData& data, double time) {
  for (const ReplayEvent& event : data.events) {
    if (event.kind != ReplayEventKind::contact || event.time > time || !event.position ||
        !is_known(*event.position))
      continue;
    const double x = drawing.x(event.position->x);
    const double y = drawing.y(event.position->y);
    const auto at = [&](double dx, double dy) { return Drawing::px(x + dx) + " " + Drawing::px(y + dy); };
    drawing.add("<path d=\"M" + at(-6, -6) + " L" + at(6, 6) + " M" + at(-6, 6) + " L" + at(6, -6) +
                "\" stroke=\"" + drawing.color("bad") + "\" stroke-width=\"3\" stroke-linecap=\"round\"/>");
  }
}

}  // namespace

std::string render_frame_svg(const ReplayData& data, double time, const FrameSvgOptions& options) {
  require_consistent(data);
  const std::size_t frames = frame_count(data);
  const double last_time = frames == 0 ? 0.0 : data.frame_interval * static_cast<double>(frames - 1);
  const double instant = std::isfinite(time) ? std::clamp(time, 0.0, last_time) : last_time;
  const auto frame = static_cast<std::size_t>(std::lround(instant / data.frame_interval));

  Drawing drawing{data.bounds, options};
  draw_map(drawing, data);
  if (frames > 0) {
    for (const ReplayObstacle& obstacle : data.obstacles) draw_obstacle(drawing, obstacle, frame);
    int index = 0;
    for (const ReplayRobot& robot : data.robots) draw_robot(drawing, robot, index++, frame, instant, options);
  }
  draw_contacts(drawing, data, instant);
  return drawing.finished(data.title + ", t = " + fixed(instant, 1) + " s");
}

}  // namespace spf
