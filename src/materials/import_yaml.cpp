#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "base/error.h"
#include "materials/entry_checks.h"
#include "materials/entry_reader.h"
#include "materials/import_formats.h"
#include "optics/dispersion.h"
#include "spectrum/spectrum.h"

// The record of refractiveindex.info: REFERENCES, COMMENTS, CONDITIONS and DATA, a list of up to one formula or table
// of n and up to one table of k. Wavelengths in um.
namespace gonio {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

int line_of(const YAML::Node& node) { return node.Mark().line + 1; }

/// A mapping with each key once.
void check_map(const YAML::Node& node, const std::string& file, const char* what) {
  if (!node.IsMap())
    throw input_error("{}:{}: {} is no mapping; expected `key: value` lines", file, line_of(node), what);
  std::set<std::string> seen;
  for (const auto& item : node)
    if (!item.first.IsScalar() || !seen.insert(item.first.Scalar()).second)
      throw input_error("{}:{}: a key is given again, or is none; expected each once", file, line_of(item.first));
}

std::string text_of(const YAML::Node& map, const char* key, const std::string& file) {
  const YAML::Node node = map[key];
  if (!node) return "";
  if (!node.IsScalar()) throw input_error("{}:{}: {} is no text; expected one value", file, line_of(node), key);
  return node.Scalar();
}

/// Of `[text](address)` the text; without signs of emphasis.
std::string without_markdown(std::string_view marked) {
  std::string text;
  for (std::size_t at = 0; at < marked.size(); ++at) {
    const std::size_t open = text.rfind('[');
    if (marked.substr(at, 2) == "](" && open != std::string::npos) {
      text.erase(open, 1);
      int depth = 1;
      for (at += 2; at < marked.size() && depth > 0; ++at) depth += (marked[at] == '(') - (marked[at] == ')');
      --at;  // on the bracket that closes
    } else if (marked[at] != '*') {
      text += marked[at];
    }
  }
  return text;
}

/// Text as one line, without Markdown and HTML tags.
std::string plain(const std::string& marked) {
  const std::string source = without_markdown(marked);
  std::string text;
  bool tag = false;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const char c = source[i], next = i + 1 < source.size() ? source[i + 1] : ' ';
    if (c == '<' && (next == '/' || (next >= 'a' && next <= 'z'))) tag = true;  // <111> is a direction
    if (!tag) text += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
    if (c == '>') tag = false;
  }
  std::string line;
  for (const char c : text)
    if (c != ' ' || (!line.empty() && line.back() != ' ')) line += c;
  return std::string(trimmed(line));
}

/// The first DOI; it may hold brackets of its own, but not one that closes a link.
std::string doi_in(const std::string& references) {
  const std::size_t at = references.find("doi.org/");
  if (at == std::string::npos) return "";
  int depth = 0;
  std::string doi;
  for (std::size_t i = at + 8; i < references.size(); ++i) {
    depth += (references[i] == '(') - (references[i] == ')');
    if (depth < 0 || std::string_view("\"'> \n\t").find(references[i]) != std::string_view::npos) break;
    doi += references[i];
  }
  return doi;
}

std::vector<std::pair<std::string_view, int>> lines_of(std::string_view text, int first_line) {
  std::vector<std::pair<std::string_view, int>> lines;
  for (std::size_t at = 0; at < text.size(); ++first_line) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (const std::string_view line = trimmed(text.substr(at, end - at)); !line.empty())
      lines.emplace_back(line, first_line);
    at = end + 1;
  }
  return lines;
}

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t at = line.find_first_not_of(" \t\r\n"); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t\r\n", at), line.size());
    words.emplace_back(line.substr(at, end - at));
    at = line.find_first_not_of(" \t\r\n", end);
  }
  return words;
}

/// One table of DATA; its columns are n, k, or both.
Entry read_block(const YAML::Node& block, const std::vector<std::string>& columns, const std::string& file) {
  Entry table;
  table.column_names = columns;
  table.columns.resize(columns.size());
  const YAML::Node data = block["data"];
  if (!data || !data.IsScalar()) throw input_error("{}:{}: no data; expected a table", file, line_of(block));
  for (const auto& [line, number] : lines_of(data.Scalar(), line_of(data) + 1)) {  // below the `|`
    const std::vector<std::string> words = words_of(line);
    if (words.size() != columns.size() + 1)
      throw input_error("{}:{}: {} numbers; expected {}", file, number, words.size(), columns.size() + 1);
    std::vector<double> values;
    for (std::size_t c = 0; c < columns.size(); ++c)
      values.push_back(scaled_number(words[c + 1], 0, columns[c], file, number));
    append_row(table, scaled_number(words[0], 3, "wavelength", file, number), values, file, number);
  }
  if (table.wavelength_nm.size() < 2)
    throw input_error("{}:{}: {} rows in the table; expected at least 2", file, line_of(data),
                      table.wavelength_nm.size());
  return table;
}

struct Formula {
  std::string name;
  std::vector<double> coefficients;
  double lo_nm = 0, hi_nm = 0;
};

Formula read_formula(const YAML::Node& block, const std::string& number, const std::string& file) {
  if (number.size() != 1 || number[0] < '1' || number[0] > '9')
    throw input_error("{}:{}: formula '{}'; expected formula 1 to formula 9", file, line_of(block), number);
  Formula formula{std::string(kDispersionNames[static_cast<std::size_t>(number[0] - '1')]), {}, 0, 0};
  for (const std::string& word : words_of(text_of(block, "coefficients", file)))
    formula.coefficients.push_back(scaled_number(word, 0, "a coefficient", file, line_of(block)));
  const std::string range = plain(text_of(block, block["wavelength_range"] ? "wavelength_range" : "range", file));
  const std::vector<std::string> ends = words_of(range);
  if (ends.size() != 2)
    throw input_error("{}:{}: wavelength_range is '{}'; expected two wavelengths in um", file, line_of(block), range);
  formula.lo_nm = scaled_number(ends[0], 3, "wavelength_range", file, line_of(block));
  formula.hi_nm = scaled_number(ends[1], 3, "wavelength_range", file, line_of(block));
  if (!(formula.lo_nm > 0 && formula.lo_nm < formula.hi_nm))
    throw input_error("{}:{}: wavelength_range is '{}'; expected the lower first", file, line_of(block), range);
  return formula;
}

/// n and k of two tables at the wavelengths of both within n's range: linear between points, as each was by itself.
Entry merged(const Entry& n, const Entry& k) {
  Entry both;
  both.column_names = {"n", "k"};
  both.columns.resize(2);
  std::set<double> wavelengths(n.wavelength_nm.begin(), n.wavelength_nm.end());
  for (const double nm : k.wavelength_nm)
    if (nm > n.wavelength_nm.front() && nm < n.wavelength_nm.back()) wavelengths.insert(nm);
  for (const double nm : wavelengths) {
    both.wavelength_nm.push_back(nm);
    both.columns[0].push_back(interpolate(n.wavelength_nm, n.columns[0], nm));
    const bool known = nm >= k.wavelength_nm.front() && nm <= k.wavelength_nm.back();
    both.columns[1].push_back(known ? interpolate(k.wavelength_nm, k.columns[0], nm) : kUnknown);
  }
  return both;
}

/// The k beside a formula: what lies in the formula's range.
Entry within(const Entry& k, double lo_nm, double hi_nm) {
  Entry inside;
  inside.column_names = {"n", "k"};
  inside.columns.resize(2);
  for (std::size_t row = 0; row < k.wavelength_nm.size(); ++row)
    if (k.wavelength_nm[row] >= lo_nm && k.wavelength_nm[row] <= hi_nm) {
      inside.wavelength_nm.push_back(k.wavelength_nm[row]);
      inside.columns[1].push_back(k.columns[0][row]);
    }
  return inside;
}

struct Blocks {
  std::optional<Formula> formula;
  std::optional<Entry> n, k, nk;
};

Blocks read_blocks(const YAML::Node& data, const std::string& file) {
  if (!data || !data.IsSequence()) throw input_error("{}: no list DATA; expected formulas or tables", file);
  Blocks blocks;
  for (const YAML::Node& block : data) {
    check_map(block, file, "an item of DATA");
    const std::string type = plain(text_of(block, "type", file));
    if (type.starts_with("formula ") && !blocks.formula)
      blocks.formula = read_formula(block, type.substr(8), file);
    else if (type == "tabulated nk" && !blocks.nk)
      blocks.nk = read_block(block, {"n", "k"}, file);
    else if (type == "tabulated n" && !blocks.n)
      blocks.n = read_block(block, {"n"}, file);
    else if (type == "tabulated k" && !blocks.k)
      blocks.k = read_block(block, {"k"}, file);
    else
      throw input_error("{}:{}: type '{}'; expected formula 1 to 9, tabulated nk, n or k, each once", file,
                        line_of(block), type);
  }
  if (blocks.formula.has_value() + blocks.n.has_value() + blocks.nk.has_value() != 1 || (blocks.nk && blocks.k))
    throw input_error("{}: DATA gives n {} times; expected once, and k at most once", file,
                      blocks.formula.has_value() + blocks.n.has_value() + blocks.nk.has_value());
  return blocks;
}

void set_table(Entry& entry, Entry table) {
  entry.wavelength_nm = std::move(table.wavelength_nm);
  entry.column_names = std::move(table.column_names);
  entry.columns = std::move(table.columns);
}

void set_data(Entry& entry, const Blocks& blocks) {
  if (blocks.formula) {
    entry.formula = blocks.formula->name, entry.coefficients = blocks.formula->coefficients;
    entry.range_lo_nm = blocks.formula->lo_nm, entry.range_hi_nm = blocks.formula->hi_nm;
    if (!blocks.k) return;
    Entry k = within(*blocks.k, entry.range_lo_nm, entry.range_hi_nm);
    if (k.wavelength_nm.size() >= 2) set_table(entry, std::move(k));
    return;
  }
  set_table(entry, blocks.nk ? *blocks.nk : blocks.k ? merged(*blocks.n, *blocks.k) : *blocks.n);
  entry.range_lo_nm = entry.wavelength_nm.front(), entry.range_hi_nm = entry.wavelength_nm.back();
}

}  // namespace

Entry read_yaml_entry(std::string_view text, const std::string& file) try {
  const YAML::Node root = YAML::Load(std::string(text));
  check_map(root, file, "the file");
  Entry entry;
  entry.kind = "optical-constants";
  entry.file = file;
  const std::string references = text_of(root, "REFERENCES", file);
  entry.citation = plain(references), entry.doi = doi_in(references);
  entry.note = plain(text_of(root, "COMMENTS", file));
  if (const YAML::Node conditions = root["CONDITIONS"]; conditions && conditions.IsMap() && conditions["temperature"])
    entry.temperature = plain(text_of(conditions, "temperature", file)) + " K";
  set_data(entry, read_blocks(root["DATA"], file));
  entry.source_lo_nm = entry.range_lo_nm, entry.source_hi_nm = entry.range_hi_nm;
  check_unit(entry, "um", file);
  return entry;
} catch (const YAML::Exception& error) {
  throw input_error("{}:{}: no YAML ({}); expected a record of refractiveindex.info", file, error.mark.line + 1,
                    error.msg);
}

}  // namespace gonio
