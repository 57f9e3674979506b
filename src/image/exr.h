#pragma once
#include <filesystem>
#include <string>

#include "image/spectral_image.h"

namespace gonio {

/// Name of the channel of Stokes component S0 at a wavelength: `S0.550,000000nm` (decimal comma).
std::string exr_channel_name(double wavelength_nm);

/// OpenEXR in the layout of Fichet, Pacanowski & Wilkie, "An OpenEXR Layout for Spectral Images", JCGT 10(3), 2021:
/// one float channel a wavelength, attributes spectralLayoutVersion "1.0" and emissiveUnits "W.m^-2.sr^-1"; and
/// channels R, G, B (linear sRGB) for ordinary viewers. The file appears whole or not at all. InputError when it cannot
/// be written.
void write_spectral_exr(const std::filesystem::path& path, const SpectralImage& image);

/// Reads the S0 channels of such a file. InputError when it is no OpenEXR file or has none.
SpectralImage read_spectral_exr(const std::filesystem::path& path);

}  // namespace gonio
