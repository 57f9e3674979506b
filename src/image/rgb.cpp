#include "image/rgb.h"

#include "materials/color_entries.h"
#include "spectrum/colorimetry.h"

namespace gonio {
namespace {

std::vector<std::array<double, 3>> grey(const SpectralImage& image) {
  std::vector<std::array<double, 3>> rgb;
  rgb.reserve(image.pixels());
  for (const double value : image.radiance) rgb.push_back({value, value, value});
  return rgb;
}

}  // namespace

std::vector<std::array<double, 3>> linear_srgb(const SpectralImage& image) {
  if (image.wavelength_nm.size() == 1) return grey(image);
  const ColorWeights weights = color_weights(image.wavelength_nm, observer_of(Database::bundled().find("1931-2")));
  std::vector<std::array<double, 3>> rgb;
  rgb.reserve(image.pixels());
  for (std::size_t p = 0; p < image.pixels(); ++p) {
    const Rgb<double> color = linear_srgb(weights.xyz(image.pixel(p).data()));
    rgb.push_back({color.r, color.g, color.b});
  }
  return rgb;
}

}  // namespace gonio
