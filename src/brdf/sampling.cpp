#include "brdf/sampling.h"

#include <algorithm>
#include <cmath>

namespace gonio {

namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;  // clang 14 deduces no aggregates

/// Beckmann's width of a cosine power of the half vector's angle: cosⁿ = exp(-n·θ²/2 + …).
double width_of_power(double n) { return std::sqrt(2 / (n + 2)); }

}  // namespace

bool tails_fit_the_sampler(const Lobe<double>& lobe) {
  return std::holds_alternative<PseudoRealistic<double>>(lobe) || std::holds_alternative<TorranceSparrow<double>>(lobe);
}

double sampling_alpha(const Lobe<double>& lobe, double wavelength_um) {
  return std::visit(
      Overloaded{[](const Lambert&) { return 1.0; }, [](const Mirror&) { return 1.0; }, [](const OrenNayar<double>&) { return 1.0; },
                 [](const PseudoRealistic<double>& one) { return std::sqrt(2.0) * one.slope_rms; },
                 [](const TorranceSparrow<double>& one) { return one.alpha; },
                 [](const Stogryn<double>& one) { return one.alpha; },
                 [](const RoughDielectric<double>& one) { return one.alpha; },
                 [&](const BeckmannKirchhoff<double>& one) {
                   const double diffraction = wavelength_um / (kPi<double> * one.correlation_um);
                   return std::max(2 * one.sigma_um / one.correlation_um, diffraction);
                 },
                 [&](const HeTorrance<double>& one) {
                   return std::max(one.alpha(), wavelength_um / (kPi<double> * one.correlation_um));
                 },
                 [](const TrowbridgeReitz<double>& one) { return one.e; },
                 [](const Blinn<double>& one) {
                   if (one.density == BlinnDensity::cosine_power) return width_of_power(one.parameter);
                   return one.density == BlinnDensity::spheroid ? one.parameter : std::min(1.0, 1 / one.parameter);
                 },
                 [](const CookTorrance<double>& one) { return one.weight_2 > 0 ? std::max(one.alpha, one.alpha_2) : one.alpha; },
                 [](const PhongHighlight<double>& one) {
                   return (one.highlight == Highlight::half_vector ? 1 : 0.5) * width_of_power(one.n);
                 },
                 [](const Lafortune<double>& one) { return 0.5 * width_of_power(one.n); },
                 [](const BlinnPhongNormalised<double>& one) { return width_of_power(one.n); },
                 [](const AshikhminShirley<double>& one) { return width_of_power(std::sqrt(one.n_u * one.n_v)); },
                 [](const LowSmooth<double>& one) { return 1 / std::sqrt(1 + 4 * one.b); },
                 [](const LowMicrofacet<double>& one) { return 1 / std::sqrt(1 + 0.5 * one.b); },
                 [](const ShiftedGamma<double>& one) { return std::min(1.0, std::sqrt(one.alpha)); },
                 [](const auto& anisotropic) { return std::sqrt(anisotropic.alpha_x * anisotropic.alpha_y); }},
      lobe);
}

std::optional<DirectionSample> sample_visible_normal(double alpha, const LocalDirection& o, double u0, double u1,
                                                     double u2) {
  const double tan2 = -alpha * alpha * std::log(u1), cos_h = 1 / std::sqrt(1 + tan2), sin_h = std::sqrt(tan2) * cos_h;
  const double phi = 2 * kPi<double> * u2;
  double hx = sin_h * std::cos(phi), hy = sin_h * std::sin(phi);
  const double in_plane = o.x * hx + o.y * hy, seen = std::max(0.0, o.z * cos_h + in_plane),
               opposite = std::max(0.0, o.z * cos_h - in_plane);
  if (u0 * (seen + opposite) >= seen) hx = -hx, hy = -hy;
  const double cos_d = o.x * hx + o.y * hy + o.z * cos_h;
  if (cos_d <= 0) return {};
  const LocalDirection i{2 * cos_d * hx - o.x, 2 * cos_d * hy - o.y, 2 * cos_d * cos_h - o.z};
  if (i.z <= 0) return {};
  return DirectionSample{i, visible_normal_pdf(alpha, i, o)};
}

double visible_normal_pdf(double alpha, const LocalDirection& i, const LocalDirection& o) {
  if (i.z <= 0 || o.z <= 0) return 0;
  const Directions<double> w = reduce(i.x, i.y, i.z, o.x, o.y, o.z);
  return beckmann_d(w.tan2_h, alpha) * std::min(1.0, 2 * w.cos_h() * o.z / w.cos_d) / (4 * o.z);
}

DirectionSample sample_cosine(double u1, double u2) {
  const double r = std::sqrt(u1), phi = 2 * kPi<double> * u2, z = std::sqrt(std::max(0.0, 1 - u1));
  return {{r * std::cos(phi), r * std::sin(phi), z}, z / kPi<double>};
}

double cosine_pdf(const LocalDirection& i) { return std::max(0.0, i.z) / kPi<double>; }

}  // namespace gonio
