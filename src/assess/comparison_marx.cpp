#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assess/published_comparisons.h"
#include "brdf/kirchhoff_profile.h"
#include "materials/database.h"

namespace gonio {
namespace {

constexpr double kUm = 0.6328, kTheta = 54;

struct Specimen {
  double sigma_um, correlation_um;
};
constexpr Specimen kRough{0.484, 3.14}, kSmooth{0.08, 1.52};

/// Power per radian relative to the mirror direction.
Curve profile_curve(std::string name, const Specimen& s, ProfileFactor factor, const Interface<double>& steel) {
  const KirchhoffProfile<double> profile{s.sigma_um, s.correlation_um, factor};
  Curve curve{std::move(name), {}};
  for (double theta_o = -80; theta_o <= 100; theta_o += 0.25) {
    const double r = steel.reflectance(std::abs(std::cos(0.5 * (kTheta + theta_o) * kPi<double> / 180)));
    curve.points.emplace_back(theta_o, r * profile.power_per_rad(kTheta, theta_o, kUm));
  }
  return relative_to(curve, value_at(curve, kTheta));
}

Chart specimen_chart(const std::string& file, const Specimen& s, const Interface<double>& steel) {
  Chart chart{
      file,
      fmt::format("Steel, σ = {:g} µm, T = {:g} µm, λ = 0.6328 µm, incidence 54°", s.sigma_um, s.correlation_um),
      "diffuse power / that in the mirror direction",
      1e-4,
      30,
      -45,
      100,
      kTheta,
      {}};
  chart.curves.push_back(profile_curve("1-D, Beckmann's F (- sin sin)", s, ProfileFactor::beckmann, steel));
  chart.curves.push_back(profile_curve("1-D, F as printed (+ sin sin)", s, ProfileFactor::marx_vorburger_1990, steel));
  const Curve flat =
      power_curve("2-D, Beckmann-Kirchhoff, thesis F", BeckmannKirchhoff<double>{s.sigma_um, s.correlation_um}, steel,
                  kTheta, -80, 100, 0.25, kUm);
  chart.curves.push_back(relative_to(flat, value_at(flat, kTheta)));
  const Curve he = power_curve("2-D, He et al. 1991 (shadowed)", HeTorrance<double>{s.sigma_um, s.correlation_um},
                               steel, kTheta, -80, 89.75, 0.25, kUm);
  chart.curves.push_back(relative_to(he, value_at(he, kTheta)));
  return chart;
}

/// The largest change, as a factor, of the relative curve within its half width when σ and T are scaled.
double sensitivity(const Specimen& s, double sigma_scale, double correlation_scale, const Interface<double>& steel) {
  const Curve before = profile_curve("", s, ProfileFactor::beckmann, steel);
  const Curve after = profile_curve("", {s.sigma_um * sigma_scale, s.correlation_um * correlation_scale},
                                    ProfileFactor::beckmann, steel);
  double worst = 1;
  const double half = 0.5 * shape_of(before).peak;
  for (std::size_t n = 0; n < before.points.size(); ++n)
    if (before.points[n].second >= half) {
      const double ratio = after.points[n].second / before.points[n].second;
      worst = std::max({worst, ratio, 1 / ratio});
    }
  return worst;
}

}  // namespace

Comparison marx_vorburger_1990() {
  const Interface<double> steel = SurfaceMaterial("stainless-steel_Karlsson_austenitic").at(1000 * kUm);
  Comparison c{"marx-vorburger",
               "Marx & Vorburger 1990: ground steel, a profile",
               "Marx & Vorburger, Appl. Opt. 29, 3613 (1990); Maillot 1996, §I.2.5.2",
               "",
               {},
               {}};
  c.text = fmt::format(
      "Stainless steel (n = {:.3f}, k = {:.3f} at 632.8 nm, Karlsson & Ribbing), λ = 0.6328 µm, incidence 54°; σ = "
      "0.484 µm, T = 3.14 µm and\n"
      "σ = 0.08 µm, T = 1.52 µm. The surfaces are ground along one direction, the theory is one-dimensional (power per "
      "radian, no BRDF),\n"
      "and its F is printed with + sin_i sin_o, which the thesis finds curious. The paper: good agreement (on a "
      "logarithmic scale) near the\n"
      "mirror direction, failure far from it, put down to multiple reflection, shadowing and Kirchhoff's "
      "approximation; moderate\n"
      "sensitivity to σ and T. The measured curves are in print only. The + is Beckmann's - where θ_o is counted the "
      "other way round;\n"
      "where it is not, the maximum moves to the horizon and beyond, which no measurement can follow: the + must be of "
      "the other count.",
      steel.n, steel.k);
  const double smooth_validity = kirchhoff_validity(kSmooth.sigma_um, kSmooth.correlation_um, kTheta, kUm),
               rough_validity = kirchhoff_validity(kRough.sigma_um, kRough.correlation_um, kTheta, kUm);
  const Curve beckmann = profile_curve("", kRough, ProfileFactor::beckmann, steel),
              printed = profile_curve("", kRough, ProfileFactor::marx_vorburger_1990, steel);
  const double width = shape_of(beckmann).width_deg;
  const auto off_mirror = [](const Curve& curve, double scale) {
    return std::abs(shape_of(curve).peak_deg - kTheta) / scale;
  };
  const KirchhoffProfile<double> a{1.0, 10.0, ProfileFactor::beckmann},
      b{1.0, 10.0, ProfileFactor::marx_vorburger_1990};
  const auto coherent = [](const Specimen& s) {
    return KirchhoffProfile<double>{s.sigma_um, s.correlation_um}.coherent_share(kTheta, kUm);
  };
  const double shadow80 = shadowing_masking(Shadowing::smith_correlated, directions_from_deg(kTheta, 80.0, 180.0),
                                            2 * kRough.sigma_um / kRough.correlation_um)
                              .value();
  c.claims = {
      {"Kirchhoff's approximation is strained, rough", "lesser of T/λ and 4π r_c cos θ/λ", rough_validity, 0, 10},
      {"… and smooth", "the same", smooth_validity, 0, 10},
      {"near the mirror direction F hardly matters", "+ over - sin sin, relative to 54°, at 59°",
       value_at(printed, 59) / value_at(beckmann, 59), 0.5, 2},
      {"… far from it it does", "+ over - sin sin at 14°, relative to 54°",
       value_at(printed, 14) / value_at(beckmann, 14), 0, 0.5},
      {"the maximum is near the mirror direction", "its distance over the width at half maximum, - sin sin",
       off_mirror(beckmann, width), 0, 0.5},
      {"… with + too, if θ_o is positive on the mirror side", "the same with + (same width)",
       off_mirror(printed, width), 0, 0.5},
      {"… and raises the power in the mirror direction by 1/cos⁴54° = 8.38", "+ over - sin sin at 54°",
       b.power_per_rad(kTheta, kTheta, kUm) / a.power_per_rad(kTheta, kTheta, kUm), 8.37, 8.39},
      {"shadowing is part of what fails at large angles", "share seen at 80° (Smith), rough", shadow80, 0, 0.9},
      {"moderate sensitivity: σ ten per cent larger, rough", "largest factor within the half width",
       sensitivity(kRough, 1.1, 1, steel), 1, 1.5},
      {"… T ten per cent larger, rough", "the same", sensitivity(kRough, 1, 1.1, steel), 1, 1.5},
      {"… σ ten per cent larger, smooth", "the same", sensitivity(kSmooth, 1.1, 1, steel), 1, 1.5},
      {"… only σ/T counts when rough: both ten per cent larger", "the same", sensitivity(kRough, 1.1, 1.1, steel), 1,
       1.05},
      {"the smooth surface keeps a specular peak", "coherent share exp(-g), σ = 0.08 µm", coherent(kSmooth), 0.1, 1},
      {"… the rough one none", "coherent share exp(-g), σ = 0.484 µm", coherent(kRough), 0, 1e-6},
  };
  c.charts = {specimen_chart("marx-vorburger-rough.svg", kRough, steel),
              specimen_chart("marx-vorburger-smooth.svg", kSmooth, steel)};
  return c;
}

}  // namespace gonio
