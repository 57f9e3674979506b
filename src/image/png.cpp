#include "image/png.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "base/files.h"
#include "image/rgb.h"

namespace gonio {
namespace {

/// Transfer curve of IEC 61966-2-1, to 8 bits.
unsigned char encoded(double linear) {
  const double value = std::clamp(linear, 0.0, 1.0);
  const double signal = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  return static_cast<unsigned char>(std::lround(255 * signal));
}

}  // namespace

void write_png(const std::filesystem::path& path, const SpectralImage& image, double exposure) {
  std::vector<unsigned char> bytes;
  bytes.reserve(3 * image.pixels());
  for (const auto& pixel : linear_srgb(image))
    for (const double channel : pixel) bytes.push_back(encoded(exposure * channel));

  WholeFile file(path);
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  if (!png_image_write_to_file(&header, file.temporary().c_str(), 0, bytes.data(), 0, nullptr))
    throw input_error("{}: writing the PNG failed ({}); expected enough space on the disk", path.string(),
                      header.message);
  file.commit();
}

}  // namespace gonio
