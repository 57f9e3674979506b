#include "reports/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "assess/brdf_stability.h"
#include "assess/conservation_page.h"
#include "assess/fit_stability.h"
#include "assess/interpolation_charts.h"
#include "assess/kramers_kronig_charts.h"
#include "assess/merl_tables_page.h"
#include "assess/model_choice_page.h"
#include "assess/published_comparisons_page.h"
#include "assess/table_speed.h"
#include "assess/table_stability.h"
#include "assess/wavelength_charts.h"
#include "base/error.h"
#include "base/files.h"

namespace gonio {
namespace {

namespace fs = std::filesystem;
using Progress = PublishedPage::Progress;

struct Number {
  double value, unit;  ///< unit of the last digit printed
};

std::optional<Number> number_of(std::string_view word) {
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number.value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number.value)) return std::nullopt;
  const std::size_t mark = std::min(word.find_first_of("eE"), word.size()), point = word.find('.');
  int exponent = 0;
  if (mark < word.size()) {
    std::string_view digits = word.substr(mark + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
  }
  const double decimals = point < mark ? static_cast<double>(mark - point - 1) : 0;
  number.unit = std::pow(10, exponent - decimals);
  return number;
}

bool same(std::string_view p, std::string_view q) {
  if (p == q) return true;
  const std::optional<Number> a = number_of(p), b = number_of(q);
  if (!a || !b) return false;
  const bool whole = p.find_first_of(".eE") == p.npos && q.find_first_of(".eE") == q.npos;
  if (whole) return false;  // a count is no rounded value
  const double margin = 1.5 * std::max(a->unit, b->unit) + 1e-5 * std::max(std::abs(a->value), std::abs(b->value));
  return std::abs(a->value - b->value) <= margin + 1e-12;
}

/// Words between blanks, commas, table bars and Markdown's emphasis.
std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view kBetween = " ,|*();:\r\t";
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kBetween); at != line.npos; at = line.find_first_not_of(kBetween, at)) {
    const std::size_t end = std::min(line.find_first_of(kBetween, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

bool same_line(std::string_view p, std::string_view q) {
  const auto a = words_of(p), b = words_of(q);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

void compare(const fs::path& published, const fs::path& remade, std::vector<std::string>& differences) {
  const std::string old_text = read_file(published), new_text = read_file(remade);
  const auto old_lines = lines_of(old_text), new_lines = lines_of(new_text);
  const std::string name = published.filename().string();
  if (old_lines.size() != new_lines.size())
    differences.push_back(fmt::format("{}: {} lines; expected {}", name, new_lines.size(), old_lines.size()));
  for (std::size_t i = 0; i < std::min(old_lines.size(), new_lines.size()); ++i)
    if (!same_line(old_lines[i], new_lines[i]))
      differences.push_back(fmt::format("{}:{}: {}; expected {}", name, i + 1, new_lines[i], old_lines[i]));
}

std::set<std::string> files_of(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file()) names.insert(entry.path().filename().string());
  return names;
}

}  // namespace

const std::vector<PublishedPage>& published_pages() {
  static const std::vector<PublishedPage> pages{
      {"brdf-stability",
       "where reflection models fail: published forms beside ours, energy above 1, validity of Kirchhoff's theory",
       [](const fs::path&, const fs::path& folder, const Progress&) { write_brdf_stability(folder, true); }},
      {"interpolation", "what each interpolation variant loses on the database; the default of each class of data",
       [](const fs::path&, const fs::path& folder, const Progress&) { write_interpolation_errors(folder); }},
      {"kramers-kronig", "n and k from reflectance on cut bands, against metals whose n and k are known",
       [](const fs::path&, const fs::path& folder, const Progress&) { write_kramers_kronig_charts(folder); }},
      {"published-comparisons", "experiments in print: what each paper says of the models, as numbers that hold or not",
       [](const fs::path&, const fs::path& folder, const Progress&) { write_published_comparisons(folder); }},
      {"merl-tables", "the published fits of the MERL materials (Ngan, Low, Bagher) evaluated side by side",
       [](const fs::path&, const fs::path& folder, const Progress&) { write_merl_tables(folder); }},
      {"conservation-limits",
       "what kd and ks may be: every metal's limits, rooms inside, at and beyond them, what single scattering loses (1 "
       "min)",
       [](const fs::path&, const fs::path& folder, const Progress& progress) {
         write_conservation_limits(folder, progress);
       },
       false},
      {"wavelengths", "how few wavelengths a scene needs, against rules that do not know it; every lamp",
       [](const fs::path& published, const fs::path& folder, const Progress&) {
         write_wavelength_errors(published, folder);
       }},
      {"stability-tables",
       "where the tables of directional reflectance err, and what would happen beyond what they hold",
       [](const fs::path&, const fs::path& folder, const Progress& progress) {
         write_table_stability(folder, progress, true);
       },
       false},
      {"speed-tables",
       "size and time of tables of directional reflectance against their error, beside quadrature, sampling and "
       "renderers' tables; timed (1 min)",
       [](const fs::path&, const fs::path& folder, const Progress& progress) { write_table_speed(folder, progress); },
       false},
      {"fit-stability", "what is recovered, which starts end where, scans that mislead (42 s)",
       [](const fs::path&, const fs::path& folder, const Progress& progress) {
         write_fit_stability(folder, progress, true);
       },
       false},
      {"model-choice", "the model that auto takes for every bundled measurement, beside one Ward lobe (2 min)",
       [](const fs::path&, const fs::path& folder, const Progress& progress) { write_model_choice(folder, progress); },
       false},
  };
  return pages;
}

const PublishedPage& published_page(std::string_view name) {
  std::string names;
  for (const PublishedPage& page : published_pages()) {
    if (page.name == name) return page;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", page.name);
  }
  throw input_error("gonio report: no page {}; expected one of {}", name, names);
}

std::vector<std::string> page_differences(const fs::path& published, const fs::path& remade) {
  std::vector<std::string> differences;
  const std::set<std::string> old_files = files_of(published), new_files = files_of(remade);
  for (const std::string& name : old_files) {
    if (!new_files.contains(name))
      differences.push_back(name + ": is not remade; expected as published");
    else if (name.ends_with(".csv") || name.ends_with(".md"))
      compare(published / name, remade / name, differences);
  }
  for (const std::string& name : new_files)
    if (!old_files.contains(name)) differences.push_back(name + ": is not published; expected no other file");
  return differences;
}

}  // namespace gonio
