// Colours of markers.
#pragma once

#include <std_msgs/ColorRGBA.h>

namespace spf_empc_ros {

[[nodiscard]] inline std_msgs::ColorRGBA color(float red, float green, float blue, float alpha = 1.0F) {
  std_msgs::ColorRGBA result;
  result.r = red;
  result.g = green;
  result.b = blue;
  result.a = alpha;
  return result;
}

}  // namespace spf_empc_ros
