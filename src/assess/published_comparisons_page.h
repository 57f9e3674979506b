#pragma once
#include <filesystem>

namespace gonio {

/// The page `published-comparisons`: README.md, claims.csv, curves.csv and the plots.
void write_published_comparisons(const std::filesystem::path& folder);

}  // namespace gonio
