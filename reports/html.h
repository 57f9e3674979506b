#pragma once
// reports: what writes reports, and the published ones.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gonio::html {

std::string escape(std::string_view text);
/// <figure> with the file's bytes inside the page (PNG or SVG by its extension).
std::string figure(const std::filesystem::path& file, std::string_view caption);
/// A table; cells are taken as HTML.
std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);
/// A whole page: doctype, style, title, body.
std::string page(std::string_view title, std::string_view body);

}  // namespace gonio::html
