// Scene generators of the experiment protocol (docs/protocol.md): every family draws a new scene for every
// trial, and the same scene for the same (family, seed, trial) on every machine. Frame: world.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/crowd_recording.hpp"
#include "sim/scenario.hpp"

namespace spf::sim {

enum class Family {
  t2,        ///< five robots cross a field with squares and discs (the paper's Table 2)
  t2_hard,   ///< the same, crowded
  f7,        ///< twelve robots, one moving disc, sensed map (the paper's Fig. 7)
  p8,        ///< the paper's platform: eight small robots in a walled arena (Fig. 8)
  swap,      ///< robots on a circle exchange positions
  field,     ///< equal density for any number of robots
  ped,       ///< robots cross a recorded crowd
  clutter,   ///< one robot among pillars between two walls
  doors,     ///< robots through one door
  corridor,  ///< robots through a corridor of one lane, from both ends
};

}  // namespace spf::sim

namespace spf {
template <>
struct EnumNames<sim::Family> {
  static constexpr std::array<std::pair<sim::Family, const char*>, 10> values{
      {{sim::Family::t2, "t2"},
       {sim::Family::t2_hard, "t2_hard"},
       {sim::Family::f7, "f7"},
       {sim::Family::p8, "p8"},
       {sim::Family::swap, "swap"},
       {sim::Family::field, "field"},
       {sim::Family::ped, "ped"},
       {sim::Family::clutter, "clutter"},
       {sim::Family::doors, "doors"},
       {sim::Family::corridor, "corridor"}}};
};
}  // namespace spf

namespace spf::sim {

/// What a family draws. Every family uses some of the entries; family_setup() gives their values.
struct LayoutParameters {
  int robots = 5;
  int squares = 6;
  int discs = 4;                  ///< moving
  double half_field = 15.0;       ///< [m] half the side of the border (t2, t2_hard, f7)
  double circle_radius = 12.5;    ///< [m] of the starts (t2, t2_hard, f7)
  double squares_within = 7.0;    ///< [m] largest coordinate of a square's centre
  double square_side_low = 1.0;   ///< [m]
  double square_side_high = 2.0;  ///< [m]
  double discs_within = 13.0;     ///< [m] largest coordinate of a disc's centre
  double disc_speed_low = 0.5;    ///< [m/s]
  double disc_speed_high = 1.0;   ///< [m/s]
  double disc_radius_low = 0.4;   ///< [m] drawn only when below disc_radius_high
  double disc_radius_high = 0.4;  ///< [m]
  double circle_per_robot = 1.5;  ///< [m] of circumference (swap: 1.5 crowded, 5 wide)
  double window = 60.0;           ///< [s] of a recording, for each trial (ped)
  double window_spacing = 5.0;    ///< [s] from the beginning of a window to that of the next (ped)
  double fill_low = 0.19;         ///< [1] of the lattice before it is smoothed (clutter)
  double fill_high = 0.27;
  double passable_radius = 0.35;      ///< [m] of a disc that gets through (clutter)
  double door_width_low = 0.7;        ///< [m] (doors)
  double door_width_high = 1.2;       ///< [m]
  double wall_thickness_low = 0.05;   ///< [m] (doors)
  double wall_thickness_high = 0.4;   ///< [m]
  double corridor_width_low = 0.8;    ///< [m] (corridor)
  double corridor_width_high = 1.1;   ///< [m]
  double corridor_length_low = 3.0;   ///< [m] (corridor)
  double corridor_length_high = 6.0;  ///< [m]

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("robots", self.robots, "1", Range{1, 10000}, "number of robots");
    visit("squares", self.squares, "1", Range{0, 200}, "number of static squares");
    visit("discs", self.discs, "1", Range{0, 200}, "number of moving discs");
    visit("half_field", self.half_field, "m", Range{1.0, 1000.0}, "half the side of the border");
    visit("circle_radius", self.circle_radius, "m", Range{0.1, 1000.0}, "radius of the circle of starts");
    visit("squares_within", self.squares_within, "m", Range{0.0, 1000.0},
          "largest coordinate of a square's centre");
    visit("square_side_low", self.square_side_low, "m", Range{0.01, 100.0}, "smallest side of a square");
    visit("square_side_high", self.square_side_high, "m", Range{0.01, 100.0}, "largest side of a square");
    visit("discs_within", self.discs_within, "m", Range{0.0, 1000.0},
          "largest coordinate of a disc's centre");
    visit("disc_speed_low", self.disc_speed_low, "m/s", Range{0.0, 100.0}, "slowest disc");
    visit("disc_speed_high", self.disc_speed_high, "m/s", Range{0.0, 100.0}, "fastest disc");
    visit("disc_radius_low", self.disc_radius_low, "m", Range{0.01, 100.0}, "smallest disc");
    visit("disc_radius_high", self.disc_radius_high, "m", Range{0.01, 100.0}, "largest disc");
    visit("circle_per_robot", self.circle_per_robot, "m", Range{0.01, 100.0},
          "circumference for each robot (swap)");
    visit("window", self.window, "s", Range{1.0, 1e5}, "part of the recording that a trial is (ped)");
    visit("window_spacing", self.window_spacing, "s", Range{0.1, 1e5},
          "from the beginning of a trial's window to that of the next (ped)");
    visit("fill_low", self.fill_low, "1", Range{0.0, 1.0},
          "least share of pillars before smoothing (clutter)");
    visit("fill_high", self.fill_high, "1", Range{0.0, 1.0}, "largest share of pillars (clutter)");
    visit("passable_radius", self.passable_radius, "m", Range{0.0, 2.0},
          "radius of a disc that gets through (clutter)");
    visit("door_width_low", self.door_width_low, "m", Range{0.01, 10.0}, "narrowest door (doors)");
    visit("door_width_high", self.door_width_high, "m", Range{0.01, 10.0}, "widest door (doors)");
    visit("wall_thickness_low", self.wall_thickness_low, "m", Range{0.01, 5.0}, "thinnest wall (doors)");
    visit("wall_thickness_high", self.wall_thickness_high, "m", Range{0.01, 5.0}, "thickest wall (doors)");
    visit("corridor_width_low", self.corridor_width_low, "m", Range{0.01, 10.0},
          "narrowest corridor (corridor)");
    visit("corridor_width_high", self.corridor_width_high, "m", Range{0.01, 10.0},
          "widest corridor (corridor)");
    visit("corridor_length_low", self.corridor_length_low, "m", Range{0.01, 100.0},
          "shortest corridor (corridor)");
    visit("corridor_length_high", self.corridor_length_high, "m", Range{0.01, 100.0},
          "longest corridor (corridor)");
  }
};

/// Everything that determines a family's trials besides seed and trial number.
struct FamilySetup {
  Family family = Family::t2;
  LayoutParameters layout;
  RobotParameters robot;
  SimulationParameters simulation;
  std::shared_ptr<const CrowdRecording> crowd;  ///< of ped, which requires one; not among the fields
  std::vector<RobotParameters> fleet;           ///< kinds of robots, taken in turn; empty: all are `robot`

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("family", self.family, "family of scenes");
    visit.group("layout", self.layout);
    visit.group("robot", self.robot);
    visit.group("simulation", self.simulation);
  }
};

/// The protocol's numbers for a family (docs/protocol.md, Scenes).
[[nodiscard]] FamilySetup family_setup(Family family);

/// A layout that found no room in many attempts, and what of it did not fit.
struct NoRoom : std::runtime_error {
  NoRoom(const std::string& text, std::string of_layout)
      : std::runtime_error{text}, entry{std::move(of_layout)} {}
  std::string entry;  ///< of the layout: "squares"
};

/// Draws the scene of one trial. Throws std::invalid_argument when parameters are out of range or the crowd
/// of ped is missing, NoRoom when a thousand attempts found no scene (too many things for the area), and
/// std::runtime_error when the recording has no such window.
[[nodiscard]] Scenario make_scenario(const FamilySetup& setup, std::uint64_t seed, int trial);

}  // namespace spf::sim
