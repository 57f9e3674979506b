#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "assess/fit_stability.h"
#include "assess/map_outline.h"
#include "base/files.h"
#include "fit/gnuplot.h"
#include "fit/plots.h"

namespace gonio {
namespace {

namespace fs = std::filesystem;

constexpr std::array kModels{"torrance-sparrow", "ggx", "beckmann-kirchhoff"};
constexpr std::array kBasins{"beckmann-kirchhoff", "cook-torrance-1981-two-widths"};

/// A quantity of a cell as a panel shows it.
struct Panel {
  std::string title, palette;
  std::function<double(const RecoveryCell&)> shade;
  std::function<bool(const RecoveryCell&)> fails;
};

std::vector<Panel> panels() {
  return {
      {"log₁₀ of the worst error, decades (outlined: above 10 %)",
       "set palette defined (-4 '#f7fbff', -2.5 '#9ecae1', -1.39 '#4292c6', -1.37 '#fee391', -0.5 '#fe9929', 0.5 "
       "'#7f2704')\nset cbrange [-4:0.5]\n",
       [](const RecoveryCell& c) { return std::log10(std::max(c.decades, 1e-4)); },
       [](const RecoveryCell& c) { return !c.recovered(); }},
      {"parameters inside their 95 % interval (outlined: below 0.8)",
       "set palette defined (0 '#7f2704', 0.6 '#fe9929', 0.79 '#fee391', 0.795 '#9ecae1', 1 '#4292c6')\nset cbrange "
       "[0:1]\n",
       [](const RecoveryCell& c) { return c.share_inside; },
       [](const RecoveryCell& c) { return c.share_inside < kFailedShare; }},
      {"fits wrong without a warning (outlined: any)",
       "set palette defined (0 '#f7fbff', 0.01 '#fee391', 0.5 '#fe9929', 1 '#7f2704')\nset cbrange [0:1]\n",
       [](const RecoveryCell& c) { return c.share_silent; }, [](const RecoveryCell& c) { return c.share_silent > 0; }}};
}

std::string axes_of(const MapAxis& x, const MapAxis& y, std::size_t columns, std::size_t rows) {
  const double dx = 0.5 * (x.hi - x.lo) / double(columns - 1), dy = 0.5 * (y.hi - y.lo) / double(rows - 1);
  return fmt::format("set xlabel '{}'\nset ylabel '{}'\nset xrange [{}:{}]\nset yrange [{}:{}]\n", x.label, y.label,
                     x.lo - dx, x.hi + dx, y.lo - dy, y.hi + dy);
}

constexpr const char* kDraw =
    "plot $m{0} using 1:2:3 with image pixels, $o{0} using 1:2:3:4 with vectors nohead lw 1.5 lc rgb '#000000'\n";

/// Three sweeps of one model below each other, three quantities side by side.
std::string recovery_chart(const std::vector<RecoveryMap>& maps) {
  std::string script = fmt::format("set multiplot layout {},3 title '{}: what is recovered' font ',16'\nunset key\n",
                                   maps.size(), gnuplot_text(maps[0].model));
  int block = 0;
  for (const RecoveryMap& map : maps)
    for (const Panel& panel : panels()) {
      script += fmt::format("$m{} << EOD\n", block);
      for (const RecoveryCell& c : map.cells) script += fmt::format("{:.5g} {:.5g} {:.3f}\n", c.x, c.y, panel.shade(c));
      script += fmt::format(
          "EOD\n$o{} << EOD\n{}EOD\n", block,
          map_outline(map.columns, map.rows, map.x, map.y, [&](std::size_t c) { return panel.fails(map.cells[c]); }));
      script += axes_of(map.x, map.y, map.columns, map.rows) + panel.palette +
                fmt::format("set title '{}' font ',11'\n", panel.title) + fmt::format(fmt::runtime(kDraw), block);
      ++block;
    }
  return gnuplot_svg(script + "unset multiplot\n", 1320, 340 * static_cast<int>(maps.size()) + 40);
}

constexpr std::array kMinimumColours{"#1b9e77", "#7570b3", "#d95f02", "#e7298a", "#e6ab02", "#a6761d", "#888888"};

/// The grid of starts, a colour the minimum each ended at (the last: any further one), white: not converged.
std::string basin_chart(const BasinMap& map) {
  const auto most = static_cast<int>(kMinimumColours.size()) - 1;
  std::string palette, script;
  for (int c = 0; c <= most; ++c) palette += fmt::format("{}{} '{}'", c == 0 ? "" : ", ", c, kMinimumColours[c]);
  script = fmt::format(
      "set multiplot layout 1,2 title '{}: the minimum that each start reaches' font ',15'\nunset key\nset palette "
      "maxcolors {} defined ({})\nset cbrange [-0.5:{}.5]\nset cbtics ('best' 0",
      gnuplot_text(map.model), most + 1, palette, most);
  for (int c = 1; c < most; ++c) script += fmt::format(", '{}' {}", c + 1, c);
  script += fmt::format(", 'further' {})\n", most) + axes_of(map.x, map.y, map.columns, map.rows);
  for (int panel = 0; panel < 2; ++panel) {
    script += fmt::format("$m{} << EOD\n", panel);
    for (std::size_t c = 0; c < map.columns * map.rows; ++c) {
      const int minimum = (panel == 0 ? map.plain : map.improved)[c];
      script += fmt::format("{:.5g} {:.5g} {}\n", map.x.at(double(c % map.columns) / double(map.columns - 1)),
                            map.y.at(double(c / map.columns) / double(map.rows - 1)),
                            minimum < 0 ? "NaN" : std::to_string(std::min(minimum, most)));
    }
    script += fmt::format("EOD\n$w{} << EOD\n", panel);
    for (std::size_t m = 0; m < std::min<std::size_t>(map.minima.size(), kMinimumColours.size()); ++m)
      script += fmt::format("{:.5g} {:.5g}\n", map.minima[m].x, map.minima[m].y);
    script += fmt::format(
        "EOD\nset title '{}'\nplot $m{} using 1:2:3 with image pixels, $w{} using 1:2 with points pt 6 ps 1.4 lw 2 lc "
        "rgb "
        "'#000000'\n",
        panel == 0 ? "solver alone" : "after the search on a grid (as gonio fit does)", panel, panel);
  }
  return gnuplot_svg(script + "unset multiplot\n", 1150, 470);
}

double failing_share(const RecoveryMap& map, const std::function<bool(const RecoveryCell&)>& fails) {
  return double(std::count_if(map.cells.begin(), map.cells.end(), fails)) / double(map.cells.size());
}

std::string recovery_table(const std::vector<RecoveryMap>& maps) {
  std::string text =
      "| model | swept | an error above 10 % | fewer than 0.8 inside their interval | wrong without a warning in some "
      "repeat |\n|---|---|---|---|---|\n";
  for (const RecoveryMap& map : maps) {
    text += fmt::format("| [{0}](recovery-{0}.svg) | {1} |", map.model, name_of(map.sweep));
    for (const Panel& panel : panels()) text += fmt::format(" {:.2f} |", failing_share(map, panel.fails));
    text += "\n";
  }
  return text + "\n(shares of the map's cells; single cells with fewer than 0.8 inside are chance)\n\n";
}

std::string csv_of(const std::vector<RecoveryMap>& maps) {
  std::string csv = "model,swept,x,y,median_worst_error_decades,share_inside_interval,share_wrong_without_warning\n";
  for (const RecoveryMap& map : maps)
    for (const RecoveryCell& c : map.cells)
      csv += fmt::format("{},{},{:.4g},{:.4g},{:.3g},{:.3g},{:.3g}\n", map.model, name_of(map.sweep), c.x, c.y,
                         c.decades, c.share_inside, c.share_silent);
  return csv;
}

std::string basin_text(const BasinMap& map) {
  std::string text = fmt::format(
      "![basins of {0}](basins-{0}.svg)\n\n| minimum | rms of residuals | log10 {1} | log10 {2} | share of starts, "
      "solver "
      "alone | after the search |\n|---|---|---|---|---|---|\n",
      map.model, map.first, map.second);
  for (std::size_t m = 0; m < std::min<std::size_t>(map.minima.size(), kMinimumColours.size() - 1); ++m) {
    const BasinMap::Minimum& at = map.minima[m];
    text += fmt::format("| {} | {:.4g} | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n", m + 1, at.rms, at.x, at.y,
                        at.plain / double(map.plain.size()), at.improved / double(map.plain.size()));
  }
  return text + "\n";
}

std::string csv_of(const BasinMap& map) {
  std::string csv = "log10_x,log10_y,minimum_solver_alone,minimum_after_search\n";
  for (std::size_t c = 0; c < map.plain.size(); ++c)
    csv += fmt::format("{:.4g},{:.4g},{},{}\n", map.x.at(double(c % map.columns) / double(map.columns - 1)),
                       map.y.at(double(c / map.columns) / double(map.rows - 1)), map.plain[c] + 1, map.improved[c] + 1);
  return csv;
}

std::string verdict_of(const Misled& m) {
  if (!m.wrong()) return "the intervals hold the truth";
  return m.noticed() ? "noticed" : "**not noticed**";
}

std::string atlas_summary(const std::vector<Misled>& atlas) {
  std::string text = "| flaw | parameters outside their interval | gonio |\n|---|---|---|\n";
  for (const Misled& m : atlas) {
    std::string outside;
    for (const MisledParameter& p : m.parameters)
      if (p.outside())
        outside += fmt::format("{}{} ({:.3g} for {:.3g})", outside.empty() ? "" : ", ", p.name, p.value, p.truth);
    text +=
        fmt::format("| [{}](#{}) | {} | {} |\n", m.title, m.name, outside.empty() ? "none" : outside, verdict_of(m));
  }
  return text + "\n";
}

std::string atlas_entry(const Misled& m) {
  std::string text = fmt::format(
      "### <a id=\"{0}\"></a>{1}\n\n{2}\n\n![{1}](atlas-{0}.svg)\n\n| parameter | truth | fitted | 95 % interval | "
      "error "
      "| inside |\n|---|---|---|---|---|---|\n",
      m.name, m.title, m.flaw);
  for (const MisledParameter& p : m.parameters)
    text += fmt::format("| {} | {:.3g} | {:.3g} | {:.3g} to {:.3g} | {:+.1f} % | {} |\n", p.name, p.truth, p.value,
                        p.lo95, p.hi95, 100 * (p.value / p.truth - 1), p.outside() ? "**no**" : "yes");
  text += fmt::format("\nrms_log10 of the fit {:.2g}. ", m.result.all.rms_log10);
  if (m.warnings.empty())
    text += !m.wrong()      ? "gonio says nothing, and the intervals hold.\n\n"
            : m.explained() ? "gonio says nothing: **not noticed**. The model follows the scan to its noise: the "
                              "residuals show nothing.\n\n"
                            : "gonio says nothing: **not noticed**.\n\n";
  else
    text += "gonio says:\n\n";
  for (const std::string& warning : m.warnings) text += "> " + warning + "\n>\n";
  if (!m.warnings.empty()) text.erase(text.size() - 2), text += "\n";
  return text;
}

std::string readme(const std::vector<RecoveryMap>& maps, const std::vector<BasinMap>& basins,
                   const std::vector<Misled>& atlas, int repeats) {
  std::string text = fmt::format(
      R"(# Where a fit can be trusted

## What is recovered

Synthetic scans of known surfaces (gold at 550 nm, kd 0.05, ks 0.9, five incidences from 0 to 60°, in the plane), fitted as
`gonio fit` does (log metric, one incidence left out, 4 starts), {} noisy repeats a cell. 3 % noise of ln f, theta_o to 80° by
5°, where these are not swept; where the step is, no point lies on a mirror direction. ggx is seen across the plane of incidence
too: in it alone, alpha_y and ks cannot be told apart, and gonio says so. Below sigma = 0.02 um the truth lies outside the box
that the fit searches, and gonio says that sigma is at its bound.

Left: the largest error of a parameter (median); middle: how many intervals hold; right: fits with a parameter wrong by more
than 10 % and its interval, without any warning.

)",
      repeats);
  text += recovery_table(maps);
  for (const char* name : kModels) text += fmt::format("![recovery of {0}](recovery-{0}.svg)\n\n", name);
  text += R"(## Which starts end where

A grid of starts in two parameters, the others from the middle of their boxes and kd, ks eliminated; 2 % noise. Circles: the
minima. White: not converged. Minima of the same least residual are one lobe whose two widths have changed places. Left the
solver alone, right after the search on a grid that every start of `gonio fit` goes through.

)";
  for (const BasinMap& map : basins) text += basin_text(map);
  text += R"(## Scans that mislead

Each scan has 2 % noise and one flaw; the fit is what `gonio fit` makes of it. Warnings that a sound scan of the same surface
draws as well are left out. "Not noticed": a parameter lies outside its interval and gonio says nothing.

)" + atlas_summary(atlas);
  for (const Misled& m : atlas) text += atlas_entry(m);
  return text;
}

}  // namespace

void write_fit_stability(const fs::path& folder, const std::function<void(const std::string&)>& progress,
                         bool published) {
  constexpr int kRepeats = 5;
  make_folder(folder);
  std::vector<BasinMap> basins;
  for (const char* name : kBasins) {
    progress(fmt::format("{}: basins", name));
    basins.push_back(basin_map(name, 41, 41));
    write_file(folder / fmt::format("basins-{}.svg", name), basin_chart(basins.back()));
    if (!published) write_file(folder / fmt::format("basins-{}.csv", name), csv_of(basins.back()));
  }
  progress("scans that mislead");
  const std::vector<Misled> atlas = failure_atlas();
  for (const Misled& m : atlas) write_file(folder / fmt::format("atlas-{}.svg", m.name), in_plane_svg(m.result, true));
  std::vector<RecoveryMap> all;
  for (const char* name : kModels) {
    std::vector<RecoveryMap> maps;
    for (const RecoverySweep sweep : kRecoverySweeps) {
      progress(fmt::format("{}: roughness against {}", name, name_of(sweep)));
      maps.push_back(recovery_map(name, sweep, 15, 11, kRepeats));
    }
    write_file(folder / fmt::format("recovery-{}.svg", name), recovery_chart(maps));
    all.insert(all.end(), maps.begin(), maps.end());
  }
  if (!published) write_file(folder / "recovery.csv", csv_of(all));
  write_file(folder / "README.md", readme(all, basins, atlas, kRepeats));
}

}  // namespace gonio
