#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assess/brdf_stability.h"
#include "assess/map_outline.h"
#include "base/files.h"
#include "fit/gnuplot.h"

namespace gonio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kErrorPalette =
    "set palette defined (-17 '#f7fbff', -13 '#9ecae1', -9 '#4292c6', -6 '#fee391', -3 '#fe9929', 0 '#cc4c02', 1 "
    "'#4a0d00')\n"
    "set cbrange [-17:1]\nset cblabel 'log_{10} relative error (darkest: no number)'\n";

/// What a cell shows: log10 of the error, the top of the scale for what is no number.
double shade(double error) {
  if (std::isinf(error)) return 1;
  return std::clamp(std::log10(std::max(error, 1e-17)), -17.0, 0.9);
}

std::string map_chart(const StabilitySweep& sweep, const StabilityMap& map) {
  std::string script =
      fmt::format("set multiplot layout 2,2 title '{}'\nset xlabel '{}'\nset ylabel '{}'\nunset key\n{}",
                  gnuplot_text(sweep.title), sweep.x.label, sweep.y.label, kErrorPalette);
  const double dx = 0.5 * (sweep.x.hi - sweep.x.lo) / double(map.columns - 1),
               dy = 0.5 * (sweep.y.hi - sweep.y.lo) / double(map.rows - 1);
  script += fmt::format(
      "set xrange [{}:{}]\nset yrange [{}:{}]\nset object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#dddddd' "
      "behind\n",
      sweep.x.lo - dx, sweep.x.hi + dx, sweep.y.lo - dy, sweep.y.hi + dy);
  for (std::size_t panel = 0; panel < kMapPanels.size(); ++panel) {
    script += fmt::format("$m{} << EOD\n", panel);
    for (std::size_t c = 0; c < map.cells.size(); ++c) {
      const StabilityCell& cell = map.cells[c];
      const std::string value = cell.error[panel] < 0 ? "NaN" : fmt::format("{:.2f}", shade(cell.error[panel]));
      script += fmt::format("{:.5g} {:.5g} {}\n", cell.x, cell.y, value);
    }
    script += fmt::format("EOD\n$o{} << EOD\n{}EOD\nset title '{}'\n", panel,
                          map_outline(map.columns, map.rows, sweep.x, sweep.y,
                                      [&](std::size_t c) { return fails(sweep, map.cells[c], panel); }),
                          kMapPanels[panel]);
    script += fmt::format(
        "plot $m{0} using 1:2:3 with image, $o{0} using 1:2:3:4 with vectors nohead lw 1.5 lc rgb '#000000'\n", panel);
  }
  return gnuplot_svg(script + "unset multiplot\n", 1100, 860);
}

std::string energy_chart(const std::vector<EnergyMap>& maps) {
  std::string script =
      "set multiplot layout 2,3 title 'Directional reflectance E, F = 1: outlined where it exceeds 1 (top row: 89 "
      "degrees)'\nunset key\nset ylabel 'incidence, degrees'\n"
      "set palette defined (0 '#f7fbff', 1 '#4292c6', 1.002 '#fee391', 2 '#fe9929', 4 '#cc4c02')\nset cbrange "
      "[0:4]\nset yrange [-3.75:93.75]\n";
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const EnergyMap& map = maps[m];
    const double dx = 0.5 * (map.x.hi - map.x.lo) / double(map.columns - 1);
    script += fmt::format("$m{} << EOD\n", m);
    for (const auto& cell : map.cells)
      script += fmt::format("{:.4g} {:.4g} {:.4f}\n", cell[0], cell[1] == 89 ? 90.0 : cell[1], std::min(cell[2], 4.0));
    script += fmt::format("EOD\n$o{} << EOD\n{}EOD\n", m,
                          map_outline(map.columns, map.rows, map.x, {"", 0, 90, false},
                                      [&](std::size_t c) { return map.cells[c][2] > 1 + 1e-3; }));
    script += fmt::format(
        "set title '{}'\nset xlabel '{}'\nset xrange [{}:{}]\nplot $m{} using 1:2:3 with image, $o{} using 1:2:3:4 "
        "with vectors nohead lw 1.5 lc rgb '#000000'\n",
        gnuplot_text(map.name), map.x.label, map.x.lo - dx, map.x.hi + dx, m, m);
  }
  return gnuplot_svg(script + "unset multiplot\n", 1200, 760);
}

/// min(T/λ, 4π·r_c·cos θ/λ), r_c = T²/(2√3·σ): Kirchhoff's theory wants both large; below 10 it is outlined.
double kirchhoff_margin(double log_sigma, double log_correlation, double theta_deg) {
  const double sigma = std::pow(10, log_sigma), correlation = std::pow(10, log_correlation);
  const double curvature = correlation * correlation / (2 * std::sqrt(3.0) * sigma);
  return std::min(correlation, 4 * kPi<double> * curvature * cos_deg(theta_deg));
}

constexpr std::array kValidityAngles{0.0, 60.0, 85.0, 89.0};

std::string validity_chart() {
  const MapAxis x{"log_{10} sigma/lambda", -2, 2}, y{"log_{10} T/lambda", -1, 3};
  const std::size_t columns = 41, rows = 41;
  std::string script = fmt::format(
      "set multiplot layout 1,{} title 'Kirchhoff theory: the lesser of T/lambda and 4 pi r_c cos theta/lambda "
      "(outlined: below 10, not valid)'\nunset key\nset xlabel '{}'\nset ylabel '{}'\n"
      "set palette defined (-2 '#cc4c02', 0 '#fe9929', 0.99 '#fee391', 1.01 '#9ecae1', 3 '#4292c6')\nset cbrange "
      "[-2:3]\nset xtics 1\nset xrange [-2.05:2.05]\nset yrange [-1.05:3.05]\n",
      kValidityAngles.size(), x.label, y.label);
  for (std::size_t p = 0; p < kValidityAngles.size(); ++p) {
    script += fmt::format("$m{} << EOD\n", p);
    std::vector<double> margin;
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t c = 0; c < columns; ++c) {
        const double u = x.at(double(c) / double(columns - 1)), v = y.at(double(r) / double(rows - 1));
        margin.push_back(kirchhoff_margin(u, v, kValidityAngles[p]));
        script += fmt::format("{:.4g} {:.4g} {:.3f}\n", u, v, std::log10(margin.back()));
      }
    script += fmt::format(
        "EOD\n$o{} << EOD\n{}EOD\nset title '{} degrees'\nplot $m{} using 1:2:3 with image, $o{} using 1:2:3:4 with "
        "vectors nohead lw 1.5 lc rgb '#000000'\n",
        p, map_outline(columns, rows, x, y, [&](std::size_t c) { return margin[c] < 10; }), kValidityAngles[p], p, p);
  }
  return gnuplot_svg(script + "unset multiplot\n", 1300, 420);
}

std::string csv_of(const StabilityMap& map) {
  std::string csv = "x,y,published_float,ours_float,published_double,ours_double\n";
  for (const StabilityCell& cell : map.cells)
    csv += fmt::format("{:.6g},{:.6g},{:.2e},{:.2e},{:.2e},{:.2e}\n", cell.x, cell.y, cell.error[0], cell.error[1],
                       cell.error[2], cell.error[3]);
  return csv;
}

std::string csv_of(const std::vector<EnergyMap>& maps) {
  std::string csv = "lobe,log10_x,theta_deg,directional_reflectance\n";
  for (const EnergyMap& map : maps)
    for (const auto& cell : map.cells)
      csv += fmt::format("{},{:.4f},{:.1f},{:.3f}\n", map.name, cell[0], cell[1], cell[2]);
  return csv;
}

/// Share of the comparable cells in which a panel fails.
double failing_share(const StabilitySweep& sweep, const StabilityMap& map, std::size_t panel) {
  double failing = 0, seen = 0;
  for (const StabilityCell& cell : map.cells)
    if (cell.error[panel] >= 0) failing += fails(sweep, cell, panel), seen += 1;
  return seen > 0 ? failing / seen : 0;
}

std::string worst_text(const std::vector<CaseError>& errors) {
  std::string text =
      "# Worst points\n\nEvery model, shadowing and variant over its whole box (low-discrepancy parameters, corners; "
      "directions to 89.9999°), against 50\n"
      "digits at exactly the numbers received. Bars: double 1e-12 (diffraction series and He 1e-10), float 5e-6 (2e-5) "
      "above 1e-6 of the peak and 5e-5 down\n"
      "to 1e-30. `reciprocity` is the largest |f(i,o) - f(o,i)|/f of the models that claim it. The line evaluates the "
      "worst point again\n"
      "(`--precision reference` for the truth).\n\n| model | path | largest | 99.9 % | mean | faint | reciprocity | no "
      "number | negative |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const CaseError& e : errors)
    text += fmt::format("| {} | {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {} | {} |\n", e.name, e.path,
                        e.largest, e.percentile_999, e.mean, e.largest_faint, e.reciprocity, e.not_finite, e.negative);
  text += "\n## The points\n\n";
  for (const CaseError& e : errors)
    for (const PointError& worst : e.worst) {
      const bool single = e.path == "float lanes";
      text += fmt::format("{}, {}: {:.1e} ({} for {})\n\n    {}\n\n", e.name, e.path, worst.relative, worst.f,
                          worst.exact, eval_line(e.spec, worst.point, single ? "float" : "double"));
    }
  return text;
}

/// The worst cell of each panel of each map, published and ours side by side.
std::string worst_cells(const std::vector<StabilityMap>& maps) {
  std::string text = "## The worst cell of each map, the published form beside ours\n\n";
  for (std::size_t s = 0; s < maps.size(); ++s)
    for (std::size_t panel = 0; panel < 4; ++panel) {
      const StabilitySweep& sweep = stability_sweeps()[s];
      const bool single = panel < 2, ours = panel % 2 == 1;
      const auto worst =
          std::max_element(maps[s].cells.begin(), maps[s].cells.end(),
                           [&](const auto& a, const auto& b) { return a.error[panel] < b.error[panel]; });
      const BrdfPoint point = sweep_point(sweep, worst->x, worst->y, single ? Precision::single : Precision::twofold);
      const auto path = single ? NumberPath::float_lanes : NumberPath::double_scalar;
      const double f = ours ? own_evaluator(sweep.spec, path)({&point, 1}).front()
                            : (single ? sweep.published_single : sweep.published_double)(point);
      text += fmt::format("{}, {}: {:.1e} ({} for {})\n\n    {}\n\n", sweep.name, kMapPanels[panel],
                          worst->error[panel], f, reference_values(sweep.spec, {&point, 1}).front(),
                          eval_line(sweep.spec, point, ours ? (single ? "float" : "double") : "reference"));
    }
  return text;
}

std::string readme(const std::vector<StabilityMap>& maps, bool published) {
  std::string text =
      "# Where reflection models fail\n\n"
      "Relative error of the textbook form, as published code computes it (left), and of ours (right), in float (top) "
      "and double (bottom), against the same\n"
      "formula in 50 digits given exactly the numbers received. Outlined: beyond the bar (double 1e-12, the series and "
      "He 1e-10; float 5e-5). Darkest: no\n"
      "number or negative. Grey: f below 1e-290 (float: 1e-30), nothing to compare.\n\n| map | published form | "
      "published fails, float | ours | published fails, double | ours |\n|---|---|---|---|---|---|\n";
  const auto& sweeps = stability_sweeps();
  for (std::size_t s = 0; s < maps.size(); ++s) {
    text += fmt::format("| [{}]({}.svg) | {} |", sweeps[s].title, sweeps[s].name, sweeps[s].published);
    for (std::size_t panel = 0; panel < 4; ++panel)
      text += fmt::format(" {:.2f} |", failing_share(sweeps[s], maps[s], panel));
    text += "\n";
  }
  text += "\n(shares of the map's cells)\n\n";
  for (const StabilitySweep& sweep : sweeps) text += fmt::format("![{}]({}.svg)\n\n", sweep.title, sweep.name);
  text +=
      "## Energy above 1\n\nDirectional reflectance of lobes with F = 1 (energy.csv). Torrance-Sparrow with Smith's "
      "shadowing stays below 1 everywhere; without shadowing, or as\n"
      "published (Cook-Torrance: four times too much; the pseudo-realistic P is no density over solid angle; Ward-Dür; "
      "Kirchhoff's diffraction next to grazing),\n"
      "lobes give back more light than they receive: the conservation tables' reason.\n\n![energy](energy.svg)\n\n"
      "## Validity of Kirchhoff's theory itself\n\nThe formula may be exact and the theory wrong: Beckmann-Kirchhoff "
      "wants T ≫ λ and 4π·r_c·cos θ ≫ λ, r_c = T²/(2√3·σ) the rms radius of curvature.\n\n"
      "![validity](validity.svg)\n";
  if (!published)
    text +=
        "\nworst.md: the worst points of every model and variant, a `gonio eval` line each. One CSV a map beside its "
        "picture.\n";
  else
    text +=
        "\n`gonio assess stability brdf` also writes the worst points of every model, and the maps as tables: these "
        "maxima differ from machine to machine.\n";
  return text;
}

}  // namespace

void write_brdf_stability(const fs::path& folder, bool published) {
  make_folder(folder);
  std::vector<StabilityMap> maps;
  for (const StabilitySweep& sweep : stability_sweeps()) {
    maps.push_back(stability_map(sweep, 41, 33));
    write_file(folder / (sweep.name + ".svg"), map_chart(sweep, maps.back()));
    if (!published) write_file(folder / (sweep.name + ".csv"), csv_of(maps.back()));
  }
  const std::vector<EnergyMap> energy = energy_maps();
  write_file(folder / "energy.csv", csv_of(energy));
  write_file(folder / "energy.svg", energy_chart(energy));
  write_file(folder / "validity.svg", validity_chart());
  if (!published) {
    ErrorOptions options;
    options.points.sets = 12, options.measure.worst = 1;
    write_file(folder / "worst.md", worst_text(brdf_errors(options)) + worst_cells(maps));
  }
  write_file(folder / "README.md", readme(maps, published));
}

}  // namespace gonio
