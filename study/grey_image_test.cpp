#include "study/grey_image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

namespace spf {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A PNG of these channels, as libpng writes it.
std::string png_of(png_uint_32 format, png_uint_32 width, png_uint_32 height, const void* pixels) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.format = format;
  png.width = width;
  png.height = height;
  png_alloc_size_t size = 0;
  EXPECT_NE(png_image_write_to_memory(&png, nullptr, &size, 0, pixels, 0, nullptr), 0);
  std::string bytes(size, '\0');
  EXPECT_NE(png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels, 0, nullptr), 0);
  bytes.resize(size);
  return bytes;
}

std::string failure(const std::string& bytes) {
  GreyImage image;
  const ImageFailure found = read_image(bytes, image);
  return (found.line > 0 ? std::to_string(found.line) + ": " : "") + found.sentence;
}

TEST(GreyImage, ReadsPgmAsTextWithComments) {
  GreyImage image;
  const ImageFailure found =
      read_image("P2 # made by hand\n# width, height\n3 2\n10\n0 5 10 # the first row\n10\n1\n2\n", image);
  EXPECT_EQ(found.sentence, "");
  EXPECT_EQ(image.width, 3u);
  EXPECT_EQ(image.height, 2u);
  EXPECT_THAT(image.brightness, ElementsAre(0, 128, 255, 255, 26, 51));
  EXPECT_TRUE(image.transparent.empty());
}

TEST(GreyImage, ReadsPgmInBytesOfEitherSize) {
  GreyImage image;
  const std::string header = "P5\n# CREATOR: a map saver 0.050 m/pix\n2 2\n255\n";
  EXPECT_EQ(read_image(header + std::string{"\x00\x20\xCD\xFE", 4}, image).sentence, "");
  EXPECT_THAT(image.brightness, ElementsAre(0, 0x20, 0xCD, 0xFE));
  EXPECT_EQ(read_image(std::string{"P5 3 1 65535\n\x00\x00\x80\x00\xFF\xFF", 19}, image).sentence, "");
  EXPECT_THAT(image.brightness, ElementsAre(0, 128, 255));
}

TEST(GreyImage, ReadsPngOfAnyKind) {
  GreyImage image;
  const std::uint8_t grey[] = {0, 100, 205, 254};
  EXPECT_EQ(read_image(png_of(PNG_FORMAT_GRAY, 2, 2, grey), image).sentence, "");
  EXPECT_THAT(image.brightness, ElementsAre(0, 100, 205, 254));
  EXPECT_THAT(image.transparent, ElementsAre(false, false, false, false));
  // Colours are averaged, not weighted by how light they look; what is not fully opaque is marked.
  const std::uint8_t colours[] = {255, 0, 0, 255, 30, 60, 90, 255, 200, 200, 200, 254, 7, 7, 7, 0};
  EXPECT_EQ(read_image(png_of(PNG_FORMAT_RGBA, 4, 1, colours), image).sentence, "");
  EXPECT_EQ(image.brightness[0], 85);
  EXPECT_EQ(image.brightness[1], 60);
  EXPECT_THAT(image.transparent, ElementsAre(false, false, true, true));
}

TEST(GreyImage, RefusesByName) {
  EXPECT_EQ(failure("GIF89a"), "is no picture that can be read: must be PGM (P2 or P5) or PNG");
  EXPECT_EQ(failure("P2\n"), "2: ends before the width");
  EXPECT_EQ(failure("P2\n-3 2 255\n"), "2: the width = -3 must be a whole number in [1, 1000000]");
  EXPECT_EQ(failure("P5 3 2\n70000\n"), "2: the maxval = 70000 must be a whole number in [1, 65535]");
  EXPECT_EQ(failure("P5 3 2\n0\n"), "2: the maxval = 0 must be a whole number in [1, 65535]");
  EXPECT_EQ(failure("P5 100000 100000 255\n"), "1: has 100000 x 100000 pixels: must have at most 33554432");
  EXPECT_EQ(failure("P5 3 2 255\nabcde"), "holds 5 bytes of pixels, but 3 x 2 need 6");
  EXPECT_EQ(failure("P5 3 2 256\nabcdefghijk"), "holds 11 bytes of pixels, but 3 x 2 need 12");
  EXPECT_EQ(failure("P5 2 1 99\n\x05\x64"), "pixel 1 = 100 must be at most the maxval 99");
  EXPECT_EQ(failure("P2 2 2 9\n1 2\n3 10\n"), "3: a pixel = 10 must be a whole number in [0, 9]");
  EXPECT_EQ(failure("P2 2 2 9\n1 2\n3     \n"), "4: ends before a pixel");
  EXPECT_EQ(failure("P2 2000 2000 9\n1 2\n"), "1: holds too few pixels: 2000 x 2000 are announced");
  const std::uint8_t grey[] = {0, 100, 205, 254};
  const std::string good = png_of(PNG_FORMAT_GRAY, 2, 2, grey);
  EXPECT_THAT(failure(good.substr(0, good.size() / 2)), HasSubstr("is no good PNG: "));
  std::string huge = good;
  huge.replace(16, 4, std::string("\x00\x0F\x00\x00", 4));  // the width in its header
  EXPECT_NE(failure(huge), "");
}

TEST(GreyImage, ReadsOnlyWhatMakesThePicture) {
  const std::uint8_t grey[4] = {0, 100, 200, 255};
  const std::string plain = png_of(PNG_FORMAT_GRAY, 2, 2, grey);
  constexpr std::size_t kFirstChunkEnd = 8 + 25;  // the signature and IHDR
  // Text that would have to be unfolded, with a checksum that is wrong.
  const std::string text{"\0\0\0\4zTXtabcdXXXX", 16};
  GreyImage image;
  EXPECT_EQ(read_image(plain.substr(0, kFirstChunkEnd) + text + plain.substr(kFirstChunkEnd), image).sentence,
            "");
  EXPECT_THAT(image.brightness, testing::ElementsAreArray(grey));
  // One that is longer than the file.
  const std::string cut{"\x7F\xFF\xFF\xFFzTXtabcdXXXX", 16};
  EXPECT_NE(read_image(plain.substr(0, kFirstChunkEnd) + cut, image).sentence, "");
}

}  // namespace
}  // namespace spf
