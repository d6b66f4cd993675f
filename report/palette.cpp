#include "report/palette.hpp"

#include <stdexcept>

namespace spf {
namespace {

std::string declarations(bool dark) {
  std::string css = dark ? "color-scheme:dark;" : "color-scheme:light;";
  for (const PaletteColor& color : kPalette) {
    css.append("--").append(color.name).append(":").append(dark ? color.dark : color.light).append(";");
  }
  return css;
}

}  // namespace

const PaletteColor& palette_color(std::string_view name) {
  for (const PaletteColor& color : kPalette) {
    if (color.name == name) return color;
  }
  throw std::out_of_range("no colour of the palette is called " + std::string{name});
}

const PaletteColor& robot_color(int index) {
  const int turn = ((index % kRobotColors) + kRobotColors) % kRobotColors;
  return palette_color("robot-" + std::to_string(turn));
}

std::string palette_css() {
  const std::string light = declarations(false);
  const std::string dark = declarations(true);
  return ":root{" + light + "}\n@media (prefers-color-scheme:dark){:root{" + dark + "}}\n" +
         ":root[data-theme=light]{" + light + "}\n:root[data-theme=dark]{" + dark + "}\n";
}

}  // namespace spf
