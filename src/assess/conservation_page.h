#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace gonio {

/// The page `conservation-limits`: what kd and ks may be, for every metal of the database, and what rooms look like inside, at and beyond
/// the limit: README.md, limits.csv, rooms.csv, charts and pictures.
void write_conservation_limits(const std::filesystem::path& folder,
                               const std::function<void(const std::string&)>& progress);

}  // namespace gonio
