#include "fit/formats/formats.h"

#include <algorithm>
#include <array>
#include <fstream>

#include "base/error.h"
#include "base/files.h"
#include "fit/formats/bsdf_xml.h"
#include "fit/formats/ddr.h"
#include "fit/formats/readers.h"
#include "fit/formats/rgl.h"

namespace gonio {
namespace {

constexpr std::size_t kHead = 4096;
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 30;

/// The first bytes alone; a larger file than any format's is refused before it is read.
std::string head_of(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > kMostBytes)
    throw input_error("{}: offset {}: the file goes on to {} bytes; expected at most 1 GiB", path.string(), kMostBytes,
                      size);
  std::ifstream in(path, std::ios::binary);
  std::string head(kHead, '\0');
  in.read(head.data(), static_cast<std::streamsize>(kHead));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
  return head;
}

/// By ending and first bytes, by these alone, or by an ending that one format has to itself: its reader then says what is wrong.
const Format* recognised(const std::string& extension, std::string_view head) {
  for (const bool by_extension : {true, false})
    for (const Format& known : formats())
      if ((!by_extension || extension == known.extension) && known.recognises(head)) return &known;
  const Format* named = nullptr;
  for (const Format& known : formats()) {
    if (extension != known.extension || extension == ".txt") continue;
    if (named != nullptr) return nullptr;
    named = &known;
  }
  return named;
}

std::string names() {
  std::string all = "csv";
  for (const Format& format : formats()) all += fmt::format(", {}", format.name);
  return all;
}

}  // namespace

std::span<const Format> formats() {
  static const std::array all{
      Format{"astm", ".astm", "ASTM E1392 and E2387 text", is_astm, read_astm},
      Format{"zemax", ".bsdf", "Zemax (Radiant Imaging) tabular BSDF", is_zemax, read_zemax},
      Format{"lighttools", ".bsdf", "LightTools BSDF text", is_lighttools, read_lighttools},
      Format{"alta", ".alta", "ALTA text", is_alta, read_alta},
      Format{"ssdd", ".ssdd", "Surface Scattering Distribution Data", is_ssdd, read_ssdd},
      Format{"table", ".txt", "plain table of angles whose comments say how to read it", is_angle_table,
             read_angle_table},
      Format{"merl", ".binary", "MERL BRDF database", is_merl, read_merl},
      Format{"rgl", ".bsdf", "RGL material database, tensor file (Dupuy & Jakob 2018)",
             [](std::string_view head) { return head.starts_with(std::string_view("tensor_file\0", 12)); }, read_rgl},
      Format{
          "ddr", ".ddr", "Integra diffuse distribution, text",
          [](std::string_view head) { return head.find("TypeSym") != head.npos && head.find("TypeData") != head.npos; },
          read_ddr},
      Format{"bsdf-xml", ".xml", "Radiance/LBNL BSDF, Klems matrix or tensor tree",
             [](std::string_view head) { return head.find("<WindowElement") != head.npos; }, read_bsdf_xml},
  };
  return all;
}

const Format& format_named(std::string_view name) {
  for (const Format& format : formats())
    if (format.name == name) return format;
  throw input_error("{}: unknown format; expected one of {}", name, names());
}

const Format* format_of(const std::filesystem::path& path) {
  return recognised(path.extension().string(), head_of(path));
}

Measurement read_any(const std::filesystem::path& path, const std::optional<std::string>& format) {
  std::error_code error;
  const bool ours = std::filesystem::is_directory(path, error) || path.extension() == ".csv";
  if (format ? *format == "csv" : ours) return read_measurement(path);
  const Format* known = format ? &format_named(*format) : format_of(path);
  if (known == nullptr) return read_measurement(path);
  Measurement scan = known->read(read_file(path), path.string());
  scan.id = path.stem().string();
  return scan;
}

}  // namespace gonio
