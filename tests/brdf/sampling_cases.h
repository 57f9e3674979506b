#pragma once
// The cases of the sampling tests: every model of the list, every shadowing, over roughness and incidence. A new model is in them by being
// listed.
#include <fmt/format.h>

#include <string>

#include "brdf/lanes.h"
#include "brdf/sampling.h"

namespace gonio::test {

inline const Interface<double> kMetal{0.96, 6.7};
inline constexpr double kUm = 0.55;

struct SamplingCase {
  ModelSpec spec;
  std::vector<double> values;
  double theta_o_deg;
  std::string name;

  /// Off the grain, so that no symmetry hides anything.
  UnitVector<double> eye() const {
    const double phi = 0.4, s = sin_deg(theta_o_deg);
    return {s * std::cos(phi), s * std::sin(phi), cos_deg(theta_o_deg)};
  }
  Brdf<double> brdf() const { return make_brdf<double>(spec, values); }
};

/// A parameter between the ends of its fit box (share 0 to 1, logarithmic); the second of a pair (alpha_y, nv, c_y) a little off the first.
inline double between(const ParameterInfo& p, double share) { return p.fit_lo * std::pow(p.fit_hi / p.fit_lo, share); }

inline std::vector<double> values_at(const ModelInfo& info, double share, double kd) {
  std::vector<double> values;
  for (const ParameterInfo& p : info.parameters) {
    if (p.name == "kd")
      values.push_back(info.id == ModelId::lambert ? 0.8 : kd);
    else if (p.linear)
      values.push_back(p.name == "ks" ? 1.0 : 0.1);
    else if (p.name == "alpha_y" || p.name == "nv")
      values.push_back(between(p, 0.15 + 0.7 * share));
    else if (info.id == ModelId::lafortune_1997 &&
             p.name != "n")  // leaning the less the narrower, or nothing is left of the lobe
      values.push_back(std::exp((p.name == "c_x"   ? -0.3
                                 : p.name == "c_y" ? -0.5
                                                   : 0) /
                                std::sqrt(between(info.parameters[3], share))));
    else if (info.id == ModelId::sgd_2012 && p.name == "alpha")
      values.push_back(between(p, 0.5 + 0.5 * share));  // its core is alpha wide, its lobe √alpha
    else if (info.id == ModelId::sgd_2012 && p.name == "lambda")
      values.push_back(0.5);
    else if (info.id == ModelId::sgd_2012 && p.name == "theta0_rad")
      values.push_back(1);
    else if (info.id == ModelId::sgd_2012 && p.name != "alpha" && p.name != "p")
      values.push_back(1);
    else
      values.push_back(between(p, share));
  }
  return values;
}

/// Each model with each of its shadowings and, where another variant names another sampler, that variant.
inline std::vector<ModelSpec> sampled_specs() {
  std::vector<ModelSpec> all;
  for (const ModelInfo& info : models()) {
    ModelSpec spec;
    spec.id = info.id;
    if (info.shadowings.empty()) all.push_back(spec);
    for (const auto name : info.shadowings) {
      set_shadowing(spec, name);
      all.push_back(spec);
    }
    if (info.id == ModelId::cook_torrance_1981 || info.id == ModelId::rough_dielectric) {
      spec.form = 1;
      all.push_back(spec);
    }
  }
  return all;
}

inline std::vector<SamplingCase> sampling_cases(const std::vector<double>& shares,
                                                const std::vector<double>& thetas_deg, double kd = 0,
                                                bool retro = false) {
  std::vector<SamplingCase> all;
  for (const ModelSpec& plain : sampled_specs())
    for (const double share : shares)
      for (const double theta : thetas_deg) {
        ModelSpec spec = plain;
        if (spec.id == ModelId::mirror && kd == 0) continue;  // nothing but a delta
        spec.retro = retro && spec.id != ModelId::lambert;
        const ModelInfo& info = spec.info();
        all.push_back({spec, values_at(info, share, kd), theta,
                       fmt::format("{} {}{} at {} of its box, {} deg", info.name,
                                   info.shadowings.empty() ? "" : name_of(spec.shadowing),
                                   spec.form > 0 ? spec.variant() : "", share, theta)});
      }
  return all;
}

inline UnitVector<double> lane(const UnitVector<DoubleLanes>& v, std::size_t k) {
  return {v.x.get(k), v.y.get(k), v.z.get(k)};
}

}  // namespace gonio::test
