#include "energy/lobe_families.h"

#include <cmath>
#include <optional>

#include "base/error.h"

namespace gonio {
namespace {

const double kWidestAlpha = std::sqrt(8);  // m = 2

template <Shadowing S>
Lobe<double> beckmann_lobe(double alpha) {
  return TorranceSparrow<double>{alpha, S};
}
template <Shadowing S>
Lobe<double> ggx_lobe(double alpha) {
  return Ggx<double>{alpha, alpha, S};
}
Lobe<double> pseudo_realistic_lobe(double alpha) { return PseudoRealistic<double>{alpha / std::sqrt(2)}; }
Lobe<double> gaussian_angle_lobe(double alpha) {
  return Blinn<double>{1 / alpha, BlinnDensity::gaussian_angle, BlinnScale::normalised,
                       gaussian_angle_integral(1 / alpha)};
}
Lobe<double> cosine_power_lobe(double alpha) {
  return Blinn<double>{2 / square(alpha), BlinnDensity::cosine_power, BlinnScale::normalised};
}

struct Found {
  std::string_view family;
  double alpha, factor = 1;
};

std::string_view beckmann_name(Shadowing shadowing) {
  switch (shadowing) {
    case Shadowing::v_cavity:
      return "beckmann-v-cavity";
    case Shadowing::smith_separable:
      return "beckmann-smith-separable";
    case Shadowing::smith_correlated:
      return "beckmann-smith-correlated";
    case Shadowing::smith_1967:
      return "beckmann-smith-1967";
    default:
      return {};
  }
}
std::string_view ggx_name(Shadowing shadowing) {
  switch (shadowing) {
    case Shadowing::v_cavity:
      return "ggx-v-cavity";
    case Shadowing::smith_separable:
      return "ggx-smith-separable";
    case Shadowing::smith_correlated:
      return "ggx-smith-correlated";
    default:
      return {};
  }
}

std::vector<Found> found(const PseudoRealistic<double>& one) {
  return {{"pseudo-realistic", std::sqrt(2) * one.slope_rms}};
}
std::vector<Found> found(const TorranceSparrow<double>& one) {
  switch (one.form) {  // the others have another D or G
    case FacetForm::exact:
    case FacetForm::schlick_f:
    case FacetForm::erfcx:
    case FacetForm::erfc:
      return {{beckmann_name(one.shadowing), one.alpha}};
    default:
      return {};
  }
}
std::vector<Found> found(const AnisotropicBeckmann<double>& one) {
  if (one.alpha_x != one.alpha_y) return {};
  return {{beckmann_name(one.shadowing), one.alpha_x}};
}
std::vector<Found> found(const Ggx<double>& one) {
  if (one.alpha_x != one.alpha_y) return {};
  return {{ggx_name(one.shadowing), one.alpha_x}};
}
std::vector<Found> found(const RoughDielectric<double>& one) {
  const bool ggx = one.normals == DielectricNormals::ggx;
  return {{ggx ? ggx_name(Shadowing::smith_separable) : beckmann_name(Shadowing::smith_separable), one.alpha}};
}
/// One lobe over its family's normalised one is the ratio of their factors.
std::vector<Found> found(const Blinn<double>& one) {
  if (one.density == BlinnDensity::spheroid)
    return {{"ggx-v-cavity", one.parameter, one.factor() * 4 * kPi<double> * square(one.parameter)}};
  if (one.density == BlinnDensity::cosine_power)
    return {{"cosine-power", std::sqrt(2 / one.parameter), one.factor() * 8 * kPi<double> / (one.parameter + 2)}};
  return {{"gaussian-angle", 1 / one.parameter, one.factor() * 4 * gaussian_angle_integral(one.parameter)}};
}
std::vector<Found> found(const CookTorrance<double>& one) {
  if (one.density == CookDensity::gaussian_angle)
    return {{"gaussian-angle", one.alpha, 4 * gaussian_angle_integral(1 / one.alpha) / kPi<double>}};
  std::vector<Found> widths{{"beckmann-v-cavity", one.alpha, 4 * (1 - one.weight_2)}};
  if (one.weight_2 > 0) widths.push_back({"beckmann-v-cavity", one.alpha_2, 4 * one.weight_2});
  return widths;
}
template <class L>
std::vector<Found> found(const L&) {
  return {};
}

}  // namespace

const std::vector<LobeFamily>& lobe_families() {
  static const std::vector<LobeFamily> all{
      {"pseudo-realistic", "Maillot 1996 (31), V-cavities", kWidestAlpha, pseudo_realistic_lobe},
      {"beckmann-v-cavity", "Gaussian slopes, V-cavities", kWidestAlpha, beckmann_lobe<Shadowing::v_cavity>},
      {"beckmann-smith-correlated", "Gaussian slopes, Smith's masking and shadowing, correlated in height",
       kWidestAlpha, beckmann_lobe<Shadowing::smith_correlated>},
      {"beckmann-smith-separable", "Gaussian slopes, Smith's masking times shadowing", kWidestAlpha,
       beckmann_lobe<Shadowing::smith_separable>},
      {"beckmann-smith-1967", "Gaussian slopes, Smith's function of 1967", kWidestAlpha,
       beckmann_lobe<Shadowing::smith_1967>},
      {"ggx-v-cavity", "GGX normals, V-cavities", kWidestAlpha, ggx_lobe<Shadowing::v_cavity>},
      {"ggx-smith-correlated", "GGX normals, Smith, correlated in height", kWidestAlpha,
       ggx_lobe<Shadowing::smith_correlated>},
      {"ggx-smith-separable", "GGX normals, Smith's masking times shadowing", kWidestAlpha,
       ggx_lobe<Shadowing::smith_separable>},
      {"gaussian-angle", "Gaussian of the facets' angle (Torrance & Sparrow 1967), V-cavities", kWidestAlpha,
       gaussian_angle_lobe},
      {"cosine-power", "cosine power of the facets' angle (Blinn 1977), V-cavities", std::sqrt(2), cosine_power_lobe},
  };
  return all;
}

const LobeFamily& lobe_family(std::string_view name) {
  std::string names;
  for (const LobeFamily& family : lobe_families()) {
    if (family.name == name) return family;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", family.name);
  }
  throw input_error("no tables of {}; expected one of {}", name, names);
}

std::vector<FamilyLobe> family_lobes(const Lobe<double>& lobe) {
  std::vector<FamilyLobe> lobes;
  for (const Found& one : std::visit([](const auto& of) { return found(of); }, lobe)) {
    if (one.family.empty()) return {};
    const LobeFamily& family = lobe_family(one.family);
    // A bound taken through a square root may pass it by a rounding.
    if (!(one.alpha >= kNarrowestAlpha * (1 - 1e-12) && one.alpha <= family.widest * (1 + 1e-12))) return {};
    lobes.push_back({&family, one.alpha, one.factor});
  }
  return lobes;
}

}  // namespace gonio
