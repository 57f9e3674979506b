#include "materials/near_names.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gonio {
namespace {

/// Levenshtein's distance: insertions, deletions and replacements that turn one into the other.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j)
      diagonal = std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1, diagonal + (a[i] != b[j])}));
  }
  return row.back();
}

/// Small = alike. Names that only continue the typed one count as one edit.
std::size_t unlikeness(const std::string& typed, const std::string& name) {
  const std::size_t distance = edit_distance(typed, name);
  return !typed.empty() && (name.starts_with(typed) || typed.starts_with(name)) ? std::min<std::size_t>(distance, 1)
                                                                                : distance;
}

}  // namespace

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::vector<std::string> near_names(std::string_view typed, const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 5, kLongest = 64;
  const std::string wanted = lower(typed.substr(0, kLongest));
  const std::size_t tolerated = std::max<std::size_t>(1, wanted.size() / 3);
  std::vector<std::pair<std::size_t, std::string>> ranked;
  for (const std::string& name : names)
    if (const std::size_t u = unlikeness(wanted, lower(name)); u <= tolerated) ranked.emplace_back(u, name);
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::string> near;
  for (std::size_t i = 0; i < std::min(kMost, ranked.size()); ++i) near.push_back(ranked[i].second);
  return near;
}

}  // namespace gonio
