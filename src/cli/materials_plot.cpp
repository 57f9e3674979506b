#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "cli/commands.h"
#include "cli/picture.h"
#include "fit/gnuplot.h"
#include "materials/database.h"

namespace gonio::cli {
namespace {

/// Colours that people with a colour-vision deficiency tell apart (Okabe & Ito 2008), the yellow left out.
constexpr std::array kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000", "#7F7F7F"};
constexpr std::size_t kPointsShown = 90;  // more would hide the curve
constexpr int kPointsOfAFormula = 400;

struct PlotArguments {
  std::vector<std::string> ids;
  std::string out;
  double lo_nm = 0, hi_nm = 1e9;
};

struct Curve {
  std::string title;
  std::vector<double> nm, value;
  std::size_t colour;
  bool dashed = false, points = false;
};

struct Panel {
  std::string axis;
  std::vector<Curve> curves;
};

std::vector<double> wavelengths_of(const Entry& entry, const PlotArguments& arguments) {
  const double lo = std::max(entry.range_lo_nm, arguments.lo_nm), hi = std::min(entry.range_hi_nm, arguments.hi_nm);
  if (!(lo < hi))
    throw input_error("{}: known from {} to {} nm; expected some of {} to {} nm", entry.id, entry.range_lo_nm,
                      entry.range_hi_nm, arguments.lo_nm, arguments.hi_nm);
  std::vector<double> nm;
  if (!entry.formula.empty()) {
    for (int i = 0; i <= kPointsOfAFormula; ++i) nm.push_back(lo + (hi - lo) * i / kPointsOfAFormula);
    return nm;
  }
  for (const double w : entry.wavelength_nm)
    if (w > lo && w < hi) nm.push_back(w);
  nm.insert(nm.begin(), lo), nm.push_back(hi);
  return nm;
}

Curve curve_of(const Entry& entry, const PlotArguments& arguments, std::string title, std::size_t colour, bool dashed,
               const std::function<double(double)>& value) {
  Curve curve{std::move(title), wavelengths_of(entry, arguments), {}, colour, dashed, false};
  for (const double nm : curve.nm) try {
      curve.value.push_back(value(nm));
    } catch (const InputError&) {  // not known there: a gap
      curve.value.push_back(std::nan(""));
    }
  curve.points = entry.formula.empty() && curve.nm.size() <= kPointsShown;
  return curve;
}

/// The panels, in this order, that the kinds of the entries ask for.
std::vector<Panel> panels_of(const PlotArguments& arguments) {
  Panel index{"n (solid), k (dashed)", {}}, reflectance{"R at normal incidence", {}},
      transmittance{"transmittance", {}}, light{"power, relative to its maximum", {}}, eye{"sensitivity", {}};
  std::size_t eyes = 0;
  for (std::size_t i = 0; i < arguments.ids.size(); ++i) {
    const Entry& entry = Database::bundled().find(arguments.ids[i]);
    const auto add = [&](Panel& panel, std::string title, bool dashed, const std::function<double(double)>& value) {
      panel.curves.push_back(curve_of(entry, arguments, std::move(title), i, dashed, value));
    };
    const auto column = [&entry](std::size_t c) { return [&entry, c](double nm) { return entry.at(nm, c); }; };
    if (entry.kind == "optical-constants") {
      add(index, entry.id, false, column(0));
      if (entry.has_k()) add(index, "", true, column(1));
      add(reflectance, entry.id, false,
          [material = SurfaceMaterial(entry.id)](double nm) { return material.at(nm).r0(); });
    } else if (entry.kind == "illuminant") {
      const double top = *std::max_element(entry.columns[0].begin(), entry.columns[0].end());
      add(light, entry.id, false, [&entry, top](double nm) { return entry.at(nm) / top; });
    } else if (entry.kind == "reflectance" || entry.kind == "transmittance") {
      add(entry.kind == "reflectance" ? reflectance : transmittance, entry.id, false, column(0));
    } else {
      for (std::size_t c = 0; c < entry.columns.size(); ++c) {
        add(eye, entry.id + " " + entry.column_names[c], eyes % 2 == 1, column(c));
        eye.curves.back().colour = 3 * (eyes / 2) + c;  // a second observer in the same colours, dashed
      }
      ++eyes;
    }
  }
  std::vector<Panel> panels;
  for (Panel& panel : std::array{index, reflectance, transmittance, light, eye})
    if (!panel.curves.empty()) panels.push_back(std::move(panel));
  return panels;
}

std::string panel_script(const Panel& panel, std::size_t number, double lo_nm, double hi_nm, bool last) {
  std::string data, plot;
  for (std::size_t c = 0; c < panel.curves.size(); ++c) {
    const Curve& curve = panel.curves[c];
    data += fmt::format("$d{}_{} << EOD\n", number, c);
    for (std::size_t i = 0; i < curve.nm.size(); ++i)
      data += fmt::format("{:.8g} {:.8g}\n", curve.nm[i], curve.value[i]);
    data += "EOD\n";
    plot += fmt::format("{}$d{}_{} using 1:2 with {} lc rgb '{}' dt {} lw 2 pt 7 ps 0.35 title '{}'",
                        c == 0 ? "" : ", ", number, c, curve.points ? "linespoints" : "lines",
                        kColours[curve.colour % kColours.size()], curve.dashed ? 2 : 1, gnuplot_text(curve.title));
  }
  return data + fmt::format("set xrange [{:.8g}:{:.8g}]\nset ylabel '{}'\nset xlabel '{}'\nplot {}\n", lo_nm, hi_nm,
                            panel.axis, last ? "wavelength in nm" : "", plot);
}

std::size_t longest_title(const std::vector<Panel>& panels) {
  std::size_t longest = 0;
  for (const Panel& panel : panels)
    for (const Curve& curve : panel.curves) longest = std::max(longest, curve.title.size());
  return longest;
}

void plot(const PlotArguments& arguments, bool json) {
  if (!(arguments.lo_nm < arguments.hi_nm))
    throw input_error("--lo {}, --hi {}: no range; expected two wavelengths, the second greater", arguments.lo_nm,
                      arguments.hi_nm);
  const std::vector<Panel> panels = panels_of(arguments);
  double lo = 1e9, hi = 0;
  for (const Panel& panel : panels)
    for (const Curve& curve : panel.curves) lo = std::min(lo, curve.nm.front()), hi = std::max(hi, curve.nm.back());
  std::string script = fmt::format(
      "set multiplot layout {},1\nset key outside right top Left reverse\nset grid lc rgb '#c8c8c8'\nset lmargin 10\n"
      "set rmargin {}\nset yrange [*:*]\nset offsets 0,0,graph 0.05,0\n",
      panels.size(), longest_title(panels) + 8);
  for (std::size_t p = 0; p < panels.size(); ++p) script += panel_script(panels[p], p, lo, hi, p + 1 == panels.size());
  script += "unset multiplot\n";
  const std::string out =
      arguments.out.empty() ? Database::bundled().full_id(arguments.ids[0]) + ".svg" : arguments.out;
  write_picture(out, script, 900, 320 * static_cast<int>(panels.size()));
  std::cout << (json ? nlohmann::ordered_json{{"out", out}}.dump(2) : "wrote " + out) << '\n';
}

}  // namespace

void add_materials_plot(CLI::App& materials, Common& common) {
  auto* command = materials.add_subcommand(
      "plot", "Curves of entries over wavelength: n and k, R, lights, eyes; one panel a kind (SVG or PNG)");
  command->footer(
      "Example: gonio materials plot Au Ag Cu --out metals.svg\n         gonio materials plot D65 A FL11 1931-2 --lo "
      "380 "
      "--hi 780 --out lights.png");
  add_common(*command, common);
  auto arguments = std::make_shared<PlotArguments>();
  command->add_option("ids", arguments->ids, "Ids or aliases")->required();
  command->add_option("--lo", arguments->lo_nm, "From this wavelength, nm");
  command->add_option("--hi", arguments->hi_nm, "To this wavelength, nm");
  command->add_option("-o,--out", arguments->out, "FILE.svg or FILE.png (default: the first full id, .svg)");
  command->callback([&common, arguments] { plot(*arguments, common.json); });
}

}  // namespace gonio::cli
