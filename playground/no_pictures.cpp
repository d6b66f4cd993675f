// Stands for study/png_image.cpp where there is no libpng: maps are files, of which a browser has none.
#include "study/png_image.hpp"

namespace spf {

std::string read_png(std::string_view, GreyImage&) {
  return "PNG pictures are not read in a browser";
}

}  // namespace spf
