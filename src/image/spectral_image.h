#pragma once
// image: spectral images, their files (OpenEXR in the published spectral layout, PNG) and their colours.
#include <cstddef>
#include <span>
#include <vector>

namespace gonio {

/// Radiance per pixel and wavelength, W·m⁻²·sr⁻¹ (per nm, in the unit the scene's lights are given in). Rows run from
/// the top; the wavelengths of a pixel lie together.
struct SpectralImage {
  int width = 0, height = 0;
  std::vector<double> wavelength_nm;  ///< increasing
  std::vector<double> radiance;       ///< radiance[(y·width + x)·wavelengths + w]

  SpectralImage() = default;
  SpectralImage(int width, int height, std::vector<double> wavelengths)
      : width(width),
        height(height),
        wavelength_nm(std::move(wavelengths)),
        radiance(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * wavelength_nm.size()) {}

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  std::span<double> pixel(std::size_t p) { return {&radiance[p * wavelength_nm.size()], wavelength_nm.size()}; }
  std::span<const double> pixel(std::size_t p) const {
    return {&radiance[p * wavelength_nm.size()], wavelength_nm.size()};
  }
};

}  // namespace gonio
