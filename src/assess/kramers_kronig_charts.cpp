#include "assess/kramers_kronig_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "assess/kramers_kronig_cut.h"
#include "base/files.h"
#include "fit/gnuplot.h"

namespace gonio {
namespace {

constexpr std::array kColours{"#0072B2", "#E69F00", "#D55E00", "#CC79A7", "#6A3D9A", "#009E73", "#56B4E9", "#7F7F7F"};

std::string csv_of(const std::vector<CutRow>& rows) {
  std::string csv =
      "metal,source,band_nm,assumed_decay,median_relative_error,worst_relative_error,worst_error_n,worst_error_k,"
      "worst_error_R_75deg,mean_interval_rad,share_held,share_open\n";
  for (const CutRow& r : rows)
    csv += fmt::format("{},{},{},{:g},{:.4e},{:.4e},{:.4e},{:.4e},{:.4e},{:.4f},{:.3f},{:.3f}\n", r.metal, r.source,
                       r.band.name, r.band.decay_exponent, r.median, r.worst, r.worst_n, r.worst_k, r.worst_r75,
                       r.interval_rad, r.share_held, r.share_open);
  return csv;
}

std::string csv_of(const std::vector<DecayRow>& rows) {
  std::string csv = "band_nm,decay_exponent,mean_relative_error\n";
  for (const DecayRow& r : rows) csv += fmt::format("{},{:g},{:.4e}\n", r.band, r.decay_exponent, r.mean_error);
  return csv;
}

/// Median (mark) to worst (line) for each metal, bands side by side.
std::string cut_chart(const std::vector<CutRow>& closed, const std::vector<CutRow>& tables) {
  std::vector<std::string> names;
  std::string tics, script =
                        "set logscale y\nset format y '10^{%T}'\nset yrange [1e-7:3]\nset grid y lc rgb '#c8c8c8'\n"
                        "set key outside top center horizontal\nset ylabel 'relative error of n + ik, 380 to 780 nm'\n"
                        "set label 'mark: median; top of the line: worst wavelength' at graph 0.5,0.06\n";
  std::vector<std::pair<std::string, std::string>> series;  // band, points
  double x = 0;
  const auto add = [&](const std::vector<CutRow>& rows, const std::string& suffix) {
    std::string metal;
    double offset = 0;
    for (const CutRow& row : rows) {
      if (row.metal != metal) {
        metal = row.metal, x += 1, offset = -0.36;
        tics += fmt::format("{}'{}' {}", tics.empty() ? "" : ", ", metal, x);
      }
      const std::string key = row.band.name + suffix;
      auto at = std::find_if(series.begin(), series.end(), [&](const auto& s) { return s.first == key; });
      if (at == series.end()) at = series.insert(series.end(), {key, ""});
      at->second += fmt::format("{:.2f} {:.4e} {:.4e}\n", x + offset, row.median, row.worst);
      offset += 0.18;
    }
  };
  add(closed, " nm"), x += 0.6, add(tables, " nm, tables");
  std::string plot;
  for (std::size_t s = 0; s < series.size(); ++s) {
    script += fmt::format("$d{} << EOD\n{}EOD\n", s, series[s].second);
    const std::string name = series[s].first == "whole nm"           ? "whole band"
                             : series[s].first == "table nm, tables" ? "whole table"
                                                                     : series[s].first;
    plot += fmt::format("{0}$d{1} using 1:2:2:3 with yerrorbars lc rgb '{2}' pt 7 ps 0.7 lw 2 title '{3}'",
                        s == 0 ? "" : ", ", s, kColours[s % kColours.size()], gnuplot_text(name));
  }
  return gnuplot_svg(script + fmt::format("set xtics ({})\nset xrange [0.3:{:.1f}]\nplot {}\n", tics, x + 0.7, plot),
                     1180, 480);
}

std::string decay_chart(const std::vector<DecayRow>& rows) {
  std::string script =
      "set grid lc rgb '#c8c8c8'\nset key top right\nset yrange [0:1]\nset xlabel 'assumed exponent: R falls as "
      "frequency to the minus this'\n"
      "set ylabel 'mean relative error, eleven metals'\n";
  std::string plot, band, data;
  std::size_t count = 0;
  for (const DecayRow& row : rows) {
    if (row.band != band) {
      if (count > 0) data += "EOD\n";
      data += fmt::format("$d{} << EOD\n", count);
      plot += fmt::format("{}$d{} with linespoints lc rgb '{}' pt 7 lw 2 title '{} nm'", count == 0 ? "" : ", ", count,
                          kColours[count + 1], row.band);
      band = row.band, ++count;
    }
    data += fmt::format("{:g} {:.4e}\n", row.decay_exponent, row.mean_error);
  }
  return gnuplot_svg(script + data + "EOD\nplot " + plot + "\n", 720, 420);
}

/// n and k of one metal: the truth, what each band gives, and the intervals stated for the visible, without and with a
/// known point.
std::string metal_chart(const std::string& metal) {
  std::string data, n_plot, k_plot;
  for (std::size_t b = 0; b < cut_bands().size(); ++b) {
    const CutBand& band = cut_bands()[b];
    data += fmt::format("$d{} << EOD\n", b);
    for (const CutPoint& p : cut_points(metal, band))
      data +=
          fmt::format("{:.3f} {:.5g} {:.5g} {:.5g} {:.5g} {:.5g} {:.5g} {:.5g} {:.5g}\n", p.wavelength_nm, p.truth.n,
                      p.truth.k, p.found.n, p.found.k, p.found.n_lo, p.found.n_hi, p.found.k_lo, p.found.k_hi);
    data += "EOD\n";
    const auto curve = [&](int column) {
      return fmt::format(", $d{} using 1:{} with lines lc rgb '{}' lw 2 title '{}'", b, column, kColours[b],
                         band.name == "whole" ? "whole band" : gnuplot_text(band.name) + " nm");
    };
    n_plot += curve(4), k_plot += curve(5);
  }
  const auto panel = [](const char* axis, int lo, int truth, const std::string& curves) {
    return fmt::format(
        "set ylabel '{0}'\nplot $d3 using 1:{1}:{2} with filledcurves fc rgb '#f3e4ec' title 'interval, 360-830 nm', "
        "$d4 using 1:{1}:{2} with filledcurves fc rgb '#d9c7ec' title 'interval, one point known', $d0 using 1:{3} "
        "with lines lc rgb '#b0b0b0' lw 7 title 'truth'{4}\n",
        axis, lo, lo + 1, truth, curves);
  };
  return gnuplot_svg(
      data +
          "set multiplot layout 1,2\nset grid lc rgb '#c8c8c8'\nset xrange [380:780]\nset yrange [0:8]\n"
          "set xlabel 'wavelength in nm'\nset lmargin at screen 0.05\nset rmargin at screen 0.37\nunset key\n" +
          panel("n", 6, 2, n_plot) +
          "set lmargin at screen 0.43\nset rmargin at screen 0.75\nset key at screen 0.77,0.95 left top Left "
          "reverse\n" +
          panel("k", 8, 3, k_plot) + "unset multiplot\n",
      1180, 420);
}

/// Over all metals, a band at a time: mean of the medians, the worst, the mean interval.
std::string summary_of(const std::vector<CutRow>& rows, const std::string& data) {
  std::vector<std::string> bands;
  for (const CutRow& row : rows)
    if (std::find(bands.begin(), bands.end(), row.band.name) == bands.end()) bands.push_back(row.band.name);
  std::string text;
  for (const std::string& band : bands) {
    double median = 0, worst = 0, worst_r = 0, interval = 0, count = 0;
    for (const CutRow& row : rows)
      if (row.band.name == band) {
        median += row.median, interval += row.interval_rad, count += 1;
        worst = std::max(worst, row.worst), worst_r = std::max(worst_r, row.worst_r75);
      }
    text += fmt::format("| {} | {} | {:.2g} | {:.2g} | {:.2g} | {:.2g} |\n", data, band, median / count, worst, worst_r,
                        interval / count);
  }
  return text;
}

std::string text_of(const std::vector<CutRow>& closed, const std::vector<CutRow>& tables) {
  std::string text =
      "# Kramers-Kronig on a cut band\n\n"
      "n and k are computed from the reflectance at normal incidence alone, for metals where they are known: the\n"
      "eleven of Rakić et al. (Appl. Opt. 37, 5271 (1998)) in closed form, and tables of the database. Errors are\n"
      "|ΔN|/|N| between 380 and 780 nm; R at 75° is what the wrong index costs at an angle, since R at the normal is\n"
      "met by construction. The interval is the one stated with every result (R anywhere from 0.01 to 1 outside the\n"
      "band). `& 589.3`: n and k are given at that one wavelength as well, which chooses the decay assumed beyond the\n"
      "band.\n\n"
      "With the whole band the transform is exact to the interpolation. Cut to what instruments measure it is off by\n"
      "tens of per cent, the interval says so, and no assumed decay mends it; one known point (589.3 nm here) makes "
      "it\n"
      "usable and the interval a third as wide.\n\n"
      "| data | band, nm | mean of medians | worst | worst R at 75° | mean interval, rad "
      "|\n|---|---|---|---|---|---|\n" +
      summary_of(closed, "Drude-Lorentz") + summary_of(tables, "tables");
  text +=
      "\n![errors](cut.svg)\n\n![gold](gold.svg)\n\n![silver](silver.svg)\n\n![which decay to assume](decay.svg)\n\n"
      "Every metal (cut.csv has more): `held` is the share of the wavelengths whose truth lies in the interval, "
      "`open`\n"
      "the share where the interval is all of [0, π] and the transform adds nothing to R.\n\n"
      "| metal | data | band, nm | median | worst | held | open |\n|---|---|---|---|---|---|---|\n";
  for (const auto* rows : {&closed, &tables})
    for (const CutRow& r : *rows)
      text += fmt::format("| {} | {} | {} | {:.2g} | {:.2g} | {:.0f} % | {:.0f} % |\n", r.metal, r.source, r.band.name,
                          r.median, r.worst, 100 * r.share_held, 100 * r.share_open);
  return text;
}

}  // namespace

void write_kramers_kronig_charts(const std::filesystem::path& folder) {
  make_folder(folder);
  const std::vector<CutRow> closed = drude_lorentz_cuts(), tables = tabulated_cuts();
  const std::vector<DecayRow> decay = decay_exponents();
  std::vector<CutRow> all = closed;
  all.insert(all.end(), tables.begin(), tables.end());
  write_file(folder / "cut.csv", csv_of(all));
  write_file(folder / "decay.csv", csv_of(decay));
  write_file(folder / "cut.svg", cut_chart(closed, tables));
  write_file(folder / "decay.svg", decay_chart(decay));
  write_file(folder / "gold.svg", metal_chart("Au"));
  write_file(folder / "silver.svg", metal_chart("Ag"));
  write_file(folder / "README.md", text_of(closed, tables));
}

}  // namespace gonio
