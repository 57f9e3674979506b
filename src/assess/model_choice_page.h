#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace gonio {

/// The model that `auto` takes for each bundled measurement, beside a diffuse part with one Ward lobe: README.md, choices.csv and a chart of
/// the errors of left-out scans.
void write_model_choice(const std::filesystem::path& folder, const std::function<void(const std::string&)>& progress);

}  // namespace gonio
