// Pictures in which maps are stored: PGM (P2 and P5) and PNG. Colours are averaged; what is transparent is
// marked. Bounded: what a picture claims of itself is checked before memory is taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace spf {

struct GreyImage {
  static constexpr std::size_t kMostPixels = std::size_t{1} << 25;

  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint8_t> brightness;  ///< row by row, the topmost first: 0 is black, 255 white
  std::vector<bool> transparent;         ///< likewise: not fully opaque; empty: none is
};

struct ImageFailure {
  int line = 0;          ///< of a text format, counted from 1; 0 = the file as a whole
  std::string sentence;  ///< what is wrong with which value, and its limit; empty: nothing
};

/// Whether bytes begin as such a picture does.
[[nodiscard]] bool looks_like_image(std::string_view bytes);

/// Reads a picture of either format, whatever its file is called.
[[nodiscard]] ImageFailure read_image(std::string_view bytes, GreyImage& image);

}  // namespace spf
