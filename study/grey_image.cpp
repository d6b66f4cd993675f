#include "study/grey_image.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>

#include "study/png_image.hpp"

namespace spf {
namespace {

constexpr std::string_view kPngSignature{"\x89PNG\r\n\x1a\n", 8};
constexpr int kLargestMaxval = 65535;

bool is_blank(char character) {
  constexpr std::string_view kBlank{" \t\r\n\v\f"};
  return kBlank.find(character) != std::string_view::npos;
}

bool is_pgm(std::string_view bytes) {
  return (bytes.starts_with("P2") || bytes.starts_with("P5")) && bytes.size() > 2 &&
         (is_blank(bytes[2]) || bytes[2] == '#');
}

/// Reads a PGM from its beginning on; keeps the first thing that is wrong.
class PgmReader {
 public:
  explicit PgmReader(std::string_view bytes) : bytes_{bytes} {}

  ImageFailure read(GreyImage& image) {
    const bool binary = bytes_[1] == '5';
    at_ = 2;
    const std::optional<int> width = number("the width", 1, 1'000'000);
    const std::optional<int> height = width ? number("the height", 1, 1'000'000) : std::nullopt;
    const std::optional<int> maxval = height ? number("the maxval", 1, kLargestMaxval) : std::nullopt;
    if (!maxval) return failure_;
    image.width = static_cast<std::size_t>(*width);
    image.height = static_cast<std::size_t>(*height);
    maxval_ = *maxval;
    const std::size_t pixels = image.width * image.height;
    if (pixels > GreyImage::kMostPixels)
      refuse("has " + std::to_string(*width) + " x " + std::to_string(*height) +
             " pixels: must have at most " + std::to_string(GreyImage::kMostPixels));
    else if (binary)
      read_bytes(pixels, image);
    else
      read_text(pixels, image);
    return failure_;
  }

 private:
  void refuse(std::string sentence) {
    if (failure_.sentence.empty()) failure_ = {line_, std::move(sentence)};
  }

  /// Passes blanks, and comments from a # to the end of its line.
  void skip_blanks() {
    bool comment = false;
    for (; at_ < bytes_.size(); ++at_) {
      const char here = bytes_[at_];
      if (here == '\n') {
        ++line_;
        comment = false;
      } else if (here == '#') {
        comment = true;
      } else if (!comment && !is_blank(here)) {
        return;
      }
    }
  }

  std::optional<int> number(const char* name, int low, int high) {
    skip_blanks();
    const char* begin = bytes_.data() + at_;
    const char* end = bytes_.data() + bytes_.size();
    const char* stop = std::find_if(begin, end, [](char c) { return is_blank(c) || c == '#'; });
    constexpr std::ptrdiff_t kShownDigits = 20;
    int value = 0;
    const auto [rest, error] = std::from_chars(begin, stop, value);
    if (begin == end) {
      refuse(std::string{"ends before "} + name);
    } else if (error != std::errc{} || rest != stop || value < low || value > high) {
      refuse(std::string{name} + " = " + std::string{begin, begin + std::min(stop - begin, kShownDigits)} +
             " must be a whole number in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
    } else {
      at_ = static_cast<std::size_t>(stop - bytes_.data());
      return value;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::uint8_t brightness(int value) const {
    return static_cast<std::uint8_t>((255 * value + maxval_ / 2) / maxval_);
  }

  /// After the header comes one blank, then the values in one byte each, or two, the larger first.
  void read_bytes(std::size_t pixels, GreyImage& image) {
    const std::size_t size = maxval_ < 256 ? 1 : 2;
    at_ = std::min(at_ + 1, bytes_.size());
    line_ = 0;
    const std::size_t there = bytes_.size() - at_;
    if (there < size * pixels)
      return refuse("holds " + std::to_string(there) + " bytes of pixels, but " +
                    std::to_string(image.width) + " x " + std::to_string(image.height) + " need " +
                    std::to_string(size * pixels));
    image.brightness.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      int value = 0;
      for (std::size_t k = 0; k < size; ++k)
        value = 256 * value + static_cast<unsigned char>(bytes_[at_ + size * i + k]);
      if (value > maxval_)
        return refuse("pixel " + std::to_string(i) + " = " + std::to_string(value) +
                      " must be at most the maxval " + std::to_string(maxval_));
      image.brightness[i] = brightness(value);
    }
  }

  void read_text(std::size_t pixels, GreyImage& image) {
    if (bytes_.size() - at_ < pixels)  // a digit each, before memory is taken for them
      return refuse("holds too few pixels: " + std::to_string(image.width) + " x " +
                    std::to_string(image.height) + " are announced");
    image.brightness.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      const std::optional<int> value = number("a pixel", 0, maxval_);
      if (!value) return;
      image.brightness[i] = brightness(*value);
    }
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  int line_ = 1;
  int maxval_ = 255;
  ImageFailure failure_;
};

}  // namespace

bool looks_like_image(std::string_view bytes) {
  return is_pgm(bytes) || bytes.starts_with(kPngSignature);
}

ImageFailure read_image(std::string_view bytes, GreyImage& image) {
  image = {};
  if (bytes.starts_with(kPngSignature)) return {0, read_png(bytes, image)};
  if (is_pgm(bytes)) return PgmReader{bytes}.read(image);
  return {0, "is no picture that can be read: must be PGM (P2 or P5) or PNG"};
}

}  // namespace spf
