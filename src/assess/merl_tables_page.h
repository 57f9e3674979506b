#pragma once
#include <filesystem>

namespace gonio {

/// The page `merl-tables`: README.md, values.csv, deviations.csv and a contact sheet of every material.
void write_merl_tables(const std::filesystem::path& folder);

}  // namespace gonio
