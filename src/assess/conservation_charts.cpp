#include "assess/conservation_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fit/gnuplot.h"

namespace gonio {
namespace {

constexpr std::array kColours{"#000000", "#0072B2", "#56B4E9", "#E69F00", "#D55E00",
                              "#009E73", "#7F5539", "#6A3D9A", "#CC4C9B"};
constexpr int kWidth = 900, kHeight = 560;
constexpr double kTop = 0.92, kBottom = 0.15;  // of the plot in the picture
constexpr const char* kFrame =
    "set border 3 lc rgb '#404040'\nset tics nomirror out\nset grid lw 0.6 lc rgb '#E4E4E4'\nunset key\n";

struct Axis {
  double lo, hi;
  bool logarithmic;

  double place(double y) const {
    const double share = logarithmic ? std::log(y / lo) / std::log(hi / lo) : (y - lo) / (hi - lo);
    return kBottom + (kTop - kBottom) * share;
  }
};

struct Label {
  std::string text, colour;
  double place;  ///< of its middle, in the picture's height
};

/// Labels beside the right end, moved apart where curves end too close together for a line of text.
std::string beside(std::vector<Label> labels, double x) {
  constexpr double kLine = 18.0 / kHeight;
  std::ranges::sort(labels, {}, &Label::place);
  std::string script;
  double least = 0;
  for (const Label& label : labels) {
    const double place = std::max(label.place, least);
    script += fmt::format("set label '{}' at screen {:.3f},{:.4f} left tc rgb '{}'\n", gnuplot_text(label.text), x,
                          place, label.colour);
    least = place + kLine;
  }
  return script;
}

std::string slope_axis() {
  return fmt::format(
      "set logscale x\nset xrange [0.01:2]\nset xtics (0.01,0.02,0.05,0.1,0.2,0.5,1,2)\nset xlabel 'm, rms slope'\n"
      "set lmargin at screen 0.11\nset rmargin at screen 0.88\nset tmargin at screen {}\nset bmargin at screen {}\n",
      kTop, kBottom);
}

std::string block(const std::string& name, const MetalLimits& one) {
  std::string data = "$" + name + " << EOD\n";
  for (const SlopeLimits& at : one.over_slopes)
    data += fmt::format("{:.5g} {:.5g} {:.5g} {:.5g}\n", at.slope_rms, at.ks_max, at.kd_max_at_half, at.turning_kd);
  return data + "EOD\n";
}

Axis ks_axis(std::span<const MetalLimits> limits) {
  double lo = 1e9, hi = 0;
  for (const MetalLimits& one : limits)
    for (const SlopeLimits& at : one.over_slopes) lo = std::min(lo, at.ks_max), hi = std::max(hi, at.ks_max);
  if (hi / lo > 10) return {0.95 * lo, 1.1 * hi, true};
  return {lo - 0.04 * (hi - lo), hi + 0.04 * (hi - lo), false};
}

}  // namespace

std::string ks_chart(std::span<const MetalLimits> limits, std::span<const std::string_view> named) {
  const Axis axis = ks_axis(limits);
  std::string data, grey, coloured;
  std::vector<Label> labels;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const std::string name = fmt::format("d{}", i);
    const std::string& symbol = limits[i].metal->symbol;
    data += block(name, limits[i]);
    const auto found = std::ranges::find(named, std::string_view(symbol));
    const char* colour =
        found == named.end() ? "#C8C8C8" : kColours[std::size_t(found - named.begin()) % kColours.size()];
    (found == named.end() ? grey : coloured) +=
        fmt::format("${} using 1:2 with lines lw {} lc rgb '{}', ", name, found == named.end() ? 1 : 2, colour);
    if (found != named.end()) labels.push_back({symbol, colour, axis.place(limits[i].over_slopes.back().ks_max)});
  }
  const std::string title = gnuplot_text(std::string(conservation_models()[limits[0].model].name));
  return gnuplot_svg(data + kFrame + slope_axis() + beside(labels, 0.89) +
                         fmt::format("set title '{}: largest ks of F = 1 and {} metals'\nset ylabel 'ks_{{max}}, kd = "
                                     "0'\n{}set yrange [{:.4g}:{:.4g}]\n{}plot {}{}\n",
                                     title, limits.size() - 1, axis.logarithmic ? "set logscale y\n" : "", axis.lo,
                                     axis.hi, axis.logarithmic ? "set ytics (1,2,5,10,20,40)\n" : "", grey,
                                     coloured.substr(0, coloured.size() - 2)),
                     kWidth, kHeight);
}

std::string behaviour_chart(const MetalLimits& metal) {
  std::string script = block("d", metal) + kFrame + slope_axis();
  script +=
      fmt::format("set title '{} of {}, ks = 0.5'\n",
                  gnuplot_text(std::string(conservation_models()[metal.model].name)), gnuplot_text(metal.metal->id));
  script +=
      "set yrange [0:1.2]\nset ylabel 'kd'\n"
      "set label 'specular' at 0.6,0.2 center front\nset label 'diffuse' at 0.03,0.55 center front\n"
      "set label 'more light leaves than arrives' at 0.1,1.08 center front\n"
      "set label 'kd·min R_0 = ks·max E' at 0.1,0.27 left tc rgb '#0072B2' front\n"
      "set label 'kd_{max}' at 0.62,0.55 left tc rgb '#D55E00' front\n"
      "plot $d using 1:3:(1.2) with filledcurves lc rgb '#FBE3D6', "
      "$d using 1:($4 < $3 ? $4 : NaN):3 with filledcurves lc rgb '#DDEBF5', "
      "$d using 1:3 with lines lw 2 lc rgb '#D55E00', $d using 1:4 with lines lw 2 lc rgb '#0072B2'\n";
  return gnuplot_svg(script, kWidth, kHeight);
}

std::string room_chart(std::span<const RoomMean> means) {
  const Axis axis{1, 1e20, true};
  std::string data, plot;
  std::vector<Label> labels;
  std::size_t curve = 0;
  for (std::size_t i = 0; i < means.size(); ++i) {
    const bool first = i == 0 || means[i].factor != means[i - 1].factor;
    const bool last = i + 1 == means.size() || means[i + 1].factor != means[i].factor;
    if (first) data += fmt::format("$r{} << EOD\n", curve);
    data += fmt::format("{} {:.4g}\n", means[i].max_depth, means[i].mean);
    if (!last) continue;
    data += "EOD\n";
    const char* colour = kColours[curve + 1];
    plot +=
        fmt::format("{}$r{} with linespoints pt 7 ps 0.7 lw 2 lc rgb '{}'", plot.empty() ? "" : ", ", curve++, colour);
    labels.push_back({fmt::format("{:g}·ks_max", means[i].factor), colour, axis.place(means[i].mean)});
  }
  return gnuplot_svg(
      data + kFrame + beside(labels, 0.86) +
          fmt::format("set title 'A closed room of one material whose walls shine'\nset logscale xy\nset xrange "
                      "[2:128]\nset yrange [{:g}:{:g}]\nset xtics "
                      "(2,4,8,16,32,64,128)\nset format y '10^{{%T}}'\nset ytics 100\nset mytics 1\nset xlabel 'most "
                      "reflections of a "
                      "path'\nset ylabel 'mean radiance / emitted radiance'\nset lmargin at screen "
                      "0.11\nset rmargin at screen 0.85\nset tmargin at screen {}\nset bmargin at screen "
                      "{}\nplot {}\n",
                      axis.lo, axis.hi, kTop, kBottom, plot),
      kWidth, kHeight);
}

}  // namespace gonio
