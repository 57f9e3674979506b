#include "assess/published_comparisons_page.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "assess/published_comparisons.h"
#include "base/files.h"
#include "fit/gnuplot.h"

namespace gonio {
namespace {

constexpr std::array kColours{"#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7"};
constexpr std::array kDashes{1, 2, 4, 5, 3};

/// Legend below, the mirror direction dotted, what lies behind the surface shaded.
std::string svg_of(const Chart& chart) {
  std::string script = fmt::format(
      "set title '{}'\nset xlabel 'angle from the normal in degrees, positive on the mirror side'\nset ylabel '{}'\n"
      "set xrange [{:g}:{:g}]\nset yrange [{:g}:{:g}]\nset xtics 15\nset mxtics 3\nset grid lc rgb '#d8d8d8'\n"
      "set bmargin {:g}\nset rmargin 3\nset key at screen 0.5,0.02 bottom center maxcols 1 Left reverse samplen 3 font "
      "',12'\n",
      gnuplot_text(chart.title), gnuplot_text(chart.ordinate), chart.from_deg, chart.to_deg, chart.floor, chart.top,
      3.6 + static_cast<double>(chart.curves.size()));
  if (chart.floor > 0) script += "set logscale y\nset format y '10^{%T}'\n";
  script += fmt::format(
      "set arrow from {0:g}, graph 0 to {0:g}, graph 1 nohead lc rgb '#909090' dt 3 lw 1.5\n"
      "set label 'mirror' at {0:g}, graph 0.04 right offset -0.5,0 tc rgb '#606060' font ',12'\n",
      chart.mirror_deg);
  if (chart.to_deg > 90)
    script +=
        "set object rectangle from 90, graph 0 to graph 1, graph 1 fc rgb '#f3e4e4' fs solid noborder behind\n"
        "set label 'behind the surface' at 93.2, graph 0.04 rotate by 90 left tc rgb '#905050' font ',11'\n";
  std::string plot;
  for (std::size_t n = 0; n < chart.curves.size(); ++n) {
    script += fmt::format("$d{} << EOD\n", n);
    for (const auto& [x, y] : chart.curves[n].points)
      if (x >= chart.from_deg && x <= chart.to_deg && y > 0.01 * chart.floor)
        script += fmt::format("{:.2f} {:.4g}\n", x, y);
    script += "EOD\n";
    plot += fmt::format("{}$d{} with lines lc rgb '{}' dt {} lw 2 title '{}'", n == 0 ? "" : ", ", n, kColours[n],
                        kDashes[n], gnuplot_text(chart.curves[n].name));
  }
  return gnuplot_svg(script + "plot " + plot + "\n", 760, 540);
}

std::string limits_of(const Claim& claim) {
  if (claim.lo == claim.hi) return fmt::format("{:.4g}", claim.lo);
  if (claim.hi >= 1e6) return fmt::format("at least {:.4g}", claim.lo);
  if (claim.lo <= 0) return fmt::format("at most {:.4g}", claim.hi);
  return fmt::format("{:.4g} to {:.4g}", claim.lo, claim.hi);
}

std::string claims_csv(const std::vector<Comparison>& all) {
  std::string csv = "experiment,statement,quantity,value,lo,hi,verdict\n";
  for (const Comparison& c : all)
    for (const Claim& claim : c.claims)
      csv += fmt::format("{},\"{}\",\"{}\",{:.4g},{:.4g},{:.4g},{}\n", c.id, claim.statement, claim.quantity,
                         claim.value, claim.lo, claim.hi, claim.holds() ? "holds" : "does not hold");
  return csv;
}

/// Every second degree of every curve.
std::string curves_csv(const std::vector<Comparison>& all) {
  std::string csv = "plot,curve,theta_o_deg,value\n";
  for (const Comparison& c : all)
    for (const Chart& chart : c.charts)
      for (const Curve& curve : chart.curves)
        for (const auto& [x, y] : curve.points)
          if (std::abs(std::remainder(x, 2)) < 1e-9 && x >= chart.from_deg && x <= chart.to_deg)
            csv += fmt::format("{},\"{}\",{:g},{:.4e}\n", chart.file.substr(0, chart.file.find('.')), curve.name, x, y);
  return csv;
}

std::string section_of(const Comparison& c) {
  std::string text = fmt::format("\n## {}\n\n{}.\n\n{}\n", c.title, c.citation, c.text);
  if (!c.claims.empty()) {
    text += "\n| statement | quantity | value | holds for | verdict |\n|---|---|---|---|---|\n";
    for (const Claim& claim : c.claims)
      text += fmt::format("| {} | {} | {:.3g} | {} | {} |\n", claim.statement, claim.quantity, claim.value,
                          limits_of(claim), claim.holds() ? "holds" : "**does not hold**");
  }
  for (const Chart& chart : c.charts) text += fmt::format("\n![{}]({})\n", chart.title, chart.file);
  return text;
}

std::string text_of(const std::vector<Comparison>& all) {
  std::size_t held = 0, count = 0;
  for (const Comparison& c : all)
    for (const Claim& claim : c.claims) held += claim.holds(), ++count;
  std::string text = fmt::format(
      "# Published comparisons\n\n"
      "Experiments that the literature sets against reflection models, at the parameters that it states, computed with "
      "our models. The measured\n"
      "curves exist in print only and are not digitised here: no row below claims agreement with a measurement. A row "
      "is a statement\n"
      "of a paper (or of the thesis about it) in terms of the theory, as a number, with the range in which it holds. "
      "{} of {} hold.\n",
      held, count);
  for (const Comparison& c : all) text += section_of(c);
  return text;
}

}  // namespace

void write_published_comparisons(const std::filesystem::path& folder) {
  make_folder(folder);
  const std::vector<Comparison> all = published_comparisons();
  write_file(folder / "claims.csv", claims_csv(all));
  write_file(folder / "curves.csv", curves_csv(all));
  write_file(folder / "README.md", text_of(all));
  for (const Comparison& c : all)
    for (const Chart& chart : c.charts) write_file(folder / chart.file, svg_of(chart));
}

}  // namespace gonio
