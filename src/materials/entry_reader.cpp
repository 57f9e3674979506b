#include "materials/entry_reader.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include "base/error.h"
#include "materials/entry_checks.h"
#include "optics/dispersion.h"

namespace gonio {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string_view::npos ? std::string_view() : text.substr(first, last - first + 1);
}

bool parse_number(std::string_view cell, double& number) {
  cell = trimmed(cell);
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  return error == std::errc() && end == cell.data() + cell.size() && std::isfinite(number);
}

const std::vector<std::string>& columns_of_kind(std::string_view kind) {
  static const std::map<std::string, std::vector<std::string>, std::less<>> columns = {
      {"optical-constants", {"n", "k"}},       {"reflectance", {"reflectance"}},
      {"transmittance", {"transmittance"}},    {"illuminant", {"relative_power"}},
      {"luminous-efficiency", {"efficiency"}}, {"observer", {"xbar", "ybar", "zbar"}},
      {"cone-fundamentals", {"l", "m", "s"}},  {"rgb-observer", {"rbar", "gbar", "bbar"}},
      {"daylight-basis", {"S0", "S1", "S2"}}};
  static const std::vector<std::string> none;
  const auto found = columns.find(kind);
  return found == columns.end() ? none : found->second;
}

namespace {

/// The text line by line, counted from 1; a carriage return before the line's end is dropped.
class Lines {
 public:
  Lines(std::string_view text, const std::string& file) : rest_(text), file_(file) {}
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const auto end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++number_;
    return true;
  }
  int number() const { return number_; }
  const std::string& file() const { return file_; }

 private:
  std::string_view rest_;
  const std::string& file_;
  int number_ = 0;
};

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (;;) {
    const auto end = line.find(separator);
    cells.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return cells;
    line.remove_prefix(end + 1);
  }
}

std::vector<double> numbers_of(std::string_view value, const std::string& key, const std::string& file, int line) {
  std::vector<double> numbers;
  for (const std::string_view word : split(value, ' ')) {
    if (word.empty()) continue;
    double number = 0;
    if (!parse_number(word, number))
      throw input_error("{}:{}: {} has '{}'; expected finite numbers", file, line, key, word);
    numbers.push_back(number);
  }
  return numbers;
}

void set_range(double& lo, double& hi, std::string_view value, const std::string& key, const std::string& file,
               int line) {
  const std::vector<double> ends = numbers_of(value, key, file, line);
  if (ends.size() != 2 || !(ends[0] > 0) || !(ends[0] < ends[1]))
    throw input_error("{}:{}: {} is '{}'; expected two wavelengths in nm, the lower first", file, line, key, value);
  lo = ends[0], hi = ends[1];
}

void set_value(Entry& entry, const std::string& key, std::string_view value, const std::string& file, int line) {
  static const std::map<std::string, std::string Entry::*> texts = {{"id", &Entry::id},
                                                                    {"name", &Entry::name},
                                                                    {"kind", &Entry::kind},
                                                                    {"unit", &Entry::unit},
                                                                    {"specimen", &Entry::specimen},
                                                                    {"temperature", &Entry::temperature},
                                                                    {"method", &Entry::method},
                                                                    {"citation", &Entry::citation},
                                                                    {"doi", &Entry::doi},
                                                                    {"licence", &Entry::licence},
                                                                    {"formula", &Entry::formula},
                                                                    {"note", &Entry::note},
                                                                    {"confidence", &Entry::confidence}};
  if (value.empty()) throw input_error("{}:{}: {} is empty; expected a value (or no such line)", file, line, key);
  if (key == "range_nm") return set_range(entry.range_lo_nm, entry.range_hi_nm, value, key, file, line);
  if (key == "source_range_nm") return set_range(entry.source_lo_nm, entry.source_hi_nm, value, key, file, line);
  if (key == "coefficients") {
    entry.coefficients = numbers_of(value, key, file, line);
    return;
  }
  const auto text = texts.find(key);
  if (text == texts.end())
    throw input_error("{}:{}: unknown key '{}'; expected one of the keys in materials_db/README.md", file, line, key);
  entry.*(text->second) = value;
}

/// Reads up to the line `---`; false when the text ends without one.
bool read_header(Entry& entry, Lines& lines) {
  std::map<std::string, int> seen;
  std::string_view line;
  while (lines.next(line)) {
    if (trimmed(line) == "---") return true;
    if (trimmed(line).empty() || line.front() == '#') continue;
    const auto colon = line.find(':');
    if (colon == std::string_view::npos)
      throw input_error("{}:{}: no colon; expected `key: value` or the line ---", lines.file(), lines.number());
    const std::string key(trimmed(line.substr(0, colon)));
    if (const auto [at, fresh] = seen.emplace(key, lines.number()); !fresh)
      throw input_error("{}:{}: {} given again; expected once (it is on line {})", lines.file(), lines.number(), key,
                        at->second);
    set_value(entry, key, trimmed(line.substr(colon + 1)), lines.file(), lines.number());
  }
  return false;
}

void read_column_names(Entry& entry, Lines& lines) {
  std::string_view line;
  if (!lines.next(line))
    throw input_error("{}:{}: the table is missing; expected a header row", lines.file(), lines.number());
  const std::vector<std::string_view> names = split(line, ',');
  entry.column_names.assign(names.begin() + 1, names.end());
  const std::vector<std::string> known =
      entry.formula.empty() ? columns_of_kind(entry.kind) : std::vector<std::string>{"k"};
  const bool k_optional = entry.formula.empty() && entry.kind == "optical-constants";
  const std::vector<std::string> without_k(known.begin(), known.end() - k_optional);
  if (names[0] != "wavelength_nm" || (entry.column_names != known && entry.column_names != without_k))
    throw input_error("{}:{}: the columns are '{}'; expected wavelength_nm,{}", lines.file(), lines.number(), line,
                      fmt::join(known, ","));
  entry.columns.resize(entry.column_names.size());
}

void read_row(Entry& entry, std::string_view line, const std::string& file, int number) {
  const std::vector<std::string_view> cells = split(line, ',');
  if (cells.size() != entry.columns.size() + 1)
    throw input_error("{}:{}: {} cells; expected {}", file, number, cells.size(), entry.columns.size() + 1);
  double value = 0;
  if (!parse_number(cells[0], value))
    throw input_error("{}:{}: wavelength_nm is '{}'; expected a finite number", file, number, cells[0]);
  if (!(value > (entry.wavelength_nm.empty() ? 0 : entry.wavelength_nm.back())))
    throw input_error("{}:{}: wavelength_nm is {}; expected it positive and above the row before", file, number, value);
  entry.wavelength_nm.push_back(value);
  for (std::size_t c = 0; c < entry.columns.size(); ++c) {
    const std::string& name = entry.column_names[c];
    if (cells[c + 1].empty() && name == "k") {  // a source that knows k in part of its range only
      entry.columns[c].push_back(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    if (!parse_number(cells[c + 1], value))
      throw input_error("{}:{}: {} is '{}'; expected a finite number", file, number, name, cells[c + 1]);
    check_value(name, value, file, number);
    entry.columns[c].push_back(value);
  }
}

void read_table(Entry& entry, Lines& lines) {
  read_column_names(entry, lines);
  std::string_view line;
  while (lines.next(line)) {
    if (trimmed(line).empty())
      throw input_error("{}:{}: an empty line; expected a row of the table", lines.file(), lines.number());
    read_row(entry, line, lines.file(), lines.number());
  }
}

}  // namespace

Entry read_entry(std::string_view text, const std::string& file) {
  check_text(text, file);
  Entry entry;
  entry.file = file;
  Lines lines(text, file);
  const bool table = read_header(entry, lines);
  check_header(entry);
  if (entry.formula.empty() && !table)
    throw input_error("{}:{}: no line ---; expected the table after it, or a formula", file, lines.number());
  if (table) read_table(entry, lines);
  if (table && !entry.formula.empty()) {  // n by the formula, k by the table
    entry.column_names.insert(entry.column_names.begin(), "n");
    entry.columns.emplace(entry.columns.begin());
  }
  check_entry(entry);
  return entry;
}

}  // namespace gonio
