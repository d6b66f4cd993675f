// The one palette of pages and pictures, light and dark. Chosen to stay apart for colour-blind eyes (robots
// also carry their number, obstacles and contacts their own shape); text reaches 4.5:1, marks 3:1
// (palette_test.cpp).
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace spf {

struct PaletteColor {
  std::string_view name;   ///< also the CSS variable: --name
  std::string_view light;  ///< #rrggbb
  std::string_view dark;   ///< #rrggbb
};

/// Robots take robot-0 .. robot-4 in turn.
inline constexpr int kRobotColors = 5;

inline constexpr std::array<PaletteColor, 26> kPalette{{
    {"page", "#f4f6f8", "#0f1419"},       // behind everything
    {"panel", "#ffffff", "#171d24"},      // cards, scene
    {"raised", "#eaeef2", "#222a33"},     // buttons, table stripes
    {"line", "#cfd6de", "#333d48"},       // borders, not needed to understand
    {"grid", "#e8ecf0", "#212932"},       // metre grid
    {"control", "#76818d", "#788593"},    // outlines of what can be operated
    {"text", "#18212b", "#e6ebf0"},       //
    {"muted", "#566270", "#9fabb8"},      // secondary text, axes
    {"accent", "#0f5fa8", "#6ab6f5"},     // focus, cursor, chosen
    {"on-accent", "#ffffff", "#0b1117"},  // text on accent and on robots
    {"good", "#0b6e4f", "#4fc79a"},       // success, arrived
    {"bad", "#b3161f", "#ff7b7b"},        // contact, failure
    {"caution", "#8a5a00", "#e5b03f"},    // braking, trouble short of contact
    {"obstacle", "#b84700", "#ff9a5c"},   // moving obstacles and their fields
    {"wall", "#6b7683", "#8793a0"},       // true static map
    {"perceived", "#3a4652", "#c3ccd6"},  // cells that a robot has seen
    {"robot-0", "#0067a8", "#5cb3f0"},    // blue
    {"robot-1", "#8a5d00", "#e3b341"},    // ochre
    {"robot-2", "#a02c78", "#ec92c6"},    // purple
    {"robot-3", "#00735a", "#45c9a0"},    // green
    {"robot-4", "#4d5763", "#b3bdc8"},    // slate
    {"series-0", "#0067a8", "#5cb3f0"},   // charts: three lines, also told apart by their dashes
    {"series-1", "#b84700", "#ff9a5c"},   //
    {"series-2", "#00735a", "#45c9a0"},   //
    {"limit", "#b3161f", "#ff7b7b"},      // a limit in a chart
    {"shade", "#18212b", "#000000"},      // shadow of the dialog
}};

/// The colour of this name; throws std::out_of_range for a name that is not in the palette.
[[nodiscard]] const PaletteColor& palette_color(std::string_view name);
/// The colour of the n-th robot.
[[nodiscard]] const PaletteColor& robot_color(int index);

/// CSS that declares every colour as a variable: light, dark by the reader's system, and either by
/// data-theme="light" or "dark" on the root element.
[[nodiscard]] std::string palette_css();

}  // namespace spf
