#include "fit/formats/formats.h"

#include <array>

#include "base/error.h"
#include "base/files.h"

namespace gonio {

std::span<const Format> formats() {
  static const std::array<Format, 0> all{};
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
    if (path.extension() == known.extension && known.recognises(bytes.substr(0, 4096))) return known.read(bytes, path.string());
  for (const Format& known : formats())
    if (known.recognises(bytes.substr(0, 4096))) return known.read(bytes, path.string());
  return read_measurement(path);
}

}  // namespace gonio
