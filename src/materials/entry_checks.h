#pragma once
#include <string>
#include <string_view>

#include "materials/database.h"

namespace gonio {

/// Text that a person can read: UTF-8 without control characters. Throws InputError `file:line: …`.
void check_text(std::string_view text, const std::string& file);

/// One value of a table against what its column allows: n > 0, k >= 0, 0 <= R <= 1 (+ 0.02 of noise), powers >= 0.
void check_value(const std::string& column, double value, const std::string& file, int line);

/// The header is complete and its words are known ones.
void check_header(const Entry& entry);

/// The table or formula agrees with the header's range, and a formula has a positive index all over it.
void check_entry(const Entry& entry);

/// All of the above for an entry that was not just read from text: header, increasing wavelengths, every value.
void check_whole_entry(const Entry& entry);

}  // namespace gonio
