// Pictures of maps: refused in words, or as many pixels as they announce, which make a map or a reason why
// not.
#include <stdexcept>

#include "fuzz/fuzz_input.hpp"
#include "sim/static_map.hpp"
#include "study/grey_image.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spf;
  GreyImage image;
  const ImageFailure failure = read_image(fuzz::text_of(data, size), image);
  if (!failure.sentence.empty()) return 0;
  fuzz::require(image.width * image.height == image.brightness.size(), "every pixel is there");
  fuzz::require(image.transparent.empty() || image.transparent.size() == image.brightness.size(),
                "and known to be opaque or not");
  std::vector<std::int8_t> cells;
  for (const std::uint8_t brightness : image.brightness) cells.push_back(brightness < 100 ? 100 : 0);
  try {
    const sim::StaticMap map{{{1.0, 2.0}, 0.3}, 0.05, image.width, image.height, std::move(cells)};
    fuzz::require(map.faces().size() <= sim::StaticMap::kMostFaces, "a map has few faces");
  } catch (const std::invalid_argument&) {  // noise
  }
  return 0;
}
