#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// A strict CSV of numbers: one header row, then rows with as many cells. Blank lines and lines starting with # are
/// skipped.
struct CsvRow {
  int line = 0;
  std::vector<std::string_view> cells;  ///< trimmed; views into the text given to read_csv
};
struct CsvTable {
  std::vector<std::string_view> header;
  int header_line = 0;
  std::vector<CsvRow> rows;
};

/// A text without blanks at its ends; the cells of a line, each so.
std::string_view without_blanks(std::string_view text);
std::vector<std::string_view> split_at_commas(std::string_view line);

/// InputError for an empty file, one that is not text, a row with another number of cells, a column named twice.
CsvTable read_csv(std::string_view text, const std::string& file);

/// A finite number in plain decimal notation; InputError otherwise.
double csv_number(std::string_view cell, std::string_view column, const std::string& file, int line);

}  // namespace gonio
