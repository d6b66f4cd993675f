#include "config/footprint_reader.hpp"

#include <cmath>

#include "config/parameter_text.hpp"
#include "spf/robot/footprint.hpp"

namespace spf {
namespace {

/// Where the outline is written, or the map itself.
const YamlNode& outline_in(const YamlNode& map) {
  for (const char* key : {"footprint", "width", "length"})
    if (const YamlNode* node = map.find(key)) return *node;
  return map;
}

}  // namespace

void settle_footprint(const YamlNode* map, const std::string& key, RobotParameters& robot,
                      InputProblems& problems) {
  constexpr double kSame = 1e-4;  // [m] as written with few digits
  if (map == nullptr || !has_corners(robot)) return;
  const std::string problem = footprint_problem(robot);
  if (!problem.empty()) {
    problems.add(outline_in(*map).location, key + "." + problem, key);
    robot.length = robot.width = 0.0;
    robot.footprint.clear();
    return;
  }
  const double around = Footprint{robot}.circumscribed_radius();
  const YamlNode* radius = map->find("radius");
  if (radius != nullptr && std::abs(robot.radius - around) > kSame)
    problems.add(radius->location,
                 key + ".radius = " + shown(*radius) + " must be left out, or be " + to_text(around) +
                     " m: so far are the robot's corners from its centre",
                 key);
  robot.radius = around;
}

}  // namespace spf
