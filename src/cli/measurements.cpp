// gonio measurements info|convert|plot|compare: what a measured file holds and how it was read, in any known format.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "cli/commands.h"
#include "cli/picture.h"
#include "cli/scan_quality.h"
#include "fit/diagnostics_json.h"
#include "fit/formats/compare.h"
#include "fit/formats/formats.h"
#include "fit/formats/writers.h"
#include "fit/gnuplot.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kInPlaneDeg = 1.0;  // degrees of azimuth off the plane that still count as in it
/// Colours that people with a colour-vision deficiency tell apart (Okabe & Ito 2008), the yellow left out.
constexpr std::array kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000", "#7F7F7F"};

std::string format_names() {
  std::string names = "csv";
  for (const Format& format : formats()) names += fmt::format(", {}", format.name);
  return names;
}

Measurement read(const std::string& path, const std::string& format) {
  return read_any(path, format.empty() ? std::nullopt : std::optional(format));
}

/// Of a foreign file as its reader said; ours has one form.
std::vector<std::string> conventions_of(const Measurement& scan) {
  if (!scan.conventions.empty()) return scan.conventions;
  return {fmt::format("quantity: {} (measurement.yaml; brdf where it says nothing)", scan.quantity), "angles: degrees",
          "azimuth: phi = phi_r - phi_i, 180 = mirror side",
          scan.quantity == "relative" ? "scale: relative" : "scale: absolute, sr^-1"};
}

struct Range {
  double lo = 1e300, hi = -1e300;
  void add(double x) { lo = std::min(lo, x), hi = std::max(hi, x); }
};

struct Ranges {
  Range theta_i, theta_o, phi, f;
  explicit Ranges(const Measurement& scan) {
    for (const ScanPoint& p : scan.points)
      theta_i.add(p.theta_i_deg), theta_o.add(p.theta_o_deg), phi.add(p.phi_deg()), f.add(p.f_per_sr);
  }
};

Json info_json(const Measurement& scan) {
  const Ranges ranges(scan);
  const auto range = [](const Range& r) { return Json::array({r.lo, r.hi}); };
  return {{"id", scan.id},
          {"name", scan.name},
          {"points", scan.points.size()},
          {"quantity", scan.quantity},
          {"incidences_deg", scan.incidences_deg},
          {"incidences_binned", scan.incidences_binned},
          {"wavelengths_nm", scan.wavelengths()},
          {"theta_i_deg", range(ranges.theta_i)},
          {"theta_o_deg", range(ranges.theta_o)},
          {"phi_deg", range(ranges.phi)},
          {scan.quantity == "relative" ? "f_relative" : "f_per_sr", range(ranges.f)},
          {"mueller", scan.mueller_names},
          {"conventions", conventions_of(scan)},
          {"left_out", scan.left_out},
          {"notes", scan.notes},
          {"quality", quality_json(scan_quality(scan), noise_estimate(scan))},
          {"source", scan.source},
          {"licence", scan.licence},
          {"instrument", scan.instrument},
          {"sample", scan.sample},
          {"uncertainty", scan.uncertainty}};
}

void print_list(const char* title, const std::vector<double>& values, const char* unit) {
  std::cout << fmt::format("  {:<12} ", title);
  if (values.empty())
    std::cout << "not stated\n";
  else if (values.size() > 12)
    std::cout << fmt::format("{:g} to {:g} {} ({} of them)\n", values.front(), values.back(), unit, values.size());
  else
    std::cout << fmt::format("{:g} {}\n", fmt::join(values, ", "), unit);
}

void print_info(const Measurement& scan) {
  const Ranges ranges(scan);
  std::cout << fmt::format("{}: {} points\n", scan.name.empty() ? scan.id : scan.name, scan.points.size());
  print_list(scan.incidences_binned ? "incidence of" : "incidence", scan.incidences_deg,
             scan.incidences_binned ? "degrees, middles of bins of 10" : "degrees");
  print_list("wavelength", scan.wavelengths(), "nm");
  const auto range = [](const char* title, const Range& r, const char* unit) {
    std::cout << fmt::format("  {:<12} {:g} to {:g} {}\n", title, r.lo, r.hi, unit);
  };
  range("theta_i", ranges.theta_i, "degrees"), range("theta_o", ranges.theta_o, "degrees");
  range("phi", ranges.phi, "degrees");
  range("f", ranges.f, scan.quantity == "relative" ? "(relative)" : "per sr");
  for (const std::string& convention : conventions_of(scan)) std::cout << "  read as      " << convention << '\n';
  for (const auto& [reason, count] : scan.left_out) std::cout << fmt::format("  left out     {}: {}\n", count, reason);
  for (const std::string& note : scan.notes) std::cout << "  note         " << note << '\n';
  print_quality(scan_quality(scan), noise_estimate(scan));
}

void add_info(CLI::App& measurements, Common& common) {
  auto* command = measurements.add_subcommand("info", "What a measurement holds, and how it was read");
  command->footer(
      "Example: gonio measurements info measurements/aluminium-merl\n         gonio measurements info paint.astm "
      "--json");
  add_common(*command, common);
  auto path = std::make_shared<std::string>(), format = std::make_shared<std::string>();
  command->add_option("measurement", *path, "Folder, CSV or foreign file")->required();
  command->add_option("--format", *format, "Its format instead of what it looks like: " + format_names());
  command->callback([&common, path, format] {
    const Measurement scan = read(*path, *format);
    if (common.json)
      std::cout << info_json(scan).dump(2) << '\n';
    else
      print_info(scan);
  });
}

struct ConvertArguments {
  std::string in, out, to, format;
};

void convert(const ConvertArguments& arguments, const Common& common) {
  const Measurement scan = read(arguments.in, arguments.format);
  const bool astm_named = std::filesystem::path(arguments.out).extension() == ".astm";
  const std::string to = arguments.to.empty() ? (astm_named ? "astm" : "csv") : arguments.to;
  std::vector<std::string> lost;
  if (to == "astm") {
    lost = not_in_astm(scan);
    write_file(arguments.out, astm_text(scan));
  } else if (to == "csv") {
    write_measurement(scan, arguments.out);
  } else {
    throw input_error("--to {}: cannot be written; expected csv or astm", to);
  }
  if (common.json) {
    std::cout << Json{{"out", arguments.out},         {"format", to},
                      {"points", scan.points.size()}, {"conventions", conventions_of(scan)},
                      {"left_out", scan.left_out},    {"not_written", lost}}
                     .dump(2)
              << '\n';
    return;
  }
  for (const std::string& what : lost) std::cerr << fmt::format("note: {} has no place in {}\n", what, to);
  std::cout << fmt::format("wrote {} ({}, {} points)\n", arguments.out, to, scan.points.size());
}

void add_convert(CLI::App& measurements, Common& common) {
  auto* command = measurements.add_subcommand("convert", "Write a measurement in another format");
  command->footer(
      "Example: gonio measurements convert paint.bsdf -o paint\n"
      "         gonio measurements convert measurements/aluminium-merl -o aluminium.astm");
  add_common(*command, common);
  auto a = std::make_shared<ConvertArguments>();
  command->add_option("measurement", a->in, "Folder, CSV or foreign file")->required();
  command->add_option("-o,--out", a->out, "Folder (csv) or file (astm) to write")->required();
  command->add_option("--to", a->to, "csv (a folder) or astm; default: what the name's ending says");
  command->add_option("--format", a->format, "The input's format instead of what it looks like: " + format_names());
  command->callback([&common, a] { convert(*a, common); });
}

using Curve = std::vector<std::pair<double, double>>;  // signed angle, value

/// Incidence -> in-plane curve, positive angles on the mirror side; the first wavelength alone.
std::map<std::size_t, Curve> in_plane_curves(const Measurement& scan) {
  const std::vector<double> wavelengths = scan.wavelengths();
  std::map<std::size_t, Curve> curves;
  for (const ScanPoint& p : scan.points) {
    if (!wavelengths.empty() && p.wavelength_nm != wavelengths.front()) continue;
    if (!(p.f_per_sr > 0)) continue;
    const double delta = std::abs(std::remainder(p.phi_deg() - 180, 360));
    if (p.theta_o_deg == 0 || p.theta_i_deg == 0 || delta <= kInPlaneDeg)
      curves[p.incidence].emplace_back(p.theta_i_deg == 0 && delta > 90 ? -p.theta_o_deg : p.theta_o_deg, p.f_per_sr);
    else if (delta >= 180 - kInPlaneDeg)
      curves[p.incidence].emplace_back(-p.theta_o_deg, p.f_per_sr);
  }
  for (auto& [incidence, curve] : curves) std::sort(curve.begin(), curve.end());
  return curves;
}

std::string plot_script(const Measurement& scan, const std::map<std::size_t, Curve>& curves) {
  std::string data, plot;
  for (const auto& [incidence, curve] : curves) {
    data += fmt::format("$c{} << EOD\n", incidence);
    for (const auto& [angle, value] : curve) data += fmt::format("{:.8g} {:.8g}\n", angle, value);
    data += "EOD\n";
    const double middle = scan.incidences_deg[incidence];
    plot += fmt::format(
        "{}$c{} using 1:2 with {} pt 7 ps 0.5 lc rgb '{}' title '{}'", plot.empty() ? "plot " : ", ", incidence,
        scan.incidences_binned ? "points" : "linespoints", kColours[incidence % kColours.size()],
        scan.incidences_binned ? fmt::format("{:g}° to {:g}°", middle - 5, middle + 5) : fmt::format("{:g}°", middle));
  }
  const std::vector<double> nm = scan.wavelengths();
  return data +
         fmt::format(
             "set title '{}{}'\nset key outside right top Left reverse title 'incidence'\nset grid lc rgb '#DDDDDD'\n"
             "set logscale y\nset format y '10^{{%T}}'\nset xrange [-90:90]\nset xtics 30\n"
             "set xlabel 'angle of reflection in the plane of incidence (degrees; positive: mirror side)'\n"
             "set ylabel '{}'\n",
             gnuplot_text(scan.name.empty() ? scan.id : scan.name),
             nm.empty() ? "" : fmt::format(", {:g} nm", nm.front()),
             scan.quantity == "relative" ? "BRDF (relative unit)" : "BRDF (sr^{-1})") +
         plot + "\n";
}

void add_plot(CLI::App& measurements, Common& common) {
  auto* command =
      measurements.add_subcommand("plot", "In-plane curves of each incidence (first wavelength), logarithmic");
  command->footer("Example: gonio measurements plot measurements/aluminium-merl -o aluminium.svg");
  add_common(*command, common);
  auto a = std::make_shared<ConvertArguments>();
  command->add_option("measurement", a->in, "Folder, CSV or foreign file")->required();
  command->add_option("-o,--out", a->out, "FILE.svg or FILE.png")->required();
  command->add_option("--format", a->format, "The input's format instead of what it looks like: " + format_names());
  command->callback([&common, a] {
    const Measurement scan = read(a->in, a->format);
    const std::map<std::size_t, Curve> curves = in_plane_curves(scan);
    if (curves.empty())
      throw input_error("{}: no positive value lies in the plane of incidence; expected some within {} degree", a->in,
                        kInPlaneDeg);
    write_picture(a->out, plot_script(scan, curves), 960, 560);
    std::cout << (common.json ? Json{{"out", a->out}, {"curves", curves.size()}}.dump(2) : "wrote " + a->out) << '\n';
  });
}

struct CompareArguments {
  std::string a, b, format_a, format_b;
  double tolerance_deg = 0.5;
};

Json point_json(const ScanPoint& p) {
  return {{"theta_i_deg", p.theta_i_deg}, {"theta_o_deg", p.theta_o_deg}, {"phi_deg", p.phi_deg()}, {"f", p.f_per_sr}};
}

void compare(const CompareArguments& arguments, Common& common) {
  const ScanComparison c = compare_scans(read(arguments.a, arguments.format_a), read(arguments.b, arguments.format_b),
                                         arguments.tolerance_deg);
  if (c.compared == 0) common.exit_code = 1;
  if (common.json) {
    Json json{{"points_a", c.points_a},
              {"points_b", c.points_b},
              {"tolerance_deg", arguments.tolerance_deg},
              {"matched", c.matched},
              {"compared", c.compared}};
    if (c.compared > 0) {
      json["ratio_mean"] = c.mean_ratio, json["rms_log10"] = c.rms_log10, json["largest_log10"] = c.largest_log10;
      json["largest_a"] = point_json(*c.largest_a), json["largest_b"] = point_json(*c.largest_b);
    }
    std::cout << json.dump(2) << '\n';
    return;
  }
  std::cout << fmt::format("{} of {} points of A have one of {} of B within {:g} degrees; {} pairs are positive\n",
                           c.matched, c.points_a, c.points_b, arguments.tolerance_deg, c.compared);
  if (c.compared == 0) return;
  const ScanPoint& p = *c.largest_a;
  std::cout << fmt::format(
      "  A / B: mean {:.5g}, rms of log10 {:.4g}\n"
      "  largest: log10 = {:.4g} at theta_i {:g}, theta_o {:g}, phi {:g} degrees ({:.4g} against {:.4g})\n",
      c.mean_ratio, c.rms_log10, c.largest_log10, p.theta_i_deg, p.theta_o_deg, p.phi_deg(), p.f_per_sr,
      c.largest_b->f_per_sr);
}

void add_compare(CLI::App& measurements, Common& common) {
  auto* command = measurements.add_subcommand("compare", "Two measurements at the directions that both have");
  command->footer(
      "Example: gonio measurements compare paint.astm paint.bsdf --tolerance-deg 1\n"
      "Exit 1: no pair of positive values matches.");
  add_common(*command, common);
  auto a = std::make_shared<CompareArguments>();
  command->add_option("a", a->a, "Folder, CSV or foreign file")->required();
  command->add_option("b", a->b, "Another one")->required();
  command->add_option("--tolerance-deg", a->tolerance_deg, "Angles that differ by less are the same")
      ->check(CLI::Range(0.0, 30.0))
      ->capture_default_str();
  command->add_option("--format-a", a->format_a, "Format of the first: " + format_names());
  command->add_option("--format-b", a->format_b, "Format of the second");
  command->callback([&common, a] { compare(*a, common); });
}

}  // namespace

void add_measurements(CLI::App& app, Common& common) {
  auto* command =
      app.add_subcommand("measurements", "Measured files of any known format: look into, convert, draw, compare");
  command->footer("Example: gonio measurements info measurements/aluminium-merl\nFormats: " + format_names());
  command->require_subcommand(1);
  add_info(*command, common);
  add_convert(*command, common);
  add_plot(*command, common);
  add_compare(*command, common);
}

}  // namespace gonio::cli
