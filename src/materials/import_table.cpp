#include <algorithm>
#include <limits>
#include <map>

#include "base/error.h"
#include "materials/entry_checks.h"
#include "materials/entry_reader.h"
#include "materials/import_formats.h"
#include "materials/near_names.h"

// Tables: `# key: value` lines, a header row that names the columns and the unit of the wavelength, rows of numbers.
namespace gonio {
namespace {

struct Line {
  std::string_view text;
  int number;
};

/// The lines that hold something; `# key: value` lines set what the file says of itself.
std::vector<Line> read_lines(std::string_view text, Entry& entry) {
  const std::map<std::string, std::string Entry::*> keys = {
      {"id", &Entry::id},           {"name", &Entry::name},         {"kind", &Entry::kind},
      {"unit", &Entry::unit},       {"specimen", &Entry::specimen}, {"temperature", &Entry::temperature},
      {"method", &Entry::method},   {"citation", &Entry::citation}, {"doi", &Entry::doi},
      {"licence", &Entry::licence}, {"note", &Entry::note},         {"confidence", &Entry::confidence}};
  std::vector<Line> lines;
  int number = 0;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    at = end + 1, ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    line = trimmed(line);
    if (line.empty()) continue;
    if (line.front() != '#') {
      lines.push_back({line, number});
      continue;
    }
    const std::string_view said = trimmed(line.substr(1));
    const std::size_t colon = said.find(':');
    if (const auto key = keys.find(lower(trimmed(said.substr(0, colon)))); colon != said.npos && key != keys.end())
      entry.*(key->second) = trimmed(said.substr(colon + 1));
  }
  return lines;
}

char separator_of(std::string_view header) {
  for (const char c : {',', ';', '\t'})
    if (header.find(c) != std::string_view::npos) return c;
  return ' ';
}

std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(separator, at), line.size());
    std::string_view cell = trimmed(line.substr(at, end - at));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    if (separator != ' ' || !cell.empty()) cells.emplace_back(cell);
    at = end + 1;
  }
  if (cells.empty()) cells.emplace_back();  // a line of quotes
  return cells;
}

/// `wavelength_nm`, `wl (um)`, `Lambda [nm]`: the unit, empty where none is named. False for another column.
bool is_wavelength(std::string_view name, std::string& unit) {
  const std::string text = lower(name);
  std::size_t size = 0;
  for (const std::string_view word : {"wavelength", "lambda", "wl", "λ"})
    if (text.starts_with(word)) size = std::max(size, word.size());
  if (size == 0 && text != "nm" && text != "um" && text != "µm") return false;
  std::string_view rest = std::string_view(text).substr(size);
  while (!rest.empty() && std::string_view(" _([,/").find(rest.front()) != rest.npos) rest.remove_prefix(1);
  while (!rest.empty() && std::string_view(" )]").find(rest.back()) != rest.npos) rest.remove_suffix(1);
  unit = rest == "a" ? "A" : std::string(rest);
  return true;
}

/// What this project calls a column; empty for one it does not know.
std::string column_named(std::string_view name) {
  static const std::map<std::string, std::string> names = {{"n", "n"},
                                                           {"k", "k"},
                                                           {"r", "reflectance"},
                                                           {"reflectance", "reflectance"},
                                                           {"t", "transmittance"},
                                                           {"transmittance", "transmittance"},
                                                           {"relative_power", "relative_power"},
                                                           {"power", "relative_power"},
                                                           {"spd", "relative_power"},
                                                           {"efficiency", "efficiency"},
                                                           {"v", "efficiency"},
                                                           {"xbar", "xbar"},
                                                           {"ybar", "ybar"},
                                                           {"zbar", "zbar"},
                                                           {"x", "xbar"},
                                                           {"y", "ybar"},
                                                           {"z", "zbar"},
                                                           {"l", "l"},
                                                           {"m", "m"},
                                                           {"s", "s"}};
  const auto found = names.find(lower(name));
  return found == names.end() ? "" : found->second;
}

/// The kind whose columns these are; empty for none.
std::string kind_of(const std::vector<std::string>& columns) {
  if (columns == std::vector<std::string>{"n"}) return "optical-constants";
  for (const char* kind : {"optical-constants", "reflectance", "transmittance", "illuminant", "luminous-efficiency",
                           "observer", "cone-fundamentals"})
    if (columns_of_kind(kind) == columns) return kind;
  return "";
}

void check_kind(Entry& entry, const std::string& said, const Line& header, const std::string& file) {
  const std::string kind = kind_of(entry.column_names);
  if (kind.empty())
    throw input_error(
        "{}:{}: the columns are '{}'; expected a wavelength and n[, k], reflectance, transmittance, "
        "relative_power, efficiency or xbar, ybar, zbar",
        file, header.number, header.text);
  if (!said.empty() && said != kind)
    throw input_error("{}:{}: the columns of kind {}; expected those of {}", file, header.number, kind, said);
  entry.kind = kind;
}

/// Reads the header row; the powers of ten from its wavelengths to nm.
int read_header_row(Entry& entry, const Line& header, char separator, const std::string& file,
                    const ImportOptions& options, std::string& unit) {
  std::vector<std::string> names = cells_of(header.text, separator);
  if (!is_wavelength(names[0], unit))
    throw input_error("{}:{}: the first column is '{}'; expected a header row that begins with wavelength_nm (or _um)",
                      file, header.number, names[0]);
  if (unit.empty()) unit = options.wavelength_unit;
  if (unit.empty())
    throw input_error("{}:{}: the wavelength has no unit; expected wavelength_nm, wavelength_um or --wavelength-unit",
                      file, header.number);
  for (std::size_t c = 1; c < names.size(); ++c) entry.column_names.push_back(column_named(names[c]));
  entry.columns.resize(entry.column_names.size());
  check_kind(entry, options.kind.empty() ? entry.kind : options.kind, header, file);
  return exponent_to_nm(unit, file, header.number);
}

double cell_value(const Entry& entry, std::size_t column, const std::string& cell, bool percent,
                  const std::string& file, int line) {
  const std::string& name = entry.column_names[column];
  if (cell.empty() && name == "k") return std::numeric_limits<double>::quiet_NaN();
  return scaled_number(cell, percent && (name == "reflectance" || name == "transmittance") ? -2 : 0, name, file, line);
}

}  // namespace

Entry read_table_entry(std::string_view text, const std::string& file, const ImportOptions& options) {
  Entry entry;
  entry.file = file;
  const std::vector<Line> lines = read_lines(text, entry);
  if (lines.size() < 3)
    throw input_error("{}: {} lines of a table; expected a header row and two rows", file, lines.size());
  const char separator = separator_of(lines[0].text);
  std::string unit;
  const int exponent = read_header_row(entry, lines[0], separator, file, options, unit);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> cells = cells_of(lines[i].text, separator);
    if (cells.size() != entry.columns.size() + 1)
      throw input_error("{}:{}: {} cells; expected {}", file, lines[i].number, cells.size(), entry.columns.size() + 1);
    std::vector<double> values;
    for (std::size_t c = 0; c < entry.columns.size(); ++c)
      values.push_back(cell_value(entry, c, cells[c + 1], options.percent, file, lines[i].number));
    append_row(entry, scaled_number(cells[0], exponent, "wavelength", file, lines[i].number), values, file,
               lines[i].number);
  }
  entry.range_lo_nm = entry.source_lo_nm = entry.wavelength_nm.front();
  entry.range_hi_nm = entry.source_hi_nm = entry.wavelength_nm.back();
  check_unit(entry, unit, file);
  return entry;
}

}  // namespace gonio
