#include "image/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "base/files.h"
#include "image/rgb.h"

namespace gonio {
namespace {

constexpr std::size_t kFloat = sizeof(float);

/// Planes of one channel each, as OpenEXR wants them.
struct Planes {
  std::size_t pixels;
  std::vector<std::vector<float>> planes;

  float* add() { return planes.emplace_back(pixels).data(); }
};

Imf::Slice slice(float* plane, int width) {
  return {Imf::FLOAT, reinterpret_cast<char*>(plane), kFloat, kFloat * static_cast<std::size_t>(width)};
}

/// The wavelength behind `S0.550,000000nm`; nothing for another channel.
std::optional<double> wavelength_of(std::string_view channel) {
  constexpr std::string_view kStart = "S0.", kEnd = "nm";
  if (!channel.starts_with(kStart) || !channel.ends_with(kEnd)) return {};
  std::string number(channel.substr(kStart.size(), channel.size() - kStart.size() - kEnd.size()));
  std::replace(number.begin(), number.end(), ',', '.');
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size()) return {};
  return value;
}

}  // namespace

std::string exr_channel_name(double wavelength_nm) {
  std::string name = fmt::format("S0.{:.6f}nm", wavelength_nm);
  name[name.rfind('.')] = ',';
  return name;
}

void write_spectral_exr(const std::filesystem::path& path, const SpectralImage& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.insert("spectralLayoutVersion", Imf::StringAttribute("1.0"));
  header.insert("emissiveUnits", Imf::StringAttribute("W.m^-2.sr^-1"));
  Imf::addChromaticities(header, Imf::Chromaticities());  // Rec. 709 = sRGB primaries, D65 white

  Imf::FrameBuffer frame;
  Planes planes{image.pixels(), {}};
  const auto add = [&](const std::string& name, auto value_at) {
    float* plane = planes.add();
    for (std::size_t p = 0; p < image.pixels(); ++p) plane[p] = static_cast<float>(value_at(p));
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, slice(plane, image.width));
  };
  const std::size_t wavelengths = image.wavelength_nm.size();
  for (std::size_t w = 0; w < wavelengths; ++w)
    add(exr_channel_name(image.wavelength_nm[w]), [&](std::size_t p) { return image.radiance[p * wavelengths + w]; });
  const auto rgb = linear_srgb(image);
  constexpr const char* kRgb[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) add(kRgb[c], [&](std::size_t p) { return rgb[p][c]; });

  WholeFile file(path);
  try {
    Imf::OutputFile out(file.temporary().c_str(), header);
    out.setFrameBuffer(frame);
    out.writePixels(image.height);
  } catch (const std::exception& error) {
    throw input_error("{}: writing the OpenEXR file failed ({}); expected enough space on the disk", path.string(),
                      error.what());
  }
  file.commit();
}

SpectralImage read_spectral_exr(const std::filesystem::path& path) try {
  Imf::InputFile in(path.c_str());
  const Imath::Box2i window = in.header().dataWindow();
  std::map<double, std::string> channels;
  for (auto c = in.header().channels().begin(); c != in.header().channels().end(); ++c)
    if (const auto wavelength = wavelength_of(c.name())) channels[*wavelength] = c.name();
  if (channels.empty()) throw input_error("{}: has no channel S0.…nm; expected a spectral image", path.string());

  std::vector<double> wavelengths;
  for (const auto& [wavelength, name] : channels) wavelengths.push_back(wavelength);
  SpectralImage image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, wavelengths);
  Imf::FrameBuffer frame;
  Planes planes{image.pixels(), {}};
  for (const auto& [wavelength, name] : channels)
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, planes.add(), window));
  in.setFrameBuffer(frame);
  in.readPixels(window.min.y, window.max.y);
  for (std::size_t w = 0; w < wavelengths.size(); ++w)
    for (std::size_t p = 0; p < image.pixels(); ++p)
      image.radiance[p * wavelengths.size() + w] = static_cast<double>(planes.planes[w][p]);
  return image;
} catch (const InputError&) {
  throw;
} catch (const std::exception& error) {
  throw input_error("{}: cannot be read as OpenEXR ({}); expected a spectral image", path.string(), error.what());
}

}  // namespace gonio
