#pragma once
// The published pages of this folder, each remade by code, and what a remade one differs by.
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// A page is a folder: README.md, CSV tables, SVG plots. Where chance decides (which of many starts found the lowest minimum) or
/// time is taken, numbers change between machines, and nobody compares them.
struct PublishedPage {
  std::string_view name, about;
  /// Makes the page in `folder`. `published` is where the published one lies: a page may keep the results of a long
  /// search there and compute everything else from them again.
  /// `progress` hears of each part of a page that takes minutes.
  using Progress = std::function<void(const std::string&)>;
  void (*remake)(const std::filesystem::path& published, const std::filesystem::path& folder, const Progress& progress);
  bool repeatable = true;  ///< the same numbers on every machine
};
const std::vector<PublishedPage>& published_pages();

/// InputError, naming the pages there are, for an unknown one.
const PublishedPage& published_page(std::string_view name);

/// Where a remade page (its CSV tables and README.md) differs from the published one beyond rounding, a line each:
/// words must agree, numbers to 1.5 units of the last digit printed or one part in 10⁵. Files that either lacks count
/// too.
std::vector<std::string> page_differences(const std::filesystem::path& published, const std::filesystem::path& remade);

}  // namespace gonio
