// The sweeps of the stability maps: issue by issue, what published code gets wrong.
#include <fmt/format.h>

#include <cmath>

#include "assess/brdf_published.h"
#include "assess/brdf_stability.h"

namespace gonio {
namespace {

using V = UnitVector<double>;

template <class S>
UnitVector<S> in(const V& v) {
  return {S(v.x), S(v.y), S(v.z)};
}

/// `degrees` above the horizon.
V above(double degrees, double phi_deg = 0) {
  const double sine = sin_deg(degrees), cosine = cos_deg(degrees), phi = phi_deg * gonio::kPi<double> / 180;
  return {cosine * std::cos(phi), cosine * std::sin(phi), sine};
}

/// Mirror image of v about the vector along (x, y, 1).
V mirrored(const V& v, double x, double y) {
  const double twice = 2 * (v.x * x + v.y * y + v.z) / (x * x + y * y + 1);
  return normalised(twice * x - v.x, twice * y - v.y, twice - v.z);
}

const MapAxis kElevation{"log_{10} degrees above the horizon", -4, std::log10(89.9)};
const Interface<double> kGold{0.96, 6.7};

/// The published form in both precisions, from one template.
template <class F>
void publish(StabilitySweep& sweep, F form) {
  sweep.published_single = [form](const BrdfPoint& p) { return double(form(float(0), p)); };
  sweep.published_double = [form](const BrdfPoint& p) { return form(double(0), p); };
}

ModelSpec torrance_sparrow(Shadowing shadowing) {
  ModelSpec spec{ModelId::torrance_sparrow};
  spec.shadowing = shadowing;
  return spec;
}

StabilitySweep roughness() {
  StabilitySweep sweep{"roughness",
                       "Torrance-Sparrow: roughness and grazing",
                       "half vector from acos, tan and cos of it, Smith's Λ as exp - erfc, printed Fresnel",
                       torrance_sparrow(Shadowing::smith_separable),
                       {"log_{10} alpha", -4, 1},
                       kElevation,
                       {},
                       {},
                       {}};
  sweep.point = [](double x, double y) {
    const double alpha = std::pow(10, x);
    const V o = above(std::pow(10, y));
    return BrdfPoint{{std::clamp(alpha / std::sqrt(2.0), 1e-4, 10.0), 0, 1},
                     mirrored(o, 0, std::min(0.7 * alpha, 0.7)),
                     o,
                     kGold,
                     0.55,
                     0};
  };
  publish(sweep, []<class S>(S, const BrdfPoint& p) {
    return published::torrance_sparrow(S(std::sqrt(S(2)) * S(p.values[0])), in<S>(p.i), in<S>(p.o), S(p.surface.n),
                                       S(p.surface.k));
  });
  return sweep;
}

/// R alone: the mirror direction of a facet whose D is known exactly.
StabilitySweep fresnel_sweep(std::string name, std::string title, MapAxis x,
                             std::function<Interface<double>(double)> surface) {
  StabilitySweep sweep{std::move(name),
                       std::move(title),
                       "formulas (5) as printed, R_p with sin·tan",
                       torrance_sparrow(Shadowing::none),
                       std::move(x),
                       kElevation,
                       {},
                       {},
                       {}};
  sweep.point = [surface](double x, double y) {
    const V o = above(std::pow(10, y));
    return BrdfPoint{{0.5, 0, 1}, {-o.x, -o.y, o.z}, o, surface(std::pow(10, x)), 0.55, 0};
  };
  publish(sweep, []<class S>(S, const BrdfPoint& p) {
    const S alpha2 = 2 * S(p.values[0]) * S(p.values[0]);
    return published::fresnel(S(p.o.z), S(p.surface.n), S(p.surface.k)) /
           (published::kPi<S> * alpha2 * 4 * S(p.i.z) * S(p.o.z));
  });
  return sweep;
}

StabilitySweep series(std::string name, int terms) {
  StabilitySweep sweep{std::move(name),
                       fmt::format("Beckmann-Kirchhoff: g against b = v_xy^2 T^2/4, published with {} terms", terms),
                       fmt::format("{} terms of g^m/m! from exp(-g), F' with 1 + cos·cos - sin·sin·cos", terms),
                       {ModelId::beckmann_kirchhoff},
                       {"log_{10} g", -8, 6},
                       {"log_{10} b", -3, 3},
                       {},
                       {},
                       {}};
  sweep.point = [](double x, double y) {
    const V o = above(60), i = above(55, 180);
    const double wave = 2 * gonio::kPi<double> / 10, flat = std::hypot(i.x + o.x, i.y + o.y);
    const double sigma = std::sqrt(std::pow(10, x)) / (wave * (i.z + o.z)),
                 correlation = 2 * std::sqrt(std::pow(10, y)) / (wave * flat);
    return BrdfPoint{{std::clamp(sigma, 1e-4, 1e3), correlation, 0, 1}, i, o, perfect_interface<double>(), 10, 0};
  };
  publish(sweep, [terms]<class S>(S, const BrdfPoint& p) {
    return published::kirchhoff(S(p.values[0]), S(p.values[1]), S(p.wavelength_um), in<S>(p.i), in<S>(p.o), terms);
  });
  return sweep;
}

StabilitySweep kirchhoff_grazing() {
  StabilitySweep sweep{"kirchhoff-grazing",
                       "Beckmann-Kirchhoff: height and grazing, T = 5 lambda",
                       "40 terms of g^m/m! from exp(-g), F' with 1 + cos·cos - sin·sin·cos",
                       {ModelId::beckmann_kirchhoff},
                       {"log_{10} sigma/lambda", -3, 2},
                       kElevation,
                       {},
                       {},
                       {}};
  sweep.point = [](double x, double y) {
    const V o = above(std::pow(10, y));
    return BrdfPoint{
        {0.55 * std::pow(10, x), 2.75, 0, 1}, mirrored(o, 0, 0.05), o, perfect_interface<double>(), 0.55, 0};
  };
  publish(sweep, []<class S>(S, const BrdfPoint& p) {
    return published::kirchhoff(S(p.values[0]), S(p.values[1]), S(p.wavelength_um), in<S>(p.i), in<S>(p.o), 40);
  });
  return sweep;
}

StabilitySweep he() {
  StabilitySweep sweep{
      "he",
      "He et al. 1991: height and grazing, T = 5 lambda, light from 20 degrees; top row: eye exactly at the normal",
      "cross products, Newton for the effective roughness, Λ as exp - erfc, 40 terms",
      {ModelId::he_1991},
      {"log_{10} sigma_0/lambda", -3, 2},
      kElevation,
      {},
      {},
      {}};
  sweep.point = [](double x, double y) {
    const V o = y > 1.95 ? V{0, 0, 1} : above(std::pow(10, y));
    return BrdfPoint{{0.55 * std::pow(10, x), 2.75, 0, 1}, above(70, 180), o, perfect_interface<double>(), 0.55, 0};
  };
  publish(sweep, []<class S>(S, const BrdfPoint& p) {
    return published::he(S(p.values[0]), S(p.values[1]), S(p.wavelength_um), in<S>(p.i), in<S>(p.o), 40);
  });
  return sweep;
}

StabilitySweep anisotropy() {
  ModelSpec spec{ModelId::beckmann};
  spec.shadowing = Shadowing::none;
  StabilitySweep sweep{"anisotropy",
                       "Anisotropic Beckmann: alpha_x/alpha_y and azimuth, alpha_y = 1e-4",
                       "half vector normalised, its azimuth from atan2, tan^2 from its cosine",
                       spec,
                       {"log_{10} alpha_x/alpha_y", 0, 4},
                       {"azimuth of h in units of the lobe, degrees", 0, 90, false},
                       {},
                       {},
                       {}};
  sweep.point = [](double x, double y) {
    const double alpha_y = 1e-4, alpha_x = 1e-4 * std::pow(10, x), phi = y * gonio::kPi<double> / 180, r = 1.7;
    const V o = above(60, 30);
    return BrdfPoint{{std::max(alpha_x, 1.01e-4), 1.01 * alpha_y, 0, 1},
                     mirrored(o, r * std::min(alpha_x, 0.2) * std::cos(phi), r * alpha_y * std::sin(phi)),
                     o,
                     perfect_interface<double>(),
                     0.55,
                     0};
  };
  publish(sweep, []<class S>(S, const BrdfPoint& p) {
    return published::anisotropic_beckmann(S(p.values[0]), S(p.values[1]), in<S>(p.i), in<S>(p.o));
  });
  return sweep;
}

}  // namespace

const std::vector<StabilitySweep>& stability_sweeps() {
  static const std::vector<StabilitySweep> all{
      roughness(),
      fresnel_sweep("index-match", "Fresnel: n next to 1, k = 0", {"log_{10} (n - 1)", -6, 1},
                    [](double m) {
                      return Interface<double>{1 + m, 0};
                    }),
      fresnel_sweep("absorption", "Fresnel: k from 1e-8 to 100, n = 1.5", {"log_{10} k", -8, 2},
                    [](double k) {
                      return Interface<double>{1.5, k};
                    }),
      series("series-10", 10),
      series("series-40", 40),
      kirchhoff_grazing(),
      he(),
      anisotropy()};
  return all;
}

}  // namespace gonio
