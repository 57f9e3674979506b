#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace gonio {

/// Accuracy against cost of every model and variant: CSV tables, SVG charts with the Pareto front, README.md. About two minutes,
/// one line to `progress` a step. Times are this machine's; errors are against 50 digits.
void write_brdf_speed(const std::filesystem::path& folder, const std::function<void(const std::string&)>& progress);

}  // namespace gonio
