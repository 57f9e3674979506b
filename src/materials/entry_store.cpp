#include "materials/entry_store.h"

#include <fmt/format.h>

#include "base/error.h"

namespace gonio {
namespace {

/// Raised when the tables change: files of another format are refused.
constexpr int kFormat = 1;

/// The columns of `entry` that are texts, in order, before the numbers.
constexpr std::string Entry::*kTexts[] = {&Entry::id,       &Entry::name,        &Entry::kind,       &Entry::unit,
                                          &Entry::specimen, &Entry::temperature, &Entry::method,     &Entry::citation,
                                          &Entry::doi,      &Entry::licence,     &Entry::confidence, &Entry::note,
                                          &Entry::file,     &Entry::formula};
constexpr double Entry::*kNumbers[] = {&Entry::range_lo_nm, &Entry::range_hi_nm, &Entry::source_lo_nm,
                                       &Entry::source_hi_nm};
constexpr const char* kColumns =
    "id, name, kind, unit, specimen, temperature, method, citation, doi, licence, confidence, note, file, formula, "
    "range_lo_nm, range_hi_nm, source_lo_nm, source_hi_nm, coefficients, column_names, wavelength_nm, column_values";

std::string schema() {
  return fmt::format(
      "CREATE TABLE entry({0}, PRIMARY KEY(id));"
      "CREATE TABLE alias(alias TEXT PRIMARY KEY, id TEXT NOT NULL) WITHOUT ROWID;"
      "CREATE VIRTUAL TABLE words USING fts5(id, aliases, name, kind, citation, tokenize = 'unicode61 "
      "remove_diacritics 2');"
      "PRAGMA user_version = {1};",
      kColumns, kFormat);
}

int format_of(const SqlFile& file) {
  SqlStatement version = file.prepare("PRAGMA user_version");
  version.step();
  return static_cast<int>(version.number(0));
}

void check_format(const SqlFile& file) {
  if (const int format = format_of(file); format != kFormat)
    throw input_error("{}: is of format {}; expected a materials database of format {}", file.path(), format, kFormat);
}

/// Columns one after the other; a formula's n has no values and takes no room.
std::vector<double> joined(const Entry& entry) {
  std::vector<double> values;
  for (const std::vector<double>& column : entry.columns) values.insert(values.end(), column.begin(), column.end());
  return values;
}

std::vector<std::string> words_of(std::string_view text, char separator) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    if (end > at) words.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

void set_columns(Entry& entry, const std::vector<double>& values) {
  const std::size_t rows = entry.wavelength_nm.size();
  const std::size_t first = entry.formula.empty() ? 0 : 1;
  const std::size_t columns = entry.column_names.size();
  if (columns < first && !entry.column_names.empty()) throw input_error("{}: has no columns", entry.id);
  const std::size_t stored = entry.column_names.empty() ? 0 : columns - first;
  if (values.size() != stored * rows)
    throw input_error("{}: {} values stored; expected {} columns of {} rows", entry.id, values.size(), stored, rows);
  entry.columns.resize(columns);
  for (std::size_t c = 0; c < stored; ++c)
    entry.columns[first + c].assign(values.begin() + static_cast<std::ptrdiff_t>(c * rows),
                                    values.begin() + static_cast<std::ptrdiff_t>((c + 1) * rows));
}

/// Each word quoted, so that its own signs are no operators, and open at its end.
std::string match_expression(std::string_view words) {
  std::string expression;
  for (const std::string& word : words_of(words, ' ')) {
    std::string quoted;
    for (const char c : word) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    expression += fmt::format("{}\"{}\"*", expression.empty() ? "" : " AND ", quoted);
  }
  return expression;
}

}  // namespace

EntryStore EntryStore::open(const std::filesystem::path& path) {
  SqlFile file(path, SqlFile::Mode::kRead);
  check_format(file);
  return EntryStore(std::move(file));
}

EntryStore EntryStore::create(const std::filesystem::path& path) {
  SqlFile file(path, SqlFile::Mode::kCreate);
  file.execute("BEGIN IMMEDIATE");  // of several processes that find no file, one makes the tables
  SqlStatement tables = file.prepare("SELECT count(*) FROM sqlite_master");
  tables.step();
  const bool fresh = tables.number(0) == 0;
  tables.reset();
  if (fresh) file.execute(schema());
  file.execute("COMMIT");
  check_format(file);
  return EntryStore(std::move(file));
}

std::vector<std::string> EntryStore::ids() const {
  std::vector<std::string> ids;
  for (SqlStatement rows = file_.prepare("SELECT id FROM entry ORDER BY id"); rows.step();) ids.push_back(rows.text(0));
  return ids;
}

std::vector<std::pair<std::string, std::string>> EntryStore::aliases() const {
  std::vector<std::pair<std::string, std::string>> aliases;
  for (SqlStatement rows = file_.prepare("SELECT alias, id FROM alias ORDER BY alias"); rows.step();)
    aliases.emplace_back(rows.text(0), rows.text(1));
  return aliases;
}

std::optional<std::string> EntryStore::full_id(std::string_view id_or_alias) const {
  SqlStatement row =
      file_.prepare("SELECT id FROM alias WHERE alias = ?1 UNION ALL SELECT id FROM entry WHERE id = ?1 LIMIT 1");
  row.bind(1, id_or_alias);
  if (!row.step()) return std::nullopt;
  return row.text(0);
}

Entry EntryStore::entry(const std::string& id) const {
  SqlStatement row = file_.prepare(fmt::format("SELECT {} FROM entry WHERE id = ?1", kColumns));
  row.bind(1, id);
  if (!row.step()) throw input_error("{}: no entry {}; expected one of its ids", path(), id);
  Entry entry;
  int column = 0;
  for (const auto text : kTexts) entry.*text = row.text(column++);
  for (const auto number : kNumbers) entry.*number = row.number(column++);
  entry.coefficients = row.numbers(column++);
  entry.column_names = words_of(row.text(column++), ',');
  entry.wavelength_nm = row.numbers(column++);
  set_columns(entry, row.numbers(column));
  return entry;
}

std::vector<std::string> EntryStore::search(std::string_view words) const {
  const std::string expression = match_expression(words);
  if (expression.empty()) return {};
  SqlStatement rows = file_.prepare("SELECT id FROM words WHERE words MATCH ?1 ORDER BY rank, id");
  rows.bind(1, expression);
  std::vector<std::string> ids;
  while (rows.step()) ids.push_back(rows.text(0));
  return ids;
}

void EntryStore::put(const Entry& entry, const std::vector<std::string>& aliases) {
  SqlStatement row = file_.prepare(
      fmt::format("INSERT INTO entry({}) VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, "
                  "?17, ?18, ?19, ?20, ?21, ?22)",
                  kColumns));
  int parameter = 1;
  for (const auto text : kTexts) row.bind(parameter++, entry.*text);
  for (const auto number : kNumbers) row.bind(parameter++, entry.*number);
  row.bind(parameter++, entry.coefficients);
  row.bind(parameter++, fmt::format("{}", fmt::join(entry.column_names, ",")));
  row.bind(parameter++, entry.wavelength_nm);
  row.bind(parameter, joined(entry));
  row.step();
  for (const std::string& alias : aliases) {
    SqlStatement name = file_.prepare("INSERT INTO alias VALUES(?1, ?2)");
    name.bind(1, alias).bind(2, entry.id).step();
  }
  SqlStatement words = file_.prepare("INSERT INTO words VALUES(?1, ?2, ?3, ?4, ?5)");
  words.bind(1, entry.id).bind(2, fmt::format("{}", fmt::join(aliases, " "))).bind(3, entry.name);
  words.bind(4, entry.kind).bind(5, entry.citation).step();
}

void EntryStore::remove(const std::string& id) {
  for (const char* table : {"entry", "alias", "words"}) {
    SqlStatement rows = file_.prepare(fmt::format("DELETE FROM {} WHERE id = ?1", table));
    rows.bind(1, id).step();
  }
}

}  // namespace gonio
