#include "fit/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "base/error.h"

namespace gonio {

std::string_view without_blanks(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> split_at_commas(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t at = 0;;) {
    const std::size_t comma = line.find(',', at);
    cells.push_back(without_blanks(line.substr(at, comma == line.npos ? line.npos : comma - at)));
    if (comma == line.npos) return cells;
    at = comma + 1;
  }
}

namespace {

void require_text(std::string_view text, const std::string& file) {
  const auto control = [](unsigned char c) { return (c < 32 && c != '\t' && c != '\n' && c != '\r') || c == 127; };
  const auto bad = std::find_if(text.begin(), text.end(), control);
  if (bad == text.end()) return;
  const auto line = 1 + std::count(text.begin(), bad, '\n');
  throw input_error("{}:{}: is not text (byte {}); expected a CSV table", file, line,
                    int(static_cast<unsigned char>(*bad)));
}

/// A cell as an error message may show it: short and printable.
std::string shown(std::string_view cell) {
  std::string text(cell.substr(0, 40));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return text;
}

void require_distinct(const CsvTable& table, const std::string& file) {
  std::set<std::string_view> seen;
  for (const auto name : table.header)
    if (!name.empty() && !seen.insert(name).second)
      throw input_error("{}:{}: column `{}` appears twice; expected each once", file, table.header_line, shown(name));
}

}  // namespace

CsvTable read_csv(std::string_view text, const std::string& file) {
  require_text(text, file);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte order mark
  CsvTable table;
  int line_number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = without_blanks(text.substr(0, end));
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    ++line_number;
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string_view> cells = split_at_commas(line);
    if (table.header.empty()) {
      table.header = std::move(cells);
      table.header_line = line_number;
      require_distinct(table, file);
      continue;
    }
    if (cells.size() != table.header.size())
      throw input_error("{}:{}: row has {} cells; expected {} as in the header", file, line_number, cells.size(),
                        table.header.size());
    table.rows.push_back({line_number, std::move(cells)});
  }
  if (table.header.empty()) throw input_error("{}:1: is empty; expected a CSV table with a header row", file);
  return table;
}

double csv_number(std::string_view cell, std::string_view column, const std::string& file, int line) {
  std::string_view digits = cell;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
    throw input_error("{}:{}: {} is `{}`; expected a finite number", file, line, shown(column), shown(cell));
  return value;
}

}  // namespace gonio
