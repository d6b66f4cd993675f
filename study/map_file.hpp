// Static maps for scenarios: the YAML files of ROS map servers with their picture, or a picture alone.
// Frame: world, SI.
#pragma once

#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "config/input_problem.hpp"
#include "sim/static_map.hpp"
#include "spf/math/parameters.hpp"

namespace spf {

/// What a cell is of which the map does not know whether it is free.
enum class UnknownCells { free, wall };

template <>
struct EnumNames<UnknownCells> {
  static constexpr std::array<std::pair<UnknownCells, const char*>, 2> values{
      {{UnknownCells::free, "free"}, {UnknownCells::wall, "wall"}}};
};

/// What a scenario says of its map besides the file.
struct MapSettings {
  UnknownCells unknown = UnknownCells::free;
  double image_resolution = 0.05;
  Eigen::Vector2d image_origin = Eigen::Vector2d::Zero();
  double image_heading = 0.0;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("unknown", self.unknown, "what cells are of which the map does not know");
    visit("image_resolution", self.image_resolution, "m", Range{1e-3, 100.0},
          "side of a pixel, of a picture that comes without a YAML file");
    visit("image_origin", self.image_origin, "m", Range{-1e5, 1e5},
          "where the lower left corner of such a picture lies");
    visit("image_heading", self.image_heading, "rad", Range{-6.3, 6.3}, "where its rows point");
  }
};

/// Reads a map. Every problem is collected with file, line, key, value and limit; null when there is any.
/// `asked_at` is the location that names the file, for problems of the file as a whole. The picture's path is
/// relative to the YAML file.
[[nodiscard]] std::shared_ptr<const sim::StaticMap> read_map_file(const std::string& path,
                                                                  const MapSettings& settings,
                                                                  const SourceLocation& asked_at,
                                                                  InputProblems& problems);

}  // namespace spf
