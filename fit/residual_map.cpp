#include "fit/residual_map.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "brdf/directions.h"
#include "fit/diagnostics.h"
#include "fit/gnuplot.h"

namespace gonio {
namespace {

constexpr double kInPlane = 1.0;   // degrees of azimuth off the plane that still count as in it
constexpr double kCutShare = 0.8;  // of the points, from which on a scan is drawn as cuts in the plane of incidence
constexpr std::size_t kMostPanels = 12, kMostPoints = 4000;

/// Blue: too dark; red: too bright (Moreland 2009, "cool to warm", told apart without red or green).
constexpr const char* kPalette =
    "set palette defined (-1 '#3b4cc0', -0.5 '#8db0fe', 0 '#dddddd', 0.5 '#f49a7b', 1 '#b40426')\n";

struct Mark {
  double x, y, residual;
  bool outlier;
};

/// Degrees from the plane of incidence, 0 to 90.
double off_plane_deg(const FittedPoint& p) {
  const double turn = std::abs(std::remainder(p.phi_deg, 180));
  return p.theta_o_deg == 0 ? 0 : turn;
}

bool is_cuts(const FitResult& result) {
  const auto inside = std::count_if(result.points.begin(), result.points.end(),
                                    [](const FittedPoint& p) { return off_plane_deg(p) <= kInPlane; });
  return static_cast<double>(inside) >= kCutShare * static_cast<double>(result.points.size());
}

/// The incidences that have something to show, at most kMostPanels of them, spread over all.
std::vector<std::size_t> panels_of(const std::vector<std::vector<Mark>>& marks) {
  std::vector<std::size_t> filled;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (!marks[i].empty()) filled.push_back(i);
  if (filled.size() <= kMostPanels) return filled;
  std::vector<std::size_t> some;
  for (std::size_t k = 0; k < kMostPanels; ++k) some.push_back(filled[k * (filled.size() - 1) / (kMostPanels - 1)]);
  return some;
}

/// The mirror side (phi = 180) to the right, both ways of drawing.
std::vector<std::vector<Mark>> marks_of(const FitResult& result, bool cuts, const Outliers& outliers) {
  std::vector<std::vector<Mark>> marks(result.by_incidence.size());
  for (std::size_t k = 0; k < result.points.size(); ++k) {
    const FittedPoint& p = result.points[k];
    const auto residual = log10_residual(result, k);
    if (!residual || !(p.used || p.held_out) || (cuts && off_plane_deg(p) > kInPlane)) continue;
    if (!cuts && !result.wavelength_nm.empty() && p.wavelength_nm != result.wavelength_nm.front()) continue;
    const double phi = p.phi_deg * kPi<double> / 180, along = -p.theta_o_deg * std::cos(phi);
    const bool outlier = p.used && outliers.far(*residual);
    marks[p.incidence].push_back(
        {cuts && p.theta_o_deg == 0 ? 0 : along, cuts ? *residual : p.theta_o_deg * std::sin(phi), *residual, outlier});
  }
  for (auto& panel : marks) {  // a file that a browser still draws
    const std::size_t step = panel.size() / kMostPoints + 1;
    std::size_t at = 0;
    std::erase_if(panel, [&](const Mark& mark) { return at++ % step != 0 && !mark.outlier; });
  }
  return marks;
}

/// Ends of the scale: what holds 98 % of the points, so that outliers do not flatten the rest (they are drawn at the
/// edge).
double scale_of(const std::vector<std::vector<Mark>>& marks) {
  std::vector<double> sizes;
  for (const auto& panel : marks)
    for (const Mark& mark : panel) sizes.push_back(std::abs(mark.residual));
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  const double raw = std::max(1.2 * *at, 1e-3), decade = std::pow(10, std::floor(std::log10(raw)));
  for (const double digit : {1.0, 2.0, 4.0, 6.0})
    if (digit * decade >= raw) return digit * decade;
  return 10 * decade;
}

std::string block(const std::string& name, const std::vector<Mark>& marks, bool cuts, double scale, bool outliers) {
  std::string rows;
  for (const Mark& mark : marks) {
    if (outliers && !mark.outlier) continue;
    const double residual = std::clamp(mark.residual, -scale, scale);
    rows += fmt::format("{:.6g} {:.6g} {:.5g}\n", mark.x, cuts ? residual : mark.y, residual);
  }
  return rows.empty() ? "" : fmt::format("${} << EOD\n{}EOD\n", name, rows);
}

std::string panel_title(const FitResult& result, std::size_t incidence) {
  const double middle = result.by_incidence[incidence].theta_i_deg;
  return fmt::format(
      "set title 'θ_i  = {}{}' offset 0,-0.6\n",
      result.incidences_binned ? fmt::format("{:g}° to {:g}°", middle - 5, middle + 5) : fmt::format("{:g}°", middle),
      result.by_incidence[incidence].held_out ? " (left out)" : "");
}

std::string page_title(const FitResult& result, bool cuts) {
  const bool first = !cuts && result.wavelength_nm.size() > 1;
  return fmt::format("{}: {}{}, residuals", gnuplot_text(result.name.empty() ? result.measurement_id : result.name),
                     gnuplot_text(result.model.described()),
                     first ? fmt::format(" at {:g} nm", result.wavelength_nm.front()) : "");
}

/// Columns and rows of panels, and their place on the page.
struct Page {
  int columns, rows, width, height;

  Page(std::size_t panels, bool cuts) {
    const int count = static_cast<int>(panels), most = cuts ? 3 : 4;
    columns = count <= 4 && cuts ? std::min(count, 2) : std::min(count, most);
    rows = (count + columns - 1) / columns;
    width = (cuts ? 330 : 270) * columns + 166, height = (cuts ? 225 : 275) * rows + 110;
  }
  std::string layout() const {
    const double w = width, h = height;
    return fmt::format(
        "layout {},{} rowsfirst downwards margins screen {:.4f},{:.4f},{:.4f},{:.4f} spacing screen {:.4f},{:.4f}",
        rows, columns, 62 / w, 1 - 134 / w, 62 / h, 1 - 66 / h, 44 / w, 72 / h);
  }
};

std::string cut_panel(std::size_t i, bool outliers) {
  return fmt::format(
      "plot 0 w l lw 1 lc rgb '#404040' notitle, $m{0} using 1:2:3 w p pt 7 ps 0.3 lc palette notitle{1}\n", i,
      outliers ? fmt::format(", $o{} using 1:2 w p pt 6 ps 0.9 lw 1.2 lc rgb '#000000' notitle", i) : "");
}

/// Rings each 30°, the light (x) and the mirror direction (+), beside the points.
std::string map_panel(const FitResult& result, std::size_t i, std::size_t points, bool outliers) {
  const double theta_i = result.by_incidence[i].theta_i_deg;
  std::string text = fmt::format(
      "plot $rings w l lw 0.8 lc rgb '#AAAAAA' notitle, $m{} using 1:2:3 w p pt 7 ps {} lc palette notitle", i,
      points > 1000  ? 0.3
      : points > 200 ? 0.5
                     : 0.8);
  if (outliers) text += fmt::format(", $o{} using 1:2 w p pt 6 ps 0.9 lw 1.2 lc rgb '#000000' notitle", i);
  for (const auto& [at, sign] : {std::pair(-theta_i, 2), std::pair(theta_i, 1)})
    text += fmt::format(", '+' using ({}):(0) every ::0::0 w p pt {} ps 0.9 lw 1.5 lc rgb '#000000' notitle", at, sign);
  return text + "\n";
}

std::string rings() {
  std::string rows;
  for (const int radius : {30, 60, 90}) {
    for (int turn = 0; turn <= 360; turn += 4)
      rows += fmt::format("{:.4g} {:.4g}\n", radius * std::cos(turn * kPi<double> / 180),
                          radius * std::sin(turn * kPi<double> / 180));
    rows += "\n";
  }
  return "$rings << EOD\n" + rows + "EOD\n";
}

}  // namespace

std::optional<std::string> residual_map_svg(const FitResult& result) {
  const bool cuts = is_cuts(result);
  const std::vector<std::vector<Mark>> marks = marks_of(result, cuts, find_outliers(result));
  const std::vector<std::size_t> panels = panels_of(marks);
  if (panels.empty()) return std::nullopt;
  const double scale = scale_of(marks);
  const Page page(panels.size(), cuts);
  std::string data = rings(), plots;
  bool any = false;
  for (const std::size_t i : panels) {
    const std::string outliers = block(fmt::format("o{}", i), marks[i], cuts, scale, true);
    data += block(fmt::format("m{}", i), marks[i], cuts, scale, false) + outliers;
    plots += panel_title(result, i) +
             (cuts ? cut_panel(i, !outliers.empty()) : map_panel(result, i, marks[i].size(), !outliers.empty()));
    if (i == panels.front()) plots += "unset label 1\nunset colorbox\n";  // once a page
    any = any || !outliers.empty();
  }
  const std::string frame =
      cuts ? fmt::format(
                 "set grid lc rgb '#DDDDDD'\nset xrange [-90:90]\nset xtics 45\nset yrange [{0}:{1}]\nset ytics {2}\n",
                 -scale, scale, scale / 2)
           : "set size square\nset xrange [-92:92]\nset yrange [-92:92]\nunset border\nunset xtics\nunset ytics\n";
  const std::string axes = cuts
                               ? "θ_o  in the plane of incidence, degrees (positive: mirror side)"
                               : "zenith angle θ_o  from the centre (circles 30°, 60°, 90°), azimuth around it; ×: the "
                                 "light, +: its mirror direction";
  return gnuplot_svg(
      data + kPalette +
          fmt::format("set multiplot {} title '{}{}'\n", page.layout(), page_title(result, cuts),
                      any ? " (ringed: beyond 5 robust σ)" : "") +
          fmt::format("set label 1 '{}' at screen 0.5,{:.4f} center\nset cbrange [{}:{}]\nset cbtics {}\n"
                      "set cblabel 'log_{{10}}(fitted/measured)'\n"
                      "set colorbox user origin screen {:.4f},0.2 size screen {:.4f},0.55\nset border lc rgb "
                      "'#404040'\nset tics out nomirror\n",
                      axes, 14.0 / page.height, -scale, scale, scale / 2, 1 - 112.0 / page.width, 14.0 / page.width) +
          frame + plots + "unset multiplot\n",
      page.width, page.height);
}

}  // namespace gonio
