#pragma once
#include <filesystem>

namespace gonio {

/// Writes what interpolation loses on the bundled data (interpolation_error.h) into a folder: errors.csv (every column
/// of every entry), classes.csv, errors.svg, README.md. No timings: the files are the same on every run.
void write_interpolation_errors(const std::filesystem::path& folder);

/// The same, and what a lookup costs on this machine: speed.csv, speed.svg.
void write_interpolation_speed(const std::filesystem::path& folder);

}  // namespace gonio
