#pragma once
#include <string>
#include <string_view>

#include "materials/database.h"

namespace gonio {

/// Reads one entry of materials_db: a header of `key: value` lines, then (unless a dispersion formula replaces it) a
/// line
/// `---` and a CSV table with a header row. `file` is named in errors. Throws InputError `file:line: …` on anything
/// that is missing, unknown, given twice, not finite, out of order or outside what its kind allows.
Entry read_entry(std::string_view text, const std::string& file);

/// The value columns a kind of entry has, in order; empty for a kind that does not exist. (The k of optical constants
/// is optional.)
const std::vector<std::string>& columns_of_kind(std::string_view kind);

/// A whole cell as a finite number; false for anything else.
bool parse_number(std::string_view cell, double& number);

/// Without spaces and tabs at both ends.
std::string_view trimmed(std::string_view text);

}  // namespace gonio
