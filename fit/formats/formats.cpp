#include "fit/formats/formats.h"

#include <array>

#include "base/error.h"
#include "base/files.h"
#include "fit/formats/bsdf_xml.h"
#include "fit/formats/ddr.h"
#include "fit/formats/rgl.h"

namespace gonio {

std::span<const Format> formats() {
  static const std::array<Format, 3> all{{
      {"rgl", ".bsdf", "RGL material database, tensor file (Dupuy & Jakob 2018)",
       [](std::string_view head) { return head.starts_with(std::string_view("tensor_file\0", 12)); }, read_rgl},
      {"ddr", ".ddr", "Integra diffuse distribution, text",
       [](std::string_view head) { return head.find("TypeSym") != head.npos && head.find("TypeData") != head.npos; },
       read_ddr},
      {"bsdf-xml", ".xml", "Radiance/LBNL BSDF, Klems matrix or tensor tree",
       [](std::string_view head) { return head.find("<WindowElement") != head.npos; }, read_bsdf_xml},
  }};
  return all;
}

const Format& format_named(std::string_view name) {
  for (const Format& format : formats())
    if (format.name == name) return format;
  throw input_error("{}: unknown format", name);
}

Measurement read_any(const std::filesystem::path& path, const std::optional<std::string>& format) {
  if (format) return format_named(*format).read(read_file(path), path.string());
  if (std::filesystem::is_directory(path) || path.extension() == ".csv") return read_measurement(path);
  const std::string bytes = read_file(path);
  for (const Format& known : formats())
    if (path.extension() == known.extension && known.recognises(bytes.substr(0, 4096)))
      return known.read(bytes, path.string());
  for (const Format& known : formats())
    if (known.recognises(bytes.substr(0, 4096))) return known.read(bytes, path.string());
  return read_measurement(path);
}

}  // namespace gonio
