// Text files of ALTA ("Data File Formats" of its manual, http://alta.gforge.inria.fr/data-formats.html): lines that start
// with # and a letter are the header (#DIM N P, #PARAM_IN, #PARAM_OUT, #VS one number a value), # and anything else a
// comment; then rows of N coordinates, P values and, where VS says so, 1 (a radius) or 2 (lower and upper end) numbers a
// value. Angles are radians; the coordinates are those of its list of parametrisations.
#include <array>
#include <cctype>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/number.h"
#include "fit/csv.h"
#include "fit/formats/collect.h"
#include "fit/formats/readers.h"
#include "fit/formats/text.h"

namespace gonio {
namespace {

struct Parametrisation {
  std::string_view name;
  long dimension;
  std::string_view said;
};
constexpr std::array<Parametrisation, 6> kKnown{{
    {"SPHERICAL_TL_PL_TV_PV", 4, "light and view in one frame, phi = phi_V - phi_L, 180 = mirror side"},
    {"ISOTROPIC_TV_TL_DPHI", 3, "phi = difference of azimuth of view and light, 180 = mirror side"},
    {"ISOTROPIC_TV_TL", 2, "no azimuth in the file: the view is on the mirror side"},
    {"RUSIN_TH_TD_PD", 3,
     "half and difference angles (Rusinkiewicz), phi_D = 0 in the plane of half vector and normal"},
    {"RUSIN_TH_PH_TD_PD", 4,
     "half and difference angles (Rusinkiewicz), phi_D = 0 in the plane of half vector and normal"},
    {"CARTESIAN", 6, "components of view, then light"},
}};

struct Header {
  const Parametrisation* in = nullptr;
  std::string_view out;
  long n = 0, p = 0, vs_columns = 0;
  int line = 1;
  std::size_t columns() const { return static_cast<std::size_t>(n + p + vs_columns); }
};

bool is_header_line(std::string_view text) {
  return text.size() > 1 && text[0] == '#' && std::isalpha(static_cast<unsigned char>(text[1]));
}

void read_dimensions(const std::vector<std::string_view>& words, const std::string& file, int line, Header& header) {
  if (words.size() != 3) throw input_error("{}:{}: #DIM has {} numbers; expected 2", file, line, words.size() - 1);
  header.n = whole_number(words[1], "#DIM", 6, file, line);
  header.p = whole_number(words[2], "#DIM", 3, file, line);
  if (header.n < 2 || (header.p != 1 && header.p != 3))
    throw input_error("{}:{}: #DIM is {} {}; expected 2 to 6 coordinates and 1 or 3 values", file, line, header.n,
                      header.p);
}

void read_key(const TextLine& at, const std::string& file, Header& header, Measurement& scan,
              std::set<std::string_view>& seen) {
  const std::vector<std::string_view> words = words_of(at.text);
  const std::string_view key = words[0];
  if (!seen.insert(key).second)
    throw input_error("{}:{}: {} appears twice; expected once", file, at.line, printable(key));
  if (key == "#DIM") return read_dimensions(words, file, at.line, header);
  if (key == "#PARAM_IN" || key == "#PARAM_OUT") {
    if (words.size() != 2) throw input_error("{}:{}: {} has no name; expected one", file, at.line, key);
    if (key == "#PARAM_OUT") {
      header.out = words[1];
      return;
    }
    for (const Parametrisation& known : kKnown)
      if (known.name == words[1]) header.in = &known;
    if (header.in == nullptr)
      throw input_error(
          "{}:{}: #PARAM_IN is `{}`; expected SPHERICAL_TL_PL_TV_PV, ISOTROPIC_TV_TL_DPHI, "
          "ISOTROPIC_TV_TL, RUSIN_TH_TD_PD, RUSIN_TH_PH_TD_PD or CARTESIAN",
          file, at.line, printable(words[1]));
    return;
  }
  if (key == "#VS") {
    if (!seen.contains("#DIM") || words.size() != static_cast<std::size_t>(header.p) + 1)
      throw input_error("{}:{}: #VS has {} numbers; expected one a value, after #DIM", file, at.line, words.size() - 1);
    for (std::size_t k = 1; k < words.size(); ++k) header.vs_columns += whole_number(words[k], "#VS", 2, file, at.line);
    return;
  }
  if (key == "#FORMAT" && words.size() > 1 && words[1] == "binary")
    throw input_error("{}:{}: #FORMAT is binary; expected the textual format", file, at.line);
  scan.notes.push_back(fmt::format("header line `{}` is not used", printable(at.text)));
}

void set_conventions(const Header& header, const std::string& file, Measurement& scan) {
  if (header.in == nullptr || header.out.empty() || header.p == 0)
    throw input_error("{}:{}: the header is not whole; expected #DIM, #PARAM_IN and #PARAM_OUT", file, header.line);
  if (header.in->dimension != header.n)
    throw input_error("{}:{}: #DIM says {} coordinates; expected {} for {}", file, header.line, header.n,
                      header.in->dimension, header.in->name);
  const bool colour = header.out == "RGB_COLOR" || header.out == "XYZ_COLOR";
  const bool cosine = header.out == "INV_STERADIAN_COSINE_FACTOR";
  if (!colour && !cosine && header.out != "INV_STERADIAN")
    throw input_error(
        "{}:{}: #PARAM_OUT is `{}`; expected INV_STERADIAN, INV_STERADIAN_COSINE_FACTOR, RGB_COLOR or "
        "XYZ_COLOR",
        file, header.line, printable(header.out));
  if (colour != (header.p == 3))
    throw input_error("{}:{}: #DIM says {} values; expected {} for {}", file, header.line, header.p, colour ? 3 : 1,
                      header.out);
  if (cosine && header.in->name.starts_with("RUSIN"))
    throw input_error(
        "{}:{}: which of the two directions the cosine belongs to is not said by {}; expected "
        "INV_STERADIAN",
        file, header.line, header.in->name);
  if (cosine) scan.quantity = "brdf_cos";
  scan.conventions = {fmt::format("quantity: {} ({})", scan.quantity, header.out), "angles: radians",
                      fmt::format("azimuth: {} ({})", header.in->said, header.in->name), "scale: absolute, sr^-1",
                      !colour                     ? "channel: one value, wavelength not stated"
                      : header.out == "RGB_COLOR" ? "channel: G of R, G, B"
                                                  : "channel: Y of X, Y, Z"};
}

/// An angle of any size, in degrees.
double degrees(double radians) { return radians * (180 / kPi<double>); }

struct Row {
  const std::vector<double>& x;
  const std::string& file;
  int line;
  double zenith(std::size_t at) const { return zenith_deg(x[at], true, "a zenith angle", file, line); }
};

DirectionPair cartesian(const Row& row) {
  const auto& x = row.x;
  for (const std::size_t at : {std::size_t{0}, std::size_t{3}})
    if (std::abs(std::hypot(x[at], x[at + 1], x[at + 2]) - 1) > 1e-3)
      throw input_error("{}:{}: a direction has another length than 1; expected unit vectors", row.file, row.line);
  return {{x[3], x[4], x[5]}, {x[0], x[1], x[2]}};
}

void add_row(const Row& row, const Header& header, double value, PointCollector& points) {
  const std::string_view name = header.in->name;
  const auto& x = row.x;
  DirectionPair pair;
  if (name == "CARTESIAN") {
    pair = cartesian(row);
  } else if (name == "RUSIN_TH_TD_PD") {
    pair = from_half_difference_deg(row.zenith(0), 0, row.zenith(1), degrees(x[2]));
  } else if (name == "RUSIN_TH_PH_TD_PD") {
    pair = from_half_difference_deg(row.zenith(0), degrees(x[1]), row.zenith(2), degrees(x[3]));
  } else {
    const bool spherical = header.n == 4;
    ScanPoint point;
    point.theta_i_deg = row.zenith(spherical ? 0 : 1);
    point.theta_o_deg = row.zenith(spherical ? 2 : 0);
    point.phi_i_deg = spherical ? degrees(x[1]) : 0;
    point.phi_o_deg = spherical ? degrees(x[3]) : header.n == 3 ? degrees(x[2]) : 180;
    return points.add(point, value, row.line);
  }
  bool below = false;
  const ScanPoint point = point_of(pair, below);
  if (below) return points.leave_out("at or below the horizon");
  points.add(point, value, row.line);
}

}  // namespace

bool is_alta(std::string_view head) { return head.find("#DIM") != head.npos && head.find("#PARAM_IN") != head.npos; }

Measurement read_alta(std::string_view bytes, const std::string& file) {
  Header header;
  PointCollector points({}, file);
  std::set<std::string_view> seen;
  bool in_header = true;
  for (const TextLine& at : text_lines(bytes, file)) {
    if (at.text.empty() || (at.text[0] == '#' && !is_header_line(at.text))) continue;
    if (is_header_line(at.text)) {
      if (!in_header) throw input_error("{}:{}: a header line stands among the rows; expected numbers", file, at.line);
      if (at.text != "#ALTA END HEADER" && at.text != "#ALTA_HEADER_END" && at.text != "#ALTA BEGIN HEADER")
        read_key(at, file, header, points.scan(), seen);
      continue;
    }
    header.line = in_header ? at.line : header.line;
    if (in_header) set_conventions(header, file, points.scan());
    in_header = false;
    const std::vector<std::string_view> words = words_of(at.text);
    if (words.size() != header.columns())
      throw input_error("{}:{}: row has {} numbers; expected {}", file, at.line, words.size(), header.columns());
    std::vector<double> x;
    for (const std::string_view word : words) x.push_back(csv_number(word, "a number", file, at.line));
    const auto value = static_cast<std::size_t>(header.n + (header.p == 3 ? 1 : 0));
    add_row({x, file, at.line}, header, x[value], points);
  }
  if (in_header) set_conventions(header, file, points.scan());
  if (header.vs_columns > 0) points.scan().notes.push_back("vertical segments (#VS) are not used");
  return points.finish(header.line);
}

}  // namespace gonio
