#include "fit/plots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/files.h"
#include "fit/gnuplot.h"
#include "fit/residual_map.h"

namespace gonio {
namespace {

constexpr double kInPlane = 1.0;    // degrees of azimuth off the plane that still count as in it
constexpr int kPointsOfACurve = 8;  // fewer are no curve
constexpr double kFirstShareOfTop = 1e-6;

/// Colours that people with a colour-vision deficiency tell apart (Okabe & Ito 2008), the yellow left out.
constexpr std::array kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000", "#7F7F7F"};
constexpr std::array kMarks{7, 5, 9, 13, 11, 15, 7, 5};

const char* colour(std::size_t incidence) { return kColours[incidence % kColours.size()]; }
int mark(std::size_t incidence, bool held_out) { return kMarks[incidence % kMarks.size()] - (held_out ? 1 : 0); }

/// Signed zenith angle in the plane of incidence (positive on the mirror side); none off the plane.
std::optional<double> in_plane_angle(const FittedPoint& p) {
  const double delta = std::abs(std::remainder(p.phi_deg - 180, 360));
  if (p.theta_o_deg == 0 || delta <= kInPlane) return p.theta_o_deg;
  if (delta >= 180 - kInPlane) return -p.theta_o_deg;
  return std::nullopt;
}

struct Curve {
  std::vector<std::pair<double, double>> measured;  ///< angle, value; by angle
  std::vector<double> angles, fitted;
};

Curve curve_of(const FitResult& result, std::size_t incidence) {
  Curve curve;
  for (const FittedPoint& p : result.points)
    if (p.incidence == incidence && (p.used || p.held_out))
      if (const auto angle = in_plane_angle(p)) curve.measured.emplace_back(*angle, p.measured_per_sr);
  std::sort(curve.measured.begin(), curve.measured.end());
  if (curve.measured.empty()) return curve;
  const double first = curve.measured.front().first, last = curve.measured.back().first;
  const double mirror = result.by_incidence[incidence].theta_i_deg;
  for (double a = std::ceil(first * 2) / 2; a <= last; a += 0.5) curve.angles.push_back(a);
  for (int k = -150; k <= 150; ++k)  // a lobe may be narrower than the step above
    if (const double a = mirror + k * 0.02; a >= first && a <= last) curve.angles.push_back(a);
  std::sort(curve.angles.begin(), curve.angles.end());
  for (const double a : curve.angles)
    curve.fitted.push_back(predict(result, mirror, std::array{std::abs(a)}, a < 0 ? 0 : 180).front());
  return curve;
}

std::string angle_name(const FitResult& result, std::size_t incidence) {
  const double middle = result.by_incidence[incidence].theta_i_deg;
  return result.incidences_binned ? fmt::format("{:g}° to {:g}°", middle - 5, middle + 5)
                                  : fmt::format("{:g}°", middle);
}

std::string heading(const FitResult& result) {
  const std::string sample = gnuplot_text(result.name.empty() ? result.measurement_id : result.name);
  return fmt::format("set title '{}: {}' noenhanced\n", sample, result.model.described());
}

std::string unit_of(const FitResult& result) {
  return result.quantity == "relative" ? "BRDF (relative unit)" : "BRDF (sr^{-1})";
}

constexpr const char* kFrame =
    "set border lw 1 lc rgb '#404040'\nset tics out nomirror\nset grid lw 0.6 lc rgb '#DDDDDD'\n"
    "set key outside right top Left reverse samplen 1.4 spacing 1.15\n";

/// A logarithmic axis; below two decades powers of ten would leave it without labels, so 1, 2, 3, 5 are labelled.
std::string logarithmic_range(double lo, double hi) {
  std::string script = fmt::format("set logscale y\nset yrange [{}:{}]\n", lo, hi);
  if (hi / lo > 100) return script + "set format y '10^{%T}'\n";
  std::string labels;
  for (double decade = std::pow(10, std::floor(std::log10(lo))); decade < hi; decade *= 10)
    for (const int digit : {1, 2, 3, 5})
      if (digit * decade >= lo && digit * decade <= hi)
        labels += fmt::format("{}'{:g}' {}", labels.empty() ? "" : ", ", digit * decade, digit * decade);
  return script + "set ytics (" + labels + ")\n";
}

}  // namespace

bool has_in_plane_curves(const FitResult& result) {
  if (result.incidences_binned) return false;
  const auto points = std::count_if(result.points.begin(), result.points.end(),
                                    [](const FittedPoint& p) { return in_plane_angle(p).has_value(); });
  return points >= kPointsOfACurve * static_cast<std::ptrdiff_t>(result.by_incidence.size());
}

std::string in_plane_svg(const FitResult& result, bool logarithmic) {
  std::string data, points, lines;
  double bottom = 1e300, top = 0;
  for (std::size_t i = 0; i < result.by_incidence.size(); ++i) {
    const Curve curve = curve_of(result, i);
    if (curve.measured.empty()) continue;
    const bool held = result.by_incidence[i].held_out;
    data += fmt::format("$m{} << EOD\n", i);
    for (const auto& [angle, value] : curve.measured) {
      data += fmt::format("{} {}\n", angle, value);
      top = std::max(top, value);
      if (value > 0) bottom = std::min(bottom, value);
    }
    data += fmt::format("EOD\n$f{} << EOD\n", i);
    for (std::size_t k = 0; k < curve.angles.size(); ++k) {
      data += fmt::format("{} {}\n", curve.angles[k], curve.fitted[k]);
      top = std::max(top, curve.fitted[k]);
    }
    data += "EOD\n";
    points += fmt::format("{}$m{} w p pt {} ps {} lc rgb '{}' t 'measured {}{}'", points.empty() ? "plot " : ", \\\n  ",
                          i, mark(i, held), curve.measured.size() > 100 ? 0.35 : 0.6, colour(i), angle_name(result, i),
                          held ? " (left out)" : "");
    lines += fmt::format(", \\\n  $f{} w l lw 1.8 {} lc rgb '{}' notitle", i, held ? "dt (8,4)" : "dt 1", colour(i));
  }
  const std::string range = logarithmic ? logarithmic_range(std::max(bottom / 2, top * kFirstShareOfTop / 10), top * 2)
                                        : fmt::format("set yrange [0:{}]\n", top * 1.05);
  return gnuplot_svg(
      data + heading(result) + kFrame + range +
          fmt::format(
              "set xlabel 'angle of reflection (θ_o) in the plane of incidence, degrees (positive: mirror side)'\n"
              "set ylabel '{}'\nset xrange [-90:90]\nset xtics 15\n",
              unit_of(result)) +
          points + lines + ", \\\n  NaN w l lw 1.8 lc rgb '#404040' t 'fitted'" +
          (result.held_out ? ", \\\n  NaN w l lw 1.8 dt (8,4) lc rgb '#404040' t 'predicted (left out)'\n" : "\n"),
      960, 560);
}

std::string scatter_svg(const FitResult& result) {
  std::string data, points;
  double lo = 1e300, hi = 0;
  for (std::size_t i = 0; i < result.by_incidence.size(); ++i) {
    std::string rows;
    for (const FittedPoint& p : result.points) {
      if (p.incidence != i || !(p.used || p.held_out) || !(p.measured_per_sr > 0)) continue;
      rows += fmt::format("{} {}\n", p.measured_per_sr, p.fitted_per_sr);
      lo = std::min(lo, p.measured_per_sr), hi = std::max({hi, p.measured_per_sr, p.fitted_per_sr});
    }
    if (rows.empty()) continue;
    const bool held = result.by_incidence[i].held_out;
    data += fmt::format("$p{} << EOD\n{}EOD\n", i, rows);
    points += fmt::format(", \\\n  $p{} w p pt {} ps 0.4 lc rgb '{}' t '{}{}'", i, mark(i, held), colour(i),
                          angle_name(result, i), held ? " (left out)" : "");
  }
  const bool wide = hi > 20 * lo;  // a narrow range is clearer on linear axes
  const std::string range =
      wide ? fmt::format("set logscale xy\nset format xy '10^{{%T}}'\nset xrange [{0}:{1}]\nset yrange [{0}:{1}]\n",
                         lo / 2, hi * 2)
           : fmt::format("set xrange [{0}:{1}]\nset yrange [{0}:{1}]\n", lo * 0.9, hi * 1.05);
  return gnuplot_svg(
      data + heading(result) + kFrame + range +
          fmt::format(
              "set key title 'incidence'\nset size ratio 1\nset xlabel 'measured {0}'\nset ylabel 'fitted {0}'\n",
              unit_of(result)) +
          "plot x w l lw 1.2 lc rgb '#404040' t 'agreement'" + points + "\n",
      760, 620);
}

std::vector<Plot> write_plots(const FitResult& result, const std::filesystem::path& folder) {
  std::vector<Plot> plots;
  if (has_in_plane_curves(result)) {
    write_file(folder / "in-plane-log.svg", in_plane_svg(result, true));
    plots.push_back({"in-plane-log.svg", "measured and fitted BRDF in the plane of incidence, logarithmic"});
    write_file(folder / "in-plane-linear.svg", in_plane_svg(result, false));
    plots.push_back({"in-plane-linear.svg", "measured and fitted BRDF in the plane of incidence, linear"});
  }
  write_file(folder / "fitted-against-measured.svg", scatter_svg(result));
  plots.push_back({"fitted-against-measured.svg", "fitted against measured BRDF of every point"});
  if (const auto map = residual_map_svg(result)) {
    write_file(folder / "residuals.svg", *map);
    plots.push_back({"residuals.svg", "where the fit misses the scan: log10(fitted/measured) by direction"});
  }
  return plots;
}

}  // namespace gonio
