#include "materials/entry_checks.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "materials/entry_reader.h"
#include "optics/dispersion.h"

namespace gonio {
namespace {

/// Measured reflectances may exceed 1 by their noise.
constexpr double kNoise = 0.02;

/// Bytes of the UTF-8 character that starts here; 0 when it is none.
std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF && follows(1)) return 2;
  if (first >= 0xE0 && first <= 0xEF && follows(1) && follows(2)) {
    const unsigned value = (first & 0x0Fu) << 12 | (byte(1) & 0x3Fu) << 6 | (byte(2) & 0x3Fu);
    return value >= 0x800 && (value < 0xD800 || value > 0xDFFF) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4 && follows(1) && follows(2) && follows(3)) {
    const unsigned value = (first & 7u) << 18 | (byte(1) & 0x3Fu) << 12;
    return value >= 0x10000 && value <= 0x10FFFF ? 4 : 0;
  }
  return 0;
}

struct Limits {
  double lo, hi;
  bool lo_itself;  ///< the lower limit is allowed
  const char* words;
};

Limits limits_of(const std::string& column) {
  if (column == "n") return {0, 1e3, false, "more than 0 and at most 1000"};
  if (column == "k") return {0, 1e4, true, "0 to 10000"};
  if (column == "reflectance" || column == "transmittance") return {0, 1 + kNoise, true, "0 to 1 (1.02 with noise)"};
  if (column == "relative_power") return {0, 1e12, true, "at least 0"};
  if (column == "rbar" || column == "gbar" || column == "bbar") return {-10, 10, true, "-10 to 10"};
  if (column == "S0" || column == "S1" || column == "S2") return {-1000, 1000, true, "-1000 to 1000"};
  return {0, 10, true, "0 to 10"};  // luminous efficiencies and colour-matching functions
}

const char* coefficients_in_words(Dispersion formula) {
  switch (formula) {
    case Dispersion::kRefractiveIndexInfo:
      return "5, 9 or a greater odd number";
    case Dispersion::kHerzberger:
      return "3 to 6";
    case Dispersion::kRetro:
      return "4";
    case Dispersion::kExotic:
      return "6";
    default:
      return "an odd number (c0, then pairs)";
  }
}

void check_formula(const Entry& entry) {
  const Dispersion formula = *dispersion_named(entry.formula);
  if (!takes_coefficients(formula, entry.coefficients.size()))
    throw input_error("{}: {} coefficients; formula {} expects {}", entry.file, entry.coefficients.size(),
                      entry.formula, coefficients_in_words(formula));
  constexpr int kProbes = 256;
  for (int i = 0; i <= kProbes; ++i) {
    const double nm = entry.range_lo_nm + (entry.range_hi_nm - entry.range_lo_nm) * i / kProbes;
    const double n = refractive_index<double>(formula, entry.coefficients, nm * 1e-3);
    if (!(n > 0) || !(n <= limits_of("n").hi))
      throw input_error("{}: the formula gives n = {} at {} nm; expected {}", entry.file, n, nm, limits_of("n").words);
  }
}

void check_rows(const Entry& entry) {
  if (entry.wavelength_nm.size() < 2)
    throw input_error("{}: {} rows in the table; expected at least 2", entry.file, entry.wavelength_nm.size());
}

/// A table of k beside a formula for n lies within the formula's range.
void check_k_table(const Entry& entry) {
  check_rows(entry);
  if (entry.wavelength_nm.front() < entry.range_lo_nm || entry.wavelength_nm.back() > entry.range_hi_nm)
    throw input_error("{}: the table of k covers {} to {} nm; expected it within range_nm {} {}", entry.file,
                      entry.wavelength_nm.front(), entry.wavelength_nm.back(), entry.range_lo_nm, entry.range_hi_nm);
}

void check_table(const Entry& entry) {
  check_rows(entry);
  if (entry.wavelength_nm.front() != entry.range_lo_nm || entry.wavelength_nm.back() != entry.range_hi_nm)
    throw input_error("{}: range_nm is {} {}; expected that of the table, {} {}", entry.file, entry.range_lo_nm,
                      entry.range_hi_nm, entry.wavelength_nm.front(), entry.wavelength_nm.back());
  for (const std::vector<double>& column : entry.columns)
    if (std::all_of(column.begin(), column.end(), [](double v) { return !(v > 0); }) &&
        entry.kind != "optical-constants")
      throw input_error("{}: a column is 0 everywhere; expected some value above 0", entry.file);
}

}  // namespace

void check_text(std::string_view text, const std::string& file) {
  if (text.empty()) throw input_error("{}: is empty; expected an entry (key: value lines, ---, a table)", file);
  int line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const unsigned char byte = static_cast<unsigned char>(text[at]);
    const std::size_t size = character_size(text.substr(at));
    if (size == 0 || byte == 0x7F || (byte < 0x20 && byte != '\n' && byte != '\r' && byte != '\t'))
      throw input_error("{}:{}: not text (byte 0x{:02x}); expected UTF-8 without control characters", file, line, byte);
    line += byte == '\n';
    at += size;
  }
}

void check_value(const std::string& column, double value, const std::string& file, int line) {
  const Limits limits = limits_of(column);
  if (value > limits.hi || value < limits.lo || (value == limits.lo && !limits.lo_itself))
    throw input_error("{}:{}: {} is {}; expected {}", file, line, column, value, limits.words);
}

void check_header(const Entry& entry) {
  const auto need = [&](bool there, const char* key) {
    if (!there) throw input_error("{}: {} is missing; every entry needs it", entry.file, key);
  };
  need(!entry.id.empty(), "id"), need(!entry.name.empty(), "name"), need(!entry.kind.empty(), "kind");
  need(!entry.unit.empty(), "unit"), need(!entry.citation.empty(), "citation"), need(!entry.licence.empty(), "licence");
  need(entry.range_hi_nm > 0, "range_nm"), need(entry.source_hi_nm > 0, "source_range_nm"),
      need(!entry.confidence.empty(), "confidence");
  if (columns_of_kind(entry.kind).empty())
    throw input_error(
        "{}: kind is '{}'; expected optical-constants, reflectance, transmittance, illuminant, observer, "
        "luminous-efficiency, cone-fundamentals, rgb-observer or daylight-basis",
        entry.file, entry.kind);
  if (entry.confidence != "high" && entry.confidence != "medium" && entry.confidence != "low")
    throw input_error("{}: confidence is '{}'; expected high, medium or low", entry.file, entry.confidence);
  if (entry.range_lo_nm < entry.source_lo_nm || entry.range_hi_nm > entry.source_hi_nm)
    throw input_error("{}: range_nm {} {} exceeds source_range_nm {} {}; expected it inside", entry.file,
                      entry.range_lo_nm, entry.range_hi_nm, entry.source_lo_nm, entry.source_hi_nm);
  if (entry.formula.empty() != entry.coefficients.empty())
    throw input_error("{}: formula and coefficients go together; expected both or none", entry.file);
  if (entry.formula.empty()) return;
  if (entry.kind != "optical-constants")
    throw input_error("{}: a formula for kind {}; expected optical-constants", entry.file, entry.kind);
  if (!dispersion_named(entry.formula))
    throw input_error("{}: formula is '{}'; expected one of {}", entry.file, entry.formula,
                      fmt::join(kDispersionNames, ", "));
}

void check_entry(const Entry& entry) {
  if (entry.formula.empty())
    check_table(entry);
  else
    check_formula(entry);
  if (!entry.formula.empty() && !entry.wavelength_nm.empty()) check_k_table(entry);
}

void check_whole_entry(const Entry& entry) {
  check_header(entry);
  const std::size_t rows = entry.wavelength_nm.size(), first = entry.formula.empty() ? 0 : 1;
  for (std::size_t row = 0; row < rows; ++row)
    if (!(entry.wavelength_nm[row] > (row == 0 ? 0 : entry.wavelength_nm[row - 1])) ||
        !std::isfinite(entry.wavelength_nm[row]))
      throw input_error("{}: wavelength {} nm in row {}; expected them positive and increasing", entry.id,
                        entry.wavelength_nm[row], row + 1);
  const std::vector<std::string>& known = columns_of_kind(entry.kind);
  if (entry.column_names.size() > known.size() ||
      !std::equal(entry.column_names.begin(), entry.column_names.end(), known.begin()))
    throw input_error("{}: the columns are '{}'; expected {}", entry.id, fmt::join(entry.column_names, ","),
                      fmt::join(known, ","));
  for (std::size_t c = first; c < entry.columns.size(); ++c)
    for (std::size_t row = 0; row < rows; ++row) {
      const double value = entry.columns[c][row];
      if (std::isnan(value) && entry.column_names[c] == "k") continue;
      if (!std::isfinite(value))
        throw input_error("{}: {} in row {} is {}; expected a number", entry.id, entry.column_names[c], row + 1, value);
      check_value(entry.column_names[c], value, entry.id, static_cast<int>(row + 1));
    }
  check_entry(entry);
}

}  // namespace gonio
