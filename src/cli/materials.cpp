#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/files.h"
#include "cli/commands.h"
#include "materials/database.h"
#include "optics/absorption.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

Json summary(const Entry& entry) {
  return {{"id", entry.id},
          {"kind", entry.kind},
          {"name", entry.name},
          {"range_nm", {entry.range_lo_nm, entry.range_hi_nm}},
          {"source", entry.citation},
          {"licence", entry.licence},
          {"origin", entry.user ? "user" : "bundled"}};
}

void print_list(const std::vector<const Entry*>& entries, bool json) {
  Json rows = Json::array();
  std::size_t widest = 0;
  for (const Entry* entry : entries) rows.push_back(summary(*entry)), widest = std::max(widest, entry->id.size());
  if (json) {
    std::cout << rows.dump(2) << '\n';
    return;
  }
  for (const Entry* entry : entries) {
    const std::string range = fmt::format("{:g} to {:g} nm", entry->range_lo_nm, entry->range_hi_nm);
    std::cout << fmt::format("{:<{}}  {:<19}  {:<18}  {}{}\n", entry->id, widest, entry->kind, range, entry->name,
                             entry->user ? " (user)" : "");
  }
}

/// The card's fields that an entry may leave out.
std::vector<std::pair<const char*, std::string>> optional_fields(const Entry& entry) {
  return {{"specimen", entry.specimen},
          {"temperature", entry.temperature},
          {"method", entry.method},
          {"doi", entry.doi},
          {"note", entry.note}};
}

/// What the entry says at a wavelength, one pair a column; n always with k (0 where the medium is transparent), and
/// with the share of light left after a path inside.
std::vector<std::pair<std::string, double>> values_at(const Database& database, const Entry& entry, double nm,
                                                      std::optional<double> path_mm) {
  std::vector<std::pair<std::string, double>> values;
  if (entry.kind == "optical-constants") {
    const Interface<double> surface = SurfaceMaterial(entry.id, database).at(nm);
    values = {{"n", surface.n}, {"k", surface.k}, {"R_normal", surface.r0()}};
    if (surface.k > 0) {  // else the light is nowhere absorbed
      values.emplace_back("field_depth_nm", field_depth(surface.k, nm));
      values.emplace_back("intensity_depth_nm", intensity_depth(surface.k, nm));
    }
    if (path_mm && !(*path_mm >= 0 && *path_mm < 1e12))
      throw input_error("--path {}: out of range; expected 0 mm or more", *path_mm);
    if (path_mm) values.emplace_back("internal_transmittance", internal_transmittance(surface.k, *path_mm * 1e6, nm));
    return values;
  }
  if (path_mm) throw input_error("--path: {} is of kind {}; expected optical-constants", entry.id, entry.kind);
  for (std::size_t c = 0; c < entry.columns.size(); ++c) values.emplace_back(entry.column_names[c], entry.at(nm, c));
  if (entry.kind == "reflectance") values.emplace_back("R_normal", entry.at(nm));
  return values;
}

Json card_json(const Database& database, const Entry& entry) {
  Json card = summary(entry);
  card["unit"] = entry.unit;
  card["source_range_nm"] = {entry.source_lo_nm, entry.source_hi_nm};
  card["aliases"] = database.aliases_of(entry.id);
  for (const auto& [key, text] : optional_fields(entry)) card[key] = text.empty() ? "not stated" : text;
  card["confidence"] = entry.confidence;
  if (!entry.formula.empty()) {
    card["formula"] = entry.formula;
    card["coefficients"] = entry.coefficients;
  }
  if (!entry.wavelength_nm.empty()) {
    card["columns"] = entry.column_names;
    card["points"] = entry.wavelength_nm.size();
  }
  return card;
}

std::string card_text(const Database& database, const Entry& entry) {
  std::string card;
  const auto line = [&](std::string_view key, std::string_view text) {
    card += fmt::format("{:<12} {}\n", key, text.empty() ? "not stated" : text);
  };
  line("id", entry.id);
  if (const auto aliases = database.aliases_of(entry.id); !aliases.empty())
    line("aliases", fmt::format("{}", fmt::join(aliases, ", ")));
  line("name", entry.name), line("kind", entry.kind), line("unit", entry.unit);
  line("range", fmt::format("{:g} to {:g} nm (the source: {:g} to {:g} nm)", entry.range_lo_nm, entry.range_hi_nm,
                            entry.source_lo_nm, entry.source_hi_nm));
  if (entry.formula.empty())
    line("data", fmt::format("{} points: {}", entry.wavelength_nm.size(), fmt::join(entry.column_names, ", ")));
  else
    line("data", fmt::format("n: formula {}, coefficients {} (wavelength in um){}", entry.formula,
                             fmt::join(entry.coefficients, " "),
                             entry.has_k() ? fmt::format("; k: {} points", entry.wavelength_nm.size()) : ""));
  for (const auto& [key, text] : optional_fields(entry))
    if (!text.empty() || std::string_view(key) != "note") line(key, text);
  if (entry.user) line("origin", "user database");
  line("confidence", entry.confidence), line("citation", entry.citation), line("licence", entry.licence);
  return card;
}

void show(const std::string& id, std::optional<double> at_nm, std::optional<double> path_mm, bool json) {
  const Database& database = Database::bundled();
  const Entry& entry = database.find(id);
  if (!at_nm) {
    if (path_mm) throw input_error("--path: given without --at; expected --at NM");
    std::cout << (json ? card_json(database, entry).dump(2) + "\n" : card_text(database, entry));
    return;
  }
  Json out{{"id", entry.id}, {"wavelength_nm", *at_nm}};
  std::string text = fmt::format("{} at {:g} nm:", entry.id, *at_nm);
  const char* separator = " ";
  for (const auto& [name, value] : values_at(database, entry, *at_nm, path_mm)) {
    out[name] = value;
    text += fmt::format("{}{} = {:.6g}", std::exchange(separator, ", "), name, value);
  }
  out["source"] = entry.citation, out["licence"] = entry.licence;
  std::cout << (json ? out.dump(2) + "\n"
                     : text + "\nsource: " + entry.citation + "\nlicence: " + entry.licence + "\n");
}

/// Reads every entry of a database; the findings are one line each. Returns whether there were none.
bool check(const std::string& path, bool json) {
  std::vector<std::string> findings;
  std::size_t entries = 0;
  try {
    std::optional<Database> other;
    if (!path.empty()) other.emplace(path);
    const Database& database = other ? *other : Database::bundled();
    entries = database.ids().size();
    findings = database.findings();
    if (entries == 0) findings.push_back(fmt::format("{}: no entries; expected <kind>/<id>.txt", path));
  } catch (const InputError& error) {  // the folder itself, or its aliases
    findings.emplace_back(error.what());
  }
  if (json) {
    std::cout << Json{{"entries", entries}, {"findings", findings}}.dump(2) << '\n';
  } else {
    for (const std::string& finding : findings) std::cout << finding << '\n';
    std::cout << fmt::format("{} entries, {} {}\n", entries, findings.size(),
                             findings.size() == 1 ? "finding" : "findings");
  }
  return findings.empty();
}

}  // namespace

void add_materials(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand("materials", "The database of materials, lights and eyes");
  command->footer("Example: gonio materials show Au --at 550");
  command->require_subcommand(1);
  struct Arguments {
    std::string id, folder;
    std::vector<std::string> words;
    std::optional<double> at_nm, path_mm;
  };
  auto arguments = std::make_shared<Arguments>();

  auto* list = command->add_subcommand("list", "Every entry: id, kind, range, name");
  list->footer("Example: gonio materials list --json");
  list->callback([&common] { print_list(Database::bundled().all(), common.json); });

  auto* search = command->add_subcommand(
      "search", "Entries whose id, alias, name, kind or citation has every word (exit 1: none)");
  search->footer("Example: gonio materials search gold johnson");
  search->add_option("words", arguments->words, "Words, in any case")->required();
  search->callback([&common, arguments] {
    const auto found = Database::bundled().search(fmt::format("{}", fmt::join(arguments->words, " ")));
    print_list(found, common.json);
    common.exit_code = found.empty() ? 1 : 0;
  });

  auto* show_card = command->add_subcommand("show", "One entry: its card, or with --at its values at a wavelength");
  show_card->footer(
      "Example: gonio materials show Au --at 550 --json\n         gonio materials show BK7 --at 400 --path 10");
  show_card->add_option("id", arguments->id, "Id or alias")->required();
  show_card->add_option("--at", arguments->at_nm, "Wavelength in nm");
  show_card->add_option("--path", arguments->path_mm, "With --at: the share of light left after so many mm inside");
  show_card->callback([&common, arguments] { show(arguments->id, arguments->at_nm, arguments->path_mm, common.json); });

  auto* check_all = command->add_subcommand("check", "Read and range-check every entry (exit 1: findings)");
  check_all->footer("Example: gonio materials check my_materials_db");
  check_all->add_option(
      "folder", arguments->folder,
      "Another database: a folder of text entries or a compiled file (default: the bundled and the user's)");
  check_all->callback([&common, arguments] { common.exit_code = check(arguments->folder, common.json) ? 0 : 1; });
  add_materials_import(*command, common);
  add_materials_value(*command, common);
  add_materials_kk(*command, common), add_materials_plot(*command, common), add_materials_swatch(*command, common);
  for (auto* subcommand : {list, search, show_card, check_all}) add_common(*subcommand, common);
}

}  // namespace gonio::cli
