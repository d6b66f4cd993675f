// PNG by libpng.
#pragma once

#include <string>
#include <string_view>

#include "study/grey_image.hpp"

namespace spf {

/// Reads bytes that begin as a PNG does. What is wrong, or "".
[[nodiscard]] std::string read_png(std::string_view bytes, GreyImage& image);

}  // namespace spf
