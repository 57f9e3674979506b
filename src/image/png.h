#pragma once
#include <filesystem>

#include "image/spectral_image.h"

namespace gonio {

/// 8-bit sRGB (IEC 61966-2-1). Linear values are multiplied by the exposure, then clipped to 0-1: 1 becomes white.
/// The file appears whole or not at all. InputError when it cannot be written.
void write_png(const std::filesystem::path& path, const SpectralImage& image, double exposure);

}  // namespace gonio
