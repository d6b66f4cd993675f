#include "study/png_image.hpp"

#include <png.h>

#include <memory>

namespace spf {
namespace {

/// Frees what libpng keeps of a picture, however it is left.
struct PngFree {
  void operator()(png_image* image) const { png_image_free(image); }
};

}  // namespace

std::string read_png(std::string_view bytes, GreyImage& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, PngFree> owner{&png};
  const auto refusal = [&png] { return std::string{"is no good PNG: "} + png.message; };
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) return refusal();
  const std::size_t pixels = std::size_t{png.width} * std::size_t{png.height};
  if (pixels > GreyImage::kMostPixels)
    return "has " + std::to_string(png.width) + " x " + std::to_string(png.height) +
           " pixels: must have at most " + std::to_string(GreyImage::kMostPixels);
  // Values of 16 bits are meant as those of 8 are, not as light that is to be converted.
  png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  png.format = PNG_FORMAT_RGBA;
  constexpr std::size_t kChannels = 4;
  std::vector<std::uint8_t> colours(kChannels * pixels);
  if (png_image_finish_read(&png, nullptr, colours.data(), 0, nullptr) == 0) return refusal();
  image.width = png.width;
  image.height = png.height;
  image.brightness.resize(pixels);
  image.transparent.assign(pixels, false);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint8_t* colour = &colours[kChannels * i];
    const int sum = colour[0] + colour[1] + colour[2];
    image.brightness[i] = static_cast<std::uint8_t>((sum + 1) / 3);
    image.transparent[i] = colour[3] != 255;
  }
  return "";
}

}  // namespace spf
