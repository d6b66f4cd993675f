// How fine a robot's map is and how far its distances reach: declared once for files of robots
// (host.map_resolution, host.map_reach) and scenarios (sensing.map_resolution, sensing.map_max_distance).
#pragma once

#include "spf/math/parameters.hpp"

namespace spf::host {

struct MapGrain {
  double resolution = 0.1;  ///< [m] node distance of the map, given or sensed
  double reach = 2.0;       ///< [m] up to which its distances are exact

  /// The fields under the names that they have in the list of the struct which holds them.
  template <class Self, class Visitor>
  static void visit_fields_as(const char* resolution, const char* reach, Self& self, Visitor&& visit) {
    visit(resolution, self.resolution, kMetresBySize, Range{0.005, 10.0},
          "node distance of the map; a given one with coarser cells keeps those");
    visit(reach, self.reach, kMetresBySize, Range{0.01, 100.0},
          "distances to static surfaces are exact up to here");
  }
};

}  // namespace spf::host
