#include "assess/merl_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/gnuplot.h"

namespace gonio {
namespace {

constexpr int kSide = 5;

/// In the order of published_tables(): Ngan's in cold colours, Low's in warm ones, Bagher's black.
constexpr std::array kColours{"#0072B2", "#56B4E9", "#009E73", "#6A3D9A", "#7F7F7F", "#1B9E77", "#2040FF",
                              "#E69F00", "#D55E00", "#F0C000", "#FF7F7F", "#CC79A7", "#B3261E", "#000000"};

/// Finely about the mirror direction.
std::vector<double> angles() {
  std::vector<double> list;
  for (const double away : {44., 40., 35., 30., 25., 20., 15., 10., 7., 5., 4., 3., 2.5, 2., 1.5, 1., 0.75, 0.5, 0.25})
    list.push_back(kMerlThetaI - away), list.push_back(kMerlThetaI + away);
  for (const double theta : {kMerlThetaI, 0., -10., -20., -30., -45.}) list.push_back(theta);
  std::sort(list.begin(), list.end());
  return list;
}

std::string legend() {
  std::string script;
  for (std::size_t t = 0; t < published_tables().size(); ++t)
    script += fmt::format("set label {} '— {}' at screen {:.3f},{:.3f} tc rgb '{}' font 'sans-serif,10'\n", 100 + t,
                          gnuplot_text(std::string(published_tables()[t].name)),
                          0.03 + 0.195 * static_cast<double>(t % kSide), 0.985 - 0.016 * static_cast<double>(t / kSide),
                          kColours[t]);
  return script;
}

}  // namespace

std::string merl_sheet(const std::vector<std::string>& materials,
                       const std::vector<std::vector<PublishedFit>>& tables) {
  std::string script =
      "set multiplot layout 5,5 margins 0.06,0.99,0.045,0.94 spacing 0.008,0.012\nset logscale y\nset yrange "
      "[1e-3:1e4]\n"
      "set xrange [-45:89]\nset xtics -30,30,60\nset ytics 10\nset grid lc rgb '#e0e0e0'\nunset key\n" +
      legend();
  script +=
      "set label 200 'angle of the eye from the normal in degrees, positive on the mirror side' at screen 0.5,0.012 "
      "center font "
      "'sans-serif,12'\nset label 201 'f, 1/sr (green)' at screen 0.008,0.5 center rotate by 90 font 'sans-serif,12'\n";
  const std::vector<double> grid = angles();
  for (std::size_t m = 0; m < materials.size(); ++m) {
    std::string plot;
    for (std::size_t t = 0; t < tables.size(); ++t) {
      const auto fit = std::find_if(tables[t].begin(), tables[t].end(), [&](const PublishedFit& f) {
        return f.material == materials[m] && f.channel == "g";
      });
      if (fit == tables[t].end()) continue;
      script += fmt::format("$d{}_{} << EOD\n", m, t);
      for (const double theta : grid)
        script += fmt::format("{:g} {:.4g}\n", theta, std::max(merl_value(*fit, theta), 1e-9));
      script += "EOD\n";
      plot += fmt::format("{}$d{}_{} with lines lc rgb '{}' lw 1", plot.empty() ? "" : ", ", m, t, kColours[t]);
    }
    const bool left = m % kSide == 0, bottom = m / kSide == kSide - 1 || m + kSide >= materials.size();
    script += fmt::format(
        "set format y '{}'\nset format x '{}'\nset label 1 '{}' at graph 0.03,0.93 font 'sans-serif,12'\nplot {}\n",
        left ? "10^{%T}" : "", bottom ? "%g" : "", gnuplot_text(materials[m]), plot);
    if (m == 0) script += "unset label\n";  // the legend is drawn once
  }
  return gnuplot_png(script + "unset multiplot\n", 1100, 1100);
}

}  // namespace gonio
