#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assess/published_comparisons.h"
#include "materials/database.h"

namespace gonio {
namespace {

constexpr double kUm = 0.633, kSigma = 2.27, kMost = 1e9;

BeckmannKirchhoff<double> gold_surface(double correlation_um, KirchhoffForm form = KirchhoffForm::series) {
  return {kSigma, correlation_um, form};
}

/// Plane of incidence from -80° to 20° short of where cos_i + cos_o vanishes, or 110°.
Curve whole_plane(std::string name, const Lobe<double>& lobe, const Interface<double>& gold, double theta_i) {
  return power_curve(std::move(name), lobe, gold, theta_i, -80, std::min(110.0, 170 - theta_i), 0.25, kUm);
}

Chart incidence_chart(const Interface<double>& gold, double theta_i, double top, double from, double to) {
  Chart chart{fmt::format("mendez-odonnell-{:g}.svg", theta_i),
              fmt::format("Gold, σ = 2.27 µm, λ = 0.633 µm, incidence {:g}°", theta_i),
              "scattered power per sr / incident power",
              1e-3,
              top,
              from,
              to,
              theta_i,
              {}};
  chart.curves.push_back(whole_plane("thesis F, T = 21.9 µm", gold_surface(21.9), gold, theta_i));
  chart.curves.push_back(whole_plane("thesis F, T = 20.9 µm", gold_surface(20.9), gold, theta_i));
  chart.curves.push_back(power_curve("F of Nieto-Vesperinas, T = 21.9 µm",
                                     gold_surface(21.9, KirchhoffForm::nieto_vesperinas_1982), gold, theta_i, -80, 89.5,
                                     0.25, kUm));
  chart.curves.push_back(power_curve("faceted, Smith shadowing, α = 2σ/T", TorranceSparrow<double>{2 * kSigma / 21.9},
                                     gold, theta_i, -80, 89.75, 0.25, kUm));
  return chart;
}

/// Whether a curve rises to a maximum of its own within 5° of the way back to the light.
double backscatter_maxima(const std::vector<Curve>& curves, double theta_i) {
  int found = 0;
  for (const Curve& curve : curves) {
    const auto& p = curve.points;
    for (std::size_t n = 1; n + 1 < p.size(); ++n)
      found += std::abs(p[n].first + theta_i) <= 5 && p[n].second > p[n - 1].second && p[n].second >= p[n + 1].second;
  }
  return found;
}

std::vector<Curve> steep_curves(const Interface<double>& gold) {
  const double sigma = 1, correlation = 1.4, alpha = 2 * sigma / correlation;
  const auto one = [&](std::string name, const Lobe<double>& lobe) {
    return power_curve(std::move(name), lobe, gold, 10, -89.75, 89.75, 0.25, kUm);
  };
  return {one("Beckmann-Kirchhoff", BeckmannKirchhoff<double>{sigma, correlation}),
          one("Beckmann-Kirchhoff, F of Nieto-Vesperinas",
              BeckmannKirchhoff<double>{sigma, correlation, KirchhoffForm::nieto_vesperinas_1982}),
          one("He et al. 1991", HeTorrance<double>{sigma, correlation}),
          one("faceted, Smith shadowing", TorranceSparrow<double>{alpha}),
          one("pseudo-realistic (31)", PseudoRealistic<double>{alpha / std::sqrt(2.0)})};
}

/// What Smith's shadowing leaves, in the plane on the mirror side.
double seen(double theta_i, double theta_o) {
  return shadowing_masking(Shadowing::smith_correlated, directions_from_deg(theta_i, theta_o, 180.0), 2 * kSigma / 21.9)
      .value();
}

}  // namespace

Comparison mendez_odonnell_1987() {
  const Interface<double> gold = SurfaceMaterial("Au_Johnson").at(1000 * kUm);
  Comparison c{"mendez-odonnell",
               "Mendez & O'Donnell 1987: gold, gently and steeply rough",
               "O'Donnell & Mendez, J. Opt. Soc. Am. A 4, 1194 (1987); Maillot 1996, §I.2.5.2",
               "",
               {},
               {}};
  c.text = fmt::format(
      "σ = 2.27 µm, T = 20.9 to 21.9 µm, λ = 0.633 µm; gold at 633 nm n = {:.4f}, k = {:.4f} (Johnson & Christy), R = "
      "{:.4f} at the\n"
      "normal. The paper: Beckmann's theory fits below about 50° (shown: 20°) and fails at 70°, where it predicts "
      "light behind the\n"
      "surface. The measured curves are in print only; what can be computed is whether the theory gives itself away. "
      "Nieto-Vesperinas's\n"
      "F is taken as the thesis states it, cos_o for cos_i and nothing else; read as an amplitude of plane waves it is "
      "the thesis's\n"
      "to the letter. Read literally it moves the maximum at 20° and diverges at the horizon, so a fit at 20° speaks "
      "for the other reading.\n\n"
      "σ ≈ 1 µm, T ≈ 1.4 µm at 10°: the measured maximum is back towards the light and there is no specular peak. No "
      "model of single\n"
      "scattering has that maximum.",
      gold.n, gold.k, gold.r0());
  const auto plane = [&](double theta, double correlation) {
    return whole_plane("", gold_surface(correlation), gold, theta);
  };
  const auto literal =
      power_curve("", gold_surface(21.9, KirchhoffForm::nieto_vesperinas_1982), gold, 20, -80, 89.5, 0.25, kUm);
  const LobeShape at20 = shape_of(plane(20, 21.9)), shorter = shape_of(plane(20, 20.9)), nieto = shape_of(literal);
  c.claims = {
      {"the theory is valid at 20°", "lesser of T/λ and 4π r_c cos θ/λ", kirchhoff_validity(kSigma, 21.9, 20, kUm), 10,
       kMost},
      {"… and shadows nothing", "share seen in the mirror direction (Smith)", seen(20, 20), 0.99, 1},
      {"… and puts no light behind the surface", "share of ∫P dθ beyond 90°, 20°", share_behind(plane(20, 21.9)), 0,
       1e-3},
      {"… nor is the result a matter of T", "width at half maximum, T = 20.9 over T = 21.9 µm",
       shorter.width_deg / at20.width_deg, 0.9, 1.1},
      {"… and the maximum is next to the mirror direction", "maximum, thesis F, degrees", at20.peak_deg, 18, 22},
      {"F of Nieto-Vesperinas, read literally, is as near", "its maximum, degrees", nieto.peak_deg, 18, 22},
      {"no light behind the surface up to 50°", "share beyond 90°, 50°", share_behind(plane(50, 21.9)), 0, 0.01},
      {"light behind the surface at 70°", "share beyond 90°, 70°", share_behind(plane(70, 21.9)), 0.01, 1},
      {"… because masking is left out", "share seen at 85° (Smith), incidence 70°", seen(70, 85), 0, 0.9},
      {"… with F of Nieto-Vesperinas too, read literally", "P(89.5°) over P(70°), incidence 70°",
       power_per_sr(gold_surface(21.9, KirchhoffForm::nieto_vesperinas_1982), gold, 70, 89.5, kUm) /
           power_per_sr(gold_surface(21.9), gold, 70, 70, kUm),
       0.1, 1e6},
      {"σ 1, T 1.4 µm: no backscatter peak in any model", "maxima within 5° of -10°, five models",
       backscatter_maxima(steep_curves(gold), 10), 0, 0},
      {"σ 1, T 1.4 µm: no specular peak", "coherent share exp(-g), 10°",
       BeckmannKirchhoff<double>{1.0, 1.4}.coherent_share(std::cos(kPi<double> / 18), kUm), 0, 1e-6},
      {"σ 1, T 1.4 µm: outside the theory", "lesser of T/λ and 4π r_c cos θ/λ", kirchhoff_validity(1, 1.4, 10, kUm), 0,
       10},
  };
  c.charts = {incidence_chart(gold, 20, 6, -60, 110),
              incidence_chart(gold, 70, 30, 0, 100),
              {"mendez-odonnell-steep.svg", "Gold, σ = 1 µm, T = 1.4 µm, λ = 0.633 µm, incidence 10°",
               "scattered power per sr / incident power", 0, 0.45, -90, 90, 10, steep_curves(gold)}};
  return c;
}

}  // namespace gonio
