// ASTM E1392-96 and E2387-05 (angle-resolved and goniometric optical scatter), as text files: `KEY value` lines, the
// last one `VARS theta_i,phi_i,theta_s,phi_s,…`, then one row a pair of directions. Both directions have their azimuth in
// one frame (E2387: the light comes from φ_i = 180°, φ_s = 0 is forward scatter), so φ_s - φ_i = 180° is the mirror side.
// The standards name the quantities; that angles without a stated unit are radians is the practice of the files of
// Cornell University's Program of Computer Graphics, the published ones.
#include <array>
#include <charconv>
#include <map>
#include <set>

#include "base/error.h"
#include "base/number.h"
#include "fit/csv.h"
#include "fit/formats/collect.h"
#include "fit/formats/readers.h"
#include "fit/formats/text.h"

namespace gonio {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

struct Value {
  std::string_view text;
  int line = 0;
};

struct ValueColumn {
  std::size_t at = kNone;
  double wavelength_nm = kNotStated;
};

struct Header {
  std::map<std::string, Value, std::less<>> keys;
  std::vector<std::string_view> names;
  int vars_line = 0;
  bool radians = true, unit_stated = false;
  std::size_t theta_i = kNone, phi_i = kNone, theta_o = kNone, phi_o = kNone;
  std::vector<ValueColumn> values;
  std::string channel;

  const Value* find(std::string_view key) const {
    const auto found = keys.find(key);
    return found == keys.end() ? nullptr : &found->second;
  }
};

bool is_key(std::string_view word) {
  for (const char c : word)
    if (!((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_')) return false;
  return !word.empty() && word[0] >= 'A' && word[0] <= 'Z';
}

/// The lines up to VARS; the index of the first row.
std::size_t read_header(const std::vector<TextLine>& lines, const std::string& file, Header& header) {
  for (std::size_t at = 0; at < lines.size(); ++at) {
    const auto& [line, text] = lines[at];
    if (text.empty() || text.front() == '#') continue;
    const std::size_t gap = text.find_first_of(" \t");
    const std::string_view key = text.substr(0, gap);
    if (!is_key(key))
      throw input_error("{}:{}: `{}` is no key in capitals; expected `KEY value` lines up to VARS", file, line,
                        printable(key));
    std::string_view rest = gap == text.npos ? std::string_view{} : text.substr(gap + 1);
    while (!rest.empty() && (rest.front() == ' ' || rest.front() == '\t')) rest.remove_prefix(1);
    if (!header.keys.emplace(std::string(key), Value{rest, line}).second)
      throw input_error("{}:{}: {} appears twice; expected once", file, line, printable(key));
    if (key != "VARS") continue;
    header.names = words_of(rest);
    header.vars_line = line;
    return at + 1;
  }
  throw input_error("{}:{}: the file ends without VARS; expected `VARS theta_i,phi_i,theta_s,phi_s,…`", file,
                    lines.back().line);
}

/// 550nm, 0.55um; NaN for another name.
double wavelength_named(std::string_view name) {
  const bool um = name.ends_with("um");
  if (!um && !name.ends_with("nm")) return kNotStated;
  const std::string_view digits = name.substr(0, name.size() - 2);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) return kNotStated;
  return um ? value * 1000 : value;
}

/// One of three colour columns: the middle one.
bool take_colour(Header& header, const std::vector<std::size_t>& others, std::string_view three) {
  if (others.size() != 3) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (header.names[others[k]] != three.substr(k, 1)) return false;
  header.values.push_back({others[1], kNotStated});
  header.channel = fmt::format("{} of {}, {}, {}", three[1], three[0], three[1], three[2]);
  return true;
}

void find_values(Header& header, const std::vector<std::size_t>& others, const std::string& file) {
  if (others.empty())
    throw input_error("{}:{}: VARS names no value; expected wavelengths (550nm), R,G,B, X,Y,Z or one value", file,
                      header.vars_line);
  for (const std::size_t at : others)
    if (const double nm = wavelength_named(header.names[at]); nm == nm) {
      if (!(nm >= 100 && nm <= 1e5))
        throw input_error("{}:{}: VARS names {}; expected 100 to 100000 nm", file, header.vars_line,
                          printable(header.names[at]));
      header.values.push_back({at, nm});
    }
  if (header.values.size() == others.size()) return;
  header.values.clear();
  if (take_colour(header, others, "RGB") || take_colour(header, others, "XYZ")) return;
  if (others.size() != 1)
    throw input_error("{}:{}: VARS names {} values; expected wavelengths (550nm), R,G,B, X,Y,Z or one value", file,
                      header.vars_line, others.size());
  header.values.push_back({others[0], kNotStated});
  header.channel = fmt::format("the one value, `{}`", printable(header.names[others[0]]));
}

void find_columns(Header& header, const std::string& file) {
  std::vector<std::size_t> others;
  std::set<std::string_view> seen;
  for (std::size_t at = 0; at < header.names.size(); ++at) {
    const std::string_view name = header.names[at];
    const bool theta_o = name == "theta_s" || name == "theta_r", phi_o = name == "phi_s" || name == "phi_r";
    std::size_t* place = name == "theta_i" ? &header.theta_i
                         : name == "phi_i" ? &header.phi_i
                         : theta_o         ? &header.theta_o
                         : phi_o           ? &header.phi_o
                                           : nullptr;
    if (name.empty() || !seen.insert(name).second || (place != nullptr && *place != kNone))
      throw input_error("{}:{}: VARS names `{}` twice or empty; expected each column once", file, header.vars_line,
                        printable(name));
    if (place != nullptr)
      *place = at;
    else
      others.push_back(at);
  }
  if (header.theta_i == kNone || header.phi_i == kNone || header.theta_o == kNone || header.phi_o == kNone)
    throw input_error("{}:{}: VARS lacks an angle; expected theta_i, phi_i, theta_s, phi_s", file, header.vars_line);
  find_values(header, others, file);
}

/// ANGLE_UNITS and QUANTITY are gonio's own keys: the standards' have no place for them.
void read_units(Header& header, Measurement& scan, const std::string& file) {
  if (const Value* units = header.find("ANGLE_UNITS")) {
    if (units->text != "degrees" && units->text != "radians")
      throw input_error("{}:{}: ANGLE_UNITS is `{}`; expected degrees or radians", file, units->line,
                        printable(units->text));
    header.unit_stated = true;
    header.radians = units->text == "radians";
  }
  if (const Value* quantity = header.find("QUANTITY")) {
    const std::string_view text = quantity->text;
    if (text != "brdf" && text != "brdf_cos" && text != "reflectance_factor" && text != "relative")
      throw input_error("{}:{}: QUANTITY is `{}`; expected brdf, brdf_cos, reflectance_factor or relative", file,
                        quantity->line, printable(text));
    scan.quantity = text;
  }
  if (const Value* name = header.find("MEAS_NAME"); name != nullptr && name->text == "BTDF")
    throw input_error("{}:{}: MEAS_NAME is BTDF; expected a measurement of reflection", file, name->line);
}

std::string unquoted(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return std::string(text);
}

void keep_texts(const Header& header, Measurement& scan) {
  for (const auto& [key, value] : header.keys) {
    const bool used = key == "VARS" || key == "NUM_POINTS" || key == "ANGLE_UNITS" || key == "QUANTITY" ||
                      (key == "MEAS_NAME" && value.text == "BRDF");
    if (key == "SAMPLE_NAME")
      scan.name = scan.sample = unquoted(value.text);
    else if (key == "SYSTEM_NAME")
      scan.instrument = unquoted(value.text);
    else if (key == "LAB_NAME")
      scan.source = unquoted(value.text);
    else if (!used)
      scan.notes.push_back(fmt::format("{} `{}` is not used", key, printable(value.text)));
  }
  scan.conventions.push_back(fmt::format("quantity: {} ({})", scan.quantity,
                                         header.find("QUANTITY") ? "stated in the file" : "as the standard's BRDF"));
  scan.conventions.push_back(fmt::format(
      "angles: {} ({})", header.radians ? "radians" : "degrees",
      header.unit_stated ? "stated in the file" : "not stated in the file; the practice of the published files"));
  scan.conventions.push_back("azimuth: both directions in one frame, phi = phi_s - phi_i, 180 = mirror side");
  scan.conventions.push_back(scan.quantity == "relative" ? "scale: relative" : "scale: absolute, sr^-1");
  if (!header.channel.empty()) scan.conventions.push_back("channel: " + header.channel);
}

long stated_rows(const Header& header, const std::string& file) {
  const Value* stated = header.find("NUM_POINTS");
  if (stated == nullptr)
    throw input_error("{}:{}: NUM_POINTS is missing; expected the number of rows before VARS", file, header.vars_line);
  return whole_number(stated->text, "NUM_POINTS", 100000000, file, stated->line);
}

/// Every cell is checked, used or not.
void add_row(const TextLine& row, const Header& header, PointCollector& points, const std::string& file) {
  const std::vector<std::string_view> cells = words_of(row.text);
  if (cells.size() != header.names.size())
    throw input_error("{}:{}: row has {} cells; expected {} as in VARS", file, row.line, cells.size(),
                      header.names.size());
  std::vector<double> numbers;
  for (std::size_t c = 0; c < cells.size(); ++c)
    numbers.push_back(csv_number(cells[c], header.names[c], file, row.line));
  const auto zenith = [&](std::size_t column) {
    return zenith_deg(numbers[column], header.radians, header.names[column], file, row.line);
  };
  const double to_deg = header.radians ? 180 / kPi<double> : 1;
  ScanPoint point;
  point.theta_i_deg = zenith(header.theta_i), point.theta_o_deg = zenith(header.theta_o);
  point.phi_i_deg = numbers[header.phi_i] * to_deg, point.phi_o_deg = numbers[header.phi_o] * to_deg;
  for (const ValueColumn& column : header.values) {
    point.wavelength_nm = column.wavelength_nm;
    points.add(point, numbers[column.at], row.line);
  }
}

}  // namespace

bool is_astm(std::string_view head) {
  return head.starts_with("VARS ") || head.find("\nVARS ") != head.npos || head.find("\nVARS\t") != head.npos;
}

Measurement read_astm(std::string_view bytes, const std::string& file) {
  const std::vector<TextLine> lines = text_lines(bytes, file);
  Header header;
  const std::size_t first = read_header(lines, file, header);
  find_columns(header, file);
  PointCollector points({}, file);
  read_units(header, points.scan(), file);
  keep_texts(header, points.scan());
  const long count = stated_rows(header, file);
  long rows = 0;
  for (std::size_t at = first; at < lines.size(); ++at) {
    if (lines[at].text.empty()) continue;
    if (++rows > count) throw input_error("{}:{}: more rows than NUM_POINTS; expected {}", file, lines[at].line, count);
    add_row(lines[at], header, points, file);
  }
  if (rows != count)
    throw input_error("{}:{}: the file ends after {} rows; expected {} as in NUM_POINTS", file, lines.back().line, rows,
                      count);
  return points.finish(header.vars_line);
}

}  // namespace gonio
