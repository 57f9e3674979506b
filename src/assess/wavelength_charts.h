#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace gonio {

/// How few wavelengths do: the ColorChecker and five metals with all their products, under lamps, against rules that do
/// not know the scene. Writes nodes.csv (what the search found), errors.csv, errors.svg, README.md and timing.csv into
/// a folder. `thorough`: also the long search for the counts that the page quotes. `progress`: a line a step.
void search_wavelengths(const std::filesystem::path& folder, bool thorough,
                        const std::function<void(const std::string&)>& progress);

/// The same page from the nodes.csv of an earlier search in `from`: every error is computed again, nothing is searched.
void write_wavelength_errors(const std::filesystem::path& from, const std::filesystem::path& folder);

}  // namespace gonio
