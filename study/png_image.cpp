#include "study/png_image.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

namespace spf {
namespace {

/// Frees what libpng keeps of a picture, however it is left.
struct PngFree {
  void operator()(png_image* image) const { png_image_free(image); }
};

std::size_t big_endian(std::string_view bytes) {
  std::size_t number = 0;
  for (const char byte : bytes.substr(0, 4)) number = (number << 8U) | static_cast<unsigned char>(byte);
  return number;
}

/// The chunks that make the picture. Others may unfold to gigabytes of text, or have libpng convert
/// brightness that is meant as it is. What follows a chunk that does not fit is left to libpng to refuse.
std::string chunks_of_picture(std::string_view bytes) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kFrame = 12;  // length, name and checksum
  constexpr std::array<std::string_view, 5> kNeeded{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
  std::string kept{bytes.substr(0, kSignature)};
  std::size_t at = kept.size();
  while (bytes.size() - at >= kFrame) {
    const std::size_t size = kFrame + big_endian(bytes.substr(at));
    if (size > bytes.size() - at) break;
    if (std::find(kNeeded.begin(), kNeeded.end(), bytes.substr(at + 4, 4)) != kNeeded.end())
      kept += bytes.substr(at, size);
    at += size;
  }
  return kept += bytes.substr(at);
}

}  // namespace

std::string read_png(std::string_view file, GreyImage& image) {
  const std::string bytes = chunks_of_picture(file);
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
