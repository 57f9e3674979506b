#pragma once
#include <string>
#include <string_view>

#include "materials/database.h"

namespace gonio {

/// What the user says about a file to import; empty where the file says it itself.
struct ImportOptions {
  std::string id, name, kind, citation, doi, licence, specimen, temperature;
  std::string wavelength_unit;  ///< nm, um or A; for tables whose header does not say
  bool percent = false;         ///< reflectances and transmittances are in per cent
};

/// An entry from a file of one of these formats, told apart by name and content:
///   refractiveindex.info YAML (.yml, .yaml): formulas 1 to 9, tabulated n, k, nk;
///   the text format of materials_db (.txt with a line `---`);
///   a table with comma, semicolon, tab or blanks between its cells, a header row and `# key: value` lines before it.
/// The id is the file's name without a suffix where nothing else is said, the name the id, the licence `not stated`.
/// Throws InputError `file:line: …` on what materials_db would refuse too: unsorted or repeated wavelengths, a wrong or
/// missing unit, k < 0, a missing citation, bytes that are no text.
Entry read_import(std::string_view text, const std::string& file, const ImportOptions& options);

}  // namespace gonio
