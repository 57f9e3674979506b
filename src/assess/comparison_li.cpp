#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assess/published_comparisons.h"
#include "materials/database.h"

namespace gonio {
namespace {

constexpr double kUm = 0.55, kTheta = 30, kFine = 5, kWaves = 200;

struct Specimen {
  std::string file;
  double raw_um, fine_um;
  double waves_um() const { return std::sqrt(square(raw_um) - square(fine_um)); }
};

/// Both scales; fine alone; the raw σ at the fine correlation length.
std::vector<Curve> specimen_curves(const Specimen& s, const Interface<double>& aluminium) {
  std::vector<Curve> curves{{"both scales", {}}};
  for (int n = 0; n <= 680; ++n) {
    const double theta_o = -80 + 0.25 * n;
    const double r = aluminium.reflectance(std::cos(0.5 * (kTheta + theta_o) * kPi<double> / 180));
    curves[0].points.emplace_back(
        theta_o, r * two_scale_power_per_sr(s.fine_um, kFine, s.waves_um(), kWaves, kTheta, theta_o, kUm));
  }
  const auto one = [&](const std::string& name, double sigma) {
    curves.push_back(power_curve(fmt::format("{} σ = {:g} µm", name, sigma), BeckmannKirchhoff<double>{sigma, kFine},
                                 aluminium, kTheta, -80, 90, 0.25, kUm));
  };
  one("high-frequency", s.fine_um), one("raw", s.raw_um);
  return curves;
}

/// Largest factor between two curves within their first one's upper tenth.
double largest_factor(const Curve& truth, const Curve& other) {
  double worst = 1, top = 0;
  for (const auto& [theta, power] : other.points) top = std::max(top, power);
  for (std::size_t n = 0; n < truth.points.size(); ++n) {
    if (std::abs(truth.points[n].first - kTheta) < 3)
      continue;  // the waviness's own narrow lobe about the mirror direction
    if (other.points[n].second < 0.1 * top) continue;
    const double ratio = truth.points[n].second / other.points[n].second;
    worst = std::max({worst, ratio, 1 / ratio});
  }
  return worst;
}

double coherent(double sigma_um) {
  return BeckmannKirchhoff<double>{sigma_um, kFine}.coherent_share(std::cos(75 * kPi<double> / 180), kUm);
}

}  // namespace

Comparison li_torrance_2005() {
  const Interface<double> aluminium = SurfaceMaterial("Al_Rakic").at(1000 * kUm);
  const Specimen smooth{"li-torrance-smooth.svg", 0.21, 0.13}, rough{"li-torrance-rough.svg", 2.66, 0.86};
  Comparison c{"li-torrance", "Li & Torrance 2005: which σ", "Li & Torrance, Proc. SPIE 5878 (2005)", "", {}, {}};
  c.text = fmt::format(
      "Aluminium-coated rough steel and glass at 550 nm (n = {:.3f}, k = {:.3f}, Rakić); raw σ 0.21 to 2.66 µm, of the "
      "high-frequency\n"
      "component alone 0.13 to 0.86 µm. The paper: fits of a Kirchhoff model find the latter. Measured curves and "
      "correlation lengths are in\n"
      "print only, so the statement is tried on surfaces with the two ends' σ: a fine component with T = {:g} µm, and "
      "waves of\n"
      "√(raw² - fine²) with T = {:g} µm (both lengths are this page's choice), scattering in the same theory by a "
      "double series.\n"
      "It holds while the waves are gentle: their slopes, not their heights, widen the lobe.",
      aluminium.n, aluminium.k, kFine, kWaves);
  for (const Specimen& s : {smooth, rough}) {
    const std::vector<Curve> curves = specimen_curves(s, aluminium);
    const std::string which = fmt::format("raw {:g} µm, fine {:g} µm", s.raw_um, s.fine_um);
    c.claims.push_back({which + ": the high-frequency σ alone explains the lobe",
                        "largest factor down to a tenth of the peak", largest_factor(curves[0], curves[1]), 1, 1.1});
    c.claims.push_back({"… the raw σ does not", "the same", largest_factor(curves[0], curves[2]), 1.5, 1e9});
    c.charts.push_back({s.file, fmt::format("Aluminium, {}, λ = 0.55 µm, incidence 30°", which),
                        "scattered power per sr / incident power", 1e-4, s.raw_um < 1 ? 100. : 3., -60, 90, kTheta,
                        curves});
  }
  c.claims.push_back({"… nor the specular peak of the smooth one at 75°",
                      "exp(-g) with the fine σ over that with the raw one",
                      coherent(smooth.fine_um) / coherent(smooth.raw_um), 1.5, 1e9});
  return c;
}

}  // namespace gonio
