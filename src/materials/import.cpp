#include "materials/import.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "materials/entry_checks.h"
#include "materials/entry_reader.h"
#include "materials/import_formats.h"

namespace gonio {

int exponent_to_nm(std::string_view unit, const std::string& file, int line) {
  if (unit == "nm") return 0;
  if (unit == "um" || unit == "µm" || unit == "μm" || unit == "micron") return 3;
  if (unit == "A" || unit == "Å" || unit == "angstrom") return -1;
  throw input_error("{}:{}: '{}' is no unit of wavelength known here; expected nm, um or A", file, line, unit);
}

double scaled_number(std::string_view cell, int exponent, const std::string& what, const std::string& file, int line) {
  cell = trimmed(cell);
  const std::size_t e = cell.find_first_of("eE");
  int own = 0;
  bool good = !cell.empty() && cell.front() != '+';
  if (e != std::string_view::npos) {
    std::string_view digits = cell.substr(e + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), own);
    good = good && error == std::errc() && end == digits.data() + digits.size() && std::abs(own) < 1000;
  }
  double number = 0;
  good = good && parse_number(fmt::format("{}e{}", cell.substr(0, e), own + exponent), number);
  if (!good) throw input_error("{}:{}: {} is '{}'; expected a finite number", file, line, what, cell);
  return number;
}

void append_row(Entry& entry, double wavelength_nm, const std::vector<double>& values, const std::string& file,
                int line) {
  const double before = entry.wavelength_nm.empty() ? 0 : entry.wavelength_nm.back();
  if (wavelength_nm == before)
    throw input_error("{}:{}: wavelength {} nm is given twice; expected each once", file, line, wavelength_nm);
  if (!(wavelength_nm > before))
    throw input_error("{}:{}: wavelength {} nm after {} nm; expected positive ones in increasing order", file, line,
                      wavelength_nm, before);
  entry.wavelength_nm.push_back(wavelength_nm);
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (!std::isnan(values[c])) check_value(entry.column_names[c], values[c], file, line);
    entry.columns[c].push_back(values[c]);
  }
}

void check_unit(const Entry& entry, std::string_view unit, const std::string& file) {
  constexpr double kLeastNm = 20, kMostNm = 1e5;
  const double lo = entry.range_lo_nm, hi = entry.range_hi_nm;
  if (unit == "nm" && hi < kLeastNm)
    throw input_error("{}: wavelengths of {} to {} nm look like um; expected nm, or another unit named", file, lo, hi);
  if (unit != "nm" && lo >= kMostNm)
    throw input_error("{}: wavelengths of {} to {} um look like nm; expected um, or another unit named", file,
                      lo * 1e-3, hi * 1e-3);
}

namespace {

bool is_yaml(const std::string& file) {
  const std::string suffix = std::filesystem::path(file).extension().string();
  return suffix == ".yml" || suffix == ".yaml";
}

bool is_entry_text(std::string_view text) {
  return text.starts_with("id:") || text.find("\nid:") != std::string_view::npos;
}

/// What the user says goes before what the file says; then what is left gets its default.
void complete(Entry& entry, const std::string& file, const ImportOptions& options) {
  const auto set = [](std::string& field, const std::string& said) {
    if (!said.empty()) field = said;
  };
  set(entry.id, options.id), set(entry.name, options.name), set(entry.citation, options.citation);
  set(entry.doi, options.doi), set(entry.licence, options.licence);
  set(entry.specimen, options.specimen), set(entry.temperature, options.temperature);
  const auto otherwise = [](std::string& field, std::string text) {
    if (field.empty()) field = std::move(text);
  };
  otherwise(entry.id, std::filesystem::path(file).stem().string());
  otherwise(entry.name, entry.id), otherwise(entry.licence, "not stated"), otherwise(entry.confidence, "medium");
  otherwise(entry.unit, entry.kind == "optical-constants" ? "1 (n + ik, k >= 0)" : "1");
}

/// Ids stand in command lines and files.
void check_id(const Entry& entry) {
  for (const char c : entry.id)
    if (static_cast<unsigned char>(c) <= ' ' || c == '/' || c == ',')
      throw input_error("{}: id '{}' has a blank, comma or slash; expected --id without", entry.file, entry.id);
}

void check_one_line(const Entry& entry) {
  for (const std::string* text : {&entry.id, &entry.name, &entry.citation, &entry.doi, &entry.licence, &entry.specimen,
                                  &entry.temperature, &entry.note})
    if (!text->empty()) {
      check_text(*text, entry.file);
      if (text->find('\n') != std::string::npos)
        throw input_error("{}: a text of several lines; expected one line each", entry.file);
    }
}

}  // namespace

Entry read_import(std::string_view text, const std::string& file, const ImportOptions& options) {
  check_text(text, file);
  Entry entry;
  if (is_yaml(file))
    entry = read_yaml_entry(text, file);
  else if (is_entry_text(text))
    entry = read_entry(text, file);
  else
    entry = read_table_entry(text, file, options);
  entry.file = file;
  complete(entry, file, options);
  if (!options.kind.empty() && entry.kind != options.kind)
    throw input_error("{}: is of kind {}; expected {} as --kind says", file, entry.kind, options.kind);
  if (entry.citation.empty())
    throw input_error("{}: citation is missing; expected REFERENCES, a line `# citation: …` or --citation", file);
  check_one_line(entry);
  check_id(entry);
  check_header(entry);
  check_whole_entry(entry);
  entry.file = std::filesystem::path(file).filename().string();
  return entry;
}

}  // namespace gonio
