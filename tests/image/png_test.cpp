#include "image/png.h"

#include <png.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>

#include "base/error.h"
#include "catch.h"

using namespace gonio;

namespace {

std::vector<unsigned char> read_bytes(const std::filesystem::path& path, unsigned& width, unsigned& height) {
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_file(&header, path.c_str()));
  header.format = PNG_FORMAT_RGB;
  std::vector<unsigned char> bytes(PNG_IMAGE_SIZE(header));
  REQUIRE(png_image_finish_read(&header, nullptr, bytes.data(), 0, nullptr));
  width = header.width;
  height = header.height;
  return bytes;
}

}  // namespace

TEST_CASE("PNG: sRGB's published codes, exposure, clipping", "[image]") {
  SpectralImage image(3, 2, {550});
  image.radiance = {0, 0.5, 1, 2, -1, 0.0015};
  const auto path = std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + "_test.png");
  unsigned width = 0, height = 0;
  // sRGB (IEC 61966-2-1) codes: linear 0.5 is 188, 0.25 is 137, 0.0015 lies on the linear branch: 12.92 · 0.0015 · 255
  // = 4.9.
  write_png(path, image, 1);
  auto bytes = read_bytes(path, width, height);
  CHECK(width == 3);
  CHECK(height == 2);
  const std::vector<int> expected{0, 188, 255, 255, 0, 5}, halved{0, 137, 188, 255, 0, 2};
  for (std::size_t p = 0; p < 6; ++p)
    for (std::size_t c = 0; c < 3; ++c) CHECK(int(bytes[3 * p + c]) == expected[p]);
  write_png(path, image, 0.5);
  bytes = read_bytes(path, width, height);
  for (std::size_t p = 0; p < 6; ++p) CHECK(int(bytes[3 * p]) == halved[p]);
  std::filesystem::remove(path);
  CHECK_THROWS_AS(write_png(path.parent_path() / "no_such_folder" / "a.png", image, 1), InputError);
}
