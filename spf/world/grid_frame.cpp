#include "spf/world/grid_frame.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace spf {
namespace {

constexpr double kMaxNodes = 67108864.0;  // 2^26

int clamped_index(double coordinate, int count) {
  if (!(coordinate > 0.0)) return 0;
  return static_cast<int>(std::lround(std::min(coordinate, static_cast<double>(count - 1))));
}

std::string text_of(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double resolution) {
  std::ostringstream text;
  text << "low = (" << low.x() << ", " << low.y() << ") m, high = (" << high.x() << ", " << high.y()
       << ") m, resolution = " << resolution << " m";
  return text.str();
}

}  // namespace

GridFrame GridFrame::covering(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double resolution) {
  const bool usable = low.allFinite() && high.allFinite() && (high.array() >= low.array()).all() &&
                      std::isfinite(resolution) && resolution > 0.0;
  if (!usable)
    throw std::invalid_argument("grid frame: needs low <= high, finite, and a resolution > 0, not " +
                                text_of(low, high, resolution));
  // A rectangle that is a whole number of cells wide must not gain a column from rounding.
  constexpr double kRounding = 1e-9;
  const Eigen::Vector2d cells = ((high - low) / resolution).array() - kRounding;
  if ((cells.x() + 2.0) * (cells.y() + 2.0) > kMaxNodes) {
    throw std::invalid_argument("grid frame: more than 2^26 nodes in " + text_of(low, high, resolution) +
                                "; use a coarser resolution");
  }
  const int width = static_cast<int>(std::ceil(std::max(cells.x(), 0.0))) + 1;
  const int height = static_cast<int>(std::ceil(std::max(cells.y(), 0.0))) + 1;
  return {low, resolution, width, height};
}

Eigen::Vector2i GridFrame::nearest_node(const Eigen::Vector2d& position_world) const {
  return {clamped_index((position_world.x() - origin_world.x()) / resolution, width),
          clamped_index((position_world.y() - origin_world.y()) / resolution, height)};
}

void check_frame(const GridFrame& frame) {
  const bool usable =
      frame.width > 0 && frame.height > 0 && static_cast<double>(frame.width) * frame.height <= kMaxNodes &&
      std::isfinite(frame.resolution) && frame.resolution > 0.0 && frame.origin_world.allFinite();
  if (usable) return;
  std::ostringstream reason;
  reason << "grid frame: " << frame.width << " x " << frame.height << " nodes of " << frame.resolution
         << " m; needs 1 to 2^26 nodes and a finite resolution > 0";
  throw std::invalid_argument(reason.str());
}

}  // namespace spf
