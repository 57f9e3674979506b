#pragma once
// fit/formats: the measured formats of others, each from its published description: readers, strict, and writers.
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "fit/scan.h"

namespace gonio {

/// A foreign format. A reader takes the whole file and fills a Measurement, its `conventions` included; InputError
/// `file:line: …` (text) or `file: offset N: …` (binary) for anything it cannot take whole.
struct Format {
  std::string_view name, extension, what;
  bool (*recognises)(std::string_view head);  ///< from the first kilobytes alone
  Measurement (*read)(std::string_view bytes, const std::string& file);
};

/// All of them.
std::span<const Format> formats();
/// InputError for an unknown name.
const Format& format_named(std::string_view name);

/// The format that a file looks like by its extension and first bytes, or by these alone; null for none.
const Format* format_of(const std::filesystem::path& path);

/// A measurement in any format: a folder or CSV of ours, or a foreign file, known by its first bytes and its extension (or `format`).
Measurement read_any(const std::filesystem::path& path, const std::optional<std::string>& format = {});

}  // namespace gonio
