#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "cli/commands.h"
#include "materials/import.h"
#include "materials/user_database.h"

namespace gonio::cli {
namespace {

struct ImportArguments {
  std::vector<std::string> files;
  ImportOptions options;
  bool replace = false;
};

void refuse_bundled_names(const Entry& entry) {
  const Database& database = Database::bundled();
  if (entry.id != "perfect" && (!database.contains(entry.id) || database.find(entry.id).user)) return;
  throw input_error("{}: {} is the name of a bundled entry; expected another --id", entry.file, entry.id);
}

/// Each file by itself: those that are good are added, the others named on standard error. Returns how many were
/// refused.
std::size_t import_files(const ImportArguments& arguments, std::vector<Entry>& added) {
  std::size_t refused = 0;
  for (const std::string& file : arguments.files) try {
      const Entry entry = read_import(read_file(file), file, arguments.options);
      refuse_bundled_names(entry);
      add_to_user_database(user_database_path(), {entry}, arguments.replace);
      added.push_back(entry);
    } catch (const InputError& error) {
      std::cerr << error.what() << '\n';
      ++refused;
    }
  return refused;
}

void run_import(const ImportArguments& arguments, Common& common) {
  if (arguments.files.size() > 1 && !(arguments.options.id + arguments.options.name).empty())
    throw input_error("--id, --name: given for {} files; expected one file", arguments.files.size());
  std::vector<Entry> added;
  if (import_files(arguments, added) > 0) common.exit_code = 2;
  if (added.empty()) return;
  if (common.json) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Entry& entry : added)
      rows.push_back({{"id", entry.id}, {"kind", entry.kind}, {"range_nm", {entry.range_lo_nm, entry.range_hi_nm}}});
    std::cout << rows.dump(2) << '\n';
    return;
  }
  for (const Entry& entry : added)
    std::cout << fmt::format("{}: {}, {:g} to {:g} nm\n", entry.id, entry.kind, entry.range_lo_nm, entry.range_hi_nm);
}

}  // namespace

void add_materials_import(CLI::App& materials, Common& common) {
  auto* command =
      materials.add_subcommand("import", "Add spectra of one's own to the user database (exit 2: some refused)");
  command->footer(
      "Reads refractiveindex.info YAML, tables (CSV or blanks; header row wavelength_nm,n,k or wavelength_um,R …, "
      "lines\n"
      "`# citation: …` before it) and the text format of materials_db. The user database: $GONIO_USER_DB, else\n"
      "$XDG_DATA_HOME/gonio/user.sqlite, else ~/.local/share/gonio/user.sqlite.\n"
      "Example: gonio materials import paint.csv --id red-paint_me --citation \"measured by me, 2026\"");
  add_common(*command, common);
  auto arguments = std::make_shared<ImportArguments>();
  ImportOptions& options = arguments->options;
  command->add_option("files", arguments->files, "Files to import")->required();
  command->add_option("--id", options.id, "Id (default: the file's name without suffix)");
  command->add_option("--name", options.name, "Name (default: the id)");
  command->add_option("--kind", options.kind,
                      "optical-constants, reflectance, transmittance, illuminant, … (default: by column)");
  command->add_option("--citation", options.citation,
                      "Where the numbers come from; needed where the file does not say");
  command->add_option("--doi", options.doi, "DOI of the source");
  command->add_option("--licence", options.licence, "Licence (default: not stated)");
  command->add_option("--specimen", options.specimen, "What was measured");
  command->add_option("--temperature", options.temperature, "At which temperature");
  command->add_option("--wavelength-unit", options.wavelength_unit, "nm, um or A, where the header row does not say");
  command->add_flag("--percent", options.percent, "Reflectances and transmittances are in per cent");
  command->add_flag("--replace", arguments->replace, "Replace user entries of the same id");
  command->callback([&common, arguments] { run_import(*arguments, common); });
}

}  // namespace gonio::cli
