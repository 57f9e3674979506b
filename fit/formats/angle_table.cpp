// Plain tables of angles and values, as published beside papers (the tables with He et al., SIGGRAPH 1991, and of
// Cornell University's goniometer): comment lines, then columns of numbers. Nothing in such a file is standard, so the
// comments have to say how it is to be read, or it is refused:
//   # columns: theta_i theta_o phi value         (theta_i, phi_i, theta_o or theta_r, phi_o or phi_r, phi, value, std,
//                                                 wavelength_nm; `skip` for a column to leave out)
//   # angles: degrees                            (or radians)
//   # quantity: brdf                             (or brdf_cos, reflectance_factor, relative)
//   # azimuth: 180 = mirror                      (or 0 = mirror; or signed: no azimuth column, theta_o > 0 on the
//                                                 mirror side)
// Optional: points (their number), wavelength_nm, name, source, licence, instrument, sample, uncertainty.
#include <algorithm>
#include <cmath>
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

constexpr std::string_view kComment = "#%!;";
constexpr std::string_view kKeys[] = {"columns", "angles", "quantity", "azimuth", "points",     "wavelength_nm",
                                      "name",    "source", "licence",  "sample",  "instrument", "uncertainty"};

struct Said {
  std::string_view text;
  int line = 1;
};

struct Header {
  std::map<std::string_view, Said> said;
  std::map<std::string_view, std::size_t> place;
  std::size_t columns = 0;
  bool radians = false, is_signed = false;
  double mirror_deg = 180;
  int line = 1;

  bool has(std::string_view column) const { return place.contains(column); }
};

/// The key of a comment and what it says; false for any other comment.
bool key_of(std::string_view text, std::string_view& key, std::string_view& rest) {
  text.remove_prefix(std::min(text.size(), text.find_first_not_of("#%!; \t")));
  const std::size_t colon = text.find(':');
  if (colon == text.npos) return false;
  key = text.substr(0, colon);
  rest = text.substr(colon + 1);
  while (!rest.empty() && (rest.front() == ' ' || rest.front() == '\t')) rest.remove_prefix(1);
  return std::find(std::begin(kKeys), std::end(kKeys), key) != std::end(kKeys);
}

const Said& required(const Header& header, std::string_view key, std::string_view expected, const std::string& file) {
  const auto found = header.said.find(key);
  if (found == header.said.end())
    throw input_error("{}:{}: the comments do not say `{}:`; expected {}", file, header.line, key, expected);
  return found->second;
}

[[noreturn]] void refuse(const Said& said, std::string_view key, std::string_view expected, const std::string& file) {
  throw input_error("{}:{}: {} is `{}`; expected {}", file, said.line, key, printable(said.text), expected);
}

void read_columns(Header& header, const std::string& file) {
  const Said& columns = required(header, "columns", "the names of the columns", file);
  const std::set<std::string_view> known{"theta_i", "phi_i", "theta_o", "phi_o",
                                         "phi",     "value", "std",     "wavelength_nm"};
  for (std::string_view name : words_of(columns.text)) {
    if (name == "theta_r") name = "theta_o";
    if (name == "phi_r") name = "phi_o";
    const std::size_t at = header.columns++;
    if (name == "skip") continue;
    if (!known.contains(name))
      refuse({name, columns.line}, "a column", "theta_i, phi_i, theta_o, phi_o, phi, value, std, wavelength_nm or skip",
             file);
    if (!header.place.emplace(name, at).second)
      refuse({name, columns.line}, "a column named twice", "each column once", file);
  }
  const bool two = header.has("phi_i") && header.has("phi_o"), none = !header.has("phi_i") && !header.has("phi_o");
  if (!header.has("theta_i") || !header.has("theta_o") || !header.has("value"))
    refuse(columns, "columns", "theta_i, theta_o and value among them", file);
  if (header.is_signed ? !none || header.has("phi") : two == header.has("phi") || (!two && !none))
    refuse(columns, "columns", header.is_signed ? "no azimuth with `azimuth: signed`" : "phi, or phi_i and phi_o",
           file);
}

void read_conventions(Header& header, Measurement& scan, const std::string& file) {
  const Said& angles = required(header, "angles", "degrees or radians", file);
  if (angles.text != "degrees" && angles.text != "radians") refuse(angles, "angles", "degrees or radians", file);
  header.radians = angles.text == "radians";
  const Said& quantity = required(header, "quantity", "brdf, brdf_cos, reflectance_factor or relative", file);
  for (const std::string_view known : {"brdf", "brdf_cos", "reflectance_factor", "relative"})
    if (quantity.text == known) scan.quantity = known;
  if (scan.quantity != quantity.text)
    refuse(quantity, "quantity", "brdf, brdf_cos, reflectance_factor or relative", file);
  const Said& azimuth = required(header, "azimuth", "`180 = mirror`, `0 = mirror` or `signed`", file);
  header.is_signed = azimuth.text == "signed";
  if (azimuth.text == "0 = mirror")
    header.mirror_deg = 0;
  else if (azimuth.text != "180 = mirror" && !header.is_signed)
    refuse(azimuth, "azimuth", "`180 = mirror`, `0 = mirror` or `signed`", file);
  read_columns(header, file);
  scan.conventions = {fmt::format("quantity: {} (stated in the file)", scan.quantity),
                      fmt::format("angles: {} (stated in the file)", angles.text),
                      fmt::format("azimuth: {} (stated in the file)", azimuth.text),
                      scan.quantity == "relative" ? "scale: relative" : "scale: absolute, sr^-1",
                      "channel: the column `value`"};
}

void keep_texts(const Header& header, Measurement& scan, const std::string& file) {
  const auto text = [&](std::string_view key, std::string& kept) {
    if (const auto found = header.said.find(key); found != header.said.end()) kept = found->second.text;
  };
  text("name", scan.name), text("source", scan.source), text("licence", scan.licence);
  text("sample", scan.sample), text("instrument", scan.instrument), text("uncertainty", scan.uncertainty);
  const auto found = header.said.find("wavelength_nm");
  if (found == header.said.end()) return;
  const auto& [stated, line] = found->second;
  scan.wavelength_nm = csv_number(stated, "wavelength_nm", file, line);
  if (!(*scan.wavelength_nm >= 100 && *scan.wavelength_nm <= 1e5))
    refuse(found->second, "wavelength_nm", "100 to 100000 nm", file);
  if (header.has("wavelength_nm")) refuse(found->second, "wavelength_nm", "it once: here or as a column", file);
}

/// The rows' cells as numbers, every one of them checked.
std::vector<double> numbers_of(const TextLine& row, const Header& header, const std::string& file) {
  const std::vector<std::string_view> cells = words_of(row.text);
  if (cells.size() != header.columns)
    throw input_error("{}:{}: row has {} numbers; expected {} as in `columns:`", file, row.line, cells.size(),
                      header.columns);
  std::vector<double> numbers;
  for (const std::string_view cell : cells) numbers.push_back(csv_number(cell, "a number", file, row.line));
  return numbers;
}

ScanPoint point_of_row(const std::vector<double>& x, const Header& header, const std::string& file, int line) {
  const auto cell = [&](std::string_view name) { return header.has(name) ? x[header.place.at(name)] : kNotStated; };
  const double to_deg = header.radians ? 180 / kPi<double> : 1;
  ScanPoint point;
  point.theta_i_deg = zenith_deg(cell("theta_i"), header.radians, "theta_i", file, line);
  const double theta_o = cell("theta_o");
  point.theta_o_deg = zenith_deg(header.is_signed ? std::abs(theta_o) : theta_o, header.radians, "theta_o", file, line);
  if (header.is_signed) {
    point.phi_o_deg = theta_o < 0 ? 0 : 180;
  } else {
    point.phi_i_deg = header.has("phi") ? 0 : cell("phi_i") * to_deg;
    point.phi_o_deg = (header.has("phi") ? cell("phi") : cell("phi_o")) * to_deg + 180 - header.mirror_deg;
  }
  point.f_std_per_sr = cell("std");
  if (point.f_std_per_sr < 0) throw input_error("{}:{}: std is negative; expected 0 or more", file, line);
  point.wavelength_nm = cell("wavelength_nm");
  if (header.has("wavelength_nm") && !(point.wavelength_nm >= 100 && point.wavelength_nm <= 1e5))
    throw input_error("{}:{}: wavelength_nm is {}; expected 100 to 100000 nm", file, line, point.wavelength_nm);
  return point;
}

}  // namespace

bool is_angle_table(std::string_view head) {
  return !head.empty() && kComment.find(head[0]) != kComment.npos && head.find("columns:") != head.npos &&
         head.find("angles:") != head.npos;
}

Measurement read_angle_table(std::string_view bytes, const std::string& file) {
  Header header;
  std::vector<TextLine> rows;
  int other_comments = 0;
  for (const TextLine& at : text_lines(bytes, file)) {
    if (at.text.empty()) continue;
    if (kComment.find(at.text[0]) == kComment.npos) {
      rows.push_back(at);
      continue;
    }
    std::string_view key, rest;
    if (!key_of(at.text, key, rest)) {
      ++other_comments;
      continue;
    }
    if (!header.said.emplace(key, Said{rest, at.line}).second)
      throw input_error("{}:{}: `{}:` is said twice; expected once", file, at.line, key);
    header.line = at.line;
  }
  PointCollector points({}, file);
  read_conventions(header, points.scan(), file);
  keep_texts(header, points.scan(), file);
  if (other_comments > 0)
    points.scan().notes.push_back(fmt::format("{} other comment lines are not used", other_comments));
  for (const TextLine& row : rows) {
    const std::vector<double> x = numbers_of(row, header, file);
    points.add(point_of_row(x, header, file, row.line), x[header.place.at("value")], row.line);
  }
  if (const auto stated = header.said.find("points"); stated != header.said.end())
    if (whole_number(stated->second.text, "points", 100000000, file, stated->second.line) != std::ssize(rows))
      throw input_error("{}:{}: points is {}, but the table has {} rows; expected as many", file, stated->second.line,
                        printable(stated->second.text), rows.size());
  return points.finish(header.line);
}

}  // namespace gonio
