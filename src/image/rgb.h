#pragma once
#include <array>
#include <vector>

#include "image/spectral_image.h"

namespace gonio {

/// Linear sRGB of each pixel, by the CIE 1931 2° observer: a constant spectrum of radiance 1 has Y = 1. An image of one
/// wavelength is grey in proportion to its radiance. Values may be negative or above 1 (not clipped).
std::vector<std::array<double, 3>> linear_srgb(const SpectralImage& image);

}  // namespace gonio
