// A drawing of a plane scene as SVG, for the examples: metres in, y up, the colours of the reports.
#pragma once

#include <report/palette.hpp>
#include <report/table.hpp>

#include <Eigen/Core>
#include <fstream>
#include <string>
#include <vector>

class Picture {
 public:
  /// Shows the rectangle from `low` to `high` [m], 720 pixels wide.
  Picture(const Eigen::Vector2d& low, const Eigen::Vector2d& high) : low_{low}, high_{high} {
    box(low, high, "control", 0.0);
  }

  /// Colours are names of the report's palette: robot-0, obstacle, wall, muted, ...
  void disc(const Eigen::Vector2d& centre, double radius, const std::string& colour, double opacity = 0.5) {
    ellipse(centre, {radius, radius}, 0.0, colour, opacity);
  }
  void ellipse(const Eigen::Vector2d& centre, const Eigen::Vector2d& half_axes, double heading,
               const std::string& colour, double opacity) {
    add("<ellipse rx='" + px(half_axes.x()) + "' ry='" + px(half_axes.y()) + "' transform='translate(" +
        px(centre.x() - low_.x()) + " " + px(high_.y() - centre.y()) + ") rotate(" +
        spf::fixed(-heading * 57.29578, 1) + ")' " + filled(colour, opacity));
  }
  void box(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const std::string& colour,
           double opacity = 0.35) {
    add("<rect x='" + px(low.x() - low_.x()) + "' y='" + px(high_.y() - high.y()) + "' width='" +
        px(high.x() - low.x()) + "' height='" + px(high.y() - low.y()) + "' " + filled(colour, opacity));
  }
  void line(const std::vector<Eigen::Vector2d>& points, const std::string& colour, double width = 2.0,
            const std::string& dashes = "none") {
    std::string list;
    for (const Eigen::Vector2d& p : points) list += px(p.x() - low_.x()) + "," + px(high_.y() - p.y()) + " ";
    add("<polyline points='" + list + "' fill='none' stroke='" + shade(colour) + "' stroke-width='" +
        spf::fixed(width, 1) + "' stroke-dasharray='" + dashes + "'/>");
  }
  void text(const Eigen::Vector2d& at, const std::string& words) {
    add("<text x='" + px(at.x() - low_.x()) + "' y='" + px(high_.y() - at.y()) + "' fill='" + shade("text") +
        "' font-family='sans-serif' font-size='14'>" + words + "</text>");
  }

  /// Throws std::ios_base::failure when the file cannot be written.
  void save(const std::string& file) const {
    std::ofstream out;
    out.exceptions(std::ios::failbit | std::ios::badbit);
    out.open(file);
    const Eigen::Vector2d size = high_ - low_;
    out << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 720 " << px(size.y()) << "' role='img'>\n"
        << "<rect width='100%' height='100%' fill='" << shade("panel") << "'/>\n"
        << elements_ << "</svg>\n";
  }

 private:
  [[nodiscard]] std::string px(double metres) const {
    return spf::fixed(metres * 720.0 / (high_.x() - low_.x()), 1);
  }
  [[nodiscard]] static std::string shade(const std::string& colour) {
    return std::string{spf::palette_color(colour).light};
  }
  [[nodiscard]] static std::string filled(const std::string& colour, double opacity) {
    return "fill='" + shade(colour) + "' fill-opacity='" + spf::fixed(opacity, 2) + "' stroke='" +
           shade(colour) + "'/>";
  }
  void add(const std::string& element) { elements_ += element + "\n"; }

  Eigen::Vector2d low_, high_;
  std::string elements_;
};
