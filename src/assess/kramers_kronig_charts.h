#pragma once
#include <filesystem>

namespace gonio {

/// Writes what kramers_kronig_cut.h measures into a folder: cut.csv, decay.csv, cut.svg, decay.svg, gold.svg,
/// README.md.
void write_kramers_kronig_charts(const std::filesystem::path& folder);

}  // namespace gonio
