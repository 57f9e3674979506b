#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "materials/import.h"

namespace gonio {

/// The formats of read_import(), each without the final check.
Entry read_yaml_entry(std::string_view text, const std::string& file);
Entry read_table_entry(std::string_view text, const std::string& file, const ImportOptions& options);

/// Powers of ten from a unit of wavelength (nm, um, A) to nm; InputError `file:line` for another.
int exponent_to_nm(std::string_view unit, const std::string& file, int line);

/// A cell's decimal number times 10^exponent, rounded once: 0.1879 um is 187.9 nm exactly. InputError for no number.
double scaled_number(std::string_view cell, int exponent, const std::string& what, const std::string& file, int line);

/// Appends a row, checked against the row before and what its columns allow. NaN stands for an unknown k.
void append_row(Entry& entry, double wavelength_nm, const std::vector<double>& values, const std::string& file,
                int line);

/// Wavelengths that can only be in another unit: below 20 where nm were said, all above 100 um where um were said.
void check_unit(const Entry& entry, std::string_view unit, const std::string& file);

}  // namespace gonio
