#include "image/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <unistd.h>

#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "catch.h"
#include "image/rgb.h"

using namespace gonio;

namespace {

std::filesystem::path temporary(const std::string& name) {
  return std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + name);
}

SpectralImage pattern(std::vector<double> wavelengths) {
  SpectralImage image(5, 3, std::move(wavelengths));
  for (std::size_t v = 0; v < image.radiance.size(); ++v)
    image.radiance[v] = 0.125 + 0.0625 * static_cast<double>(v % 97);
  return image;
}

}  // namespace

TEST_CASE("channel names follow the spectral layout: S0, decimal comma, nm", "[image]") {
  CHECK(exr_channel_name(550) == "S0.550,000000nm");
  CHECK(exr_channel_name(632.8) == "S0.632,800000nm");
}

TEST_CASE("a spectral EXR has the published channels and attributes and gives its values back", "[image]") {
  const auto path = temporary("gonio_exr_test.exr");
  const SpectralImage image = pattern({400, 500.5, 600});
  write_spectral_exr(path, image);
  {
    Imf::InputFile in(path.c_str());
    std::vector<std::string> names;
    for (auto c = in.header().channels().begin(); c != in.header().channels().end(); ++c) names.emplace_back(c.name());
    CHECK(names == std::vector<std::string>{"B", "G", "R", "S0.400,000000nm", "S0.500,500000nm", "S0.600,000000nm"});
    CHECK(in.header().typedAttribute<Imf::StringAttribute>("spectralLayoutVersion").value() == "1.0");
    CHECK(in.header().typedAttribute<Imf::StringAttribute>("emissiveUnits").value() == "W.m^-2.sr^-1");
    CHECK(in.header().findTypedAttribute<Imf::StringAttribute>("capDate") == nullptr);
  }
  const SpectralImage back = read_spectral_exr(path);
  CHECK(back.width == 5);
  CHECK(back.height == 3);
  CHECK(back.wavelength_nm == image.wavelength_nm);
  CHECK(back.radiance == image.radiance);  // multiples of 1/16 are exact in float
  std::filesystem::remove(path);
}

TEST_CASE("the same image makes the same bytes", "[image]") {
  const auto one = temporary("gonio_exr_one.exr"), two = temporary("gonio_exr_two.exr");
  write_spectral_exr(one, pattern({400, 500, 600}));
  write_spectral_exr(two, pattern({400, 500, 600}));
  CHECK(read_file(one) == read_file(two));
  std::filesystem::remove(one);
  std::filesystem::remove(two);
}

TEST_CASE("one wavelength is grey; an equal-energy spectrum has luminance 1", "[image]") {
  for (const auto& rgb : linear_srgb(pattern({532}))) {
    CHECK(rgb[0] == rgb[1]);
    CHECK(rgb[1] == rgb[2]);
  }
  SpectralImage flat(1, 1, {});
  for (int nm = 390; nm <= 700; nm += 10) flat.wavelength_nm.push_back(nm);
  flat.radiance.assign(flat.wavelength_nm.size(), 1);
  const auto rgb = linear_srgb(flat).front();
  // Luminance of Rec. 709 primaries. Equal energy is warmer than D65: its published linear sRGB is (1.205, 0.948,
  // 0.909).
  CHECK(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2] == Approx(1).margin(2e-4));
  CHECK(rgb[0] == Approx(1.205).margin(5e-3));
  CHECK(rgb[1] == Approx(0.948).margin(5e-3));
  CHECK(rgb[2] == Approx(0.909).margin(5e-3));
}

TEST_CASE("what is no spectral EXR is refused, and nothing is left where nothing can be written", "[image]") {
  const auto path = temporary("gonio_exr_bad.exr");
  write_file(path, "no image at all");
  CHECK_THROWS_AS(read_spectral_exr(path), InputError);
  write_spectral_exr(path, pattern({550}));
  write_file(path, read_file(path).substr(0, 300));
  CHECK_THROWS_AS(read_spectral_exr(path), InputError);
  std::filesystem::remove(path);
  CHECK_THROWS_AS(read_spectral_exr(path), InputError);
  CHECK_THROWS_AS(write_spectral_exr(temporary("no_such_folder") / "a.exr", pattern({550})), InputError);
}
