#include "brdf/models.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace gonio {
namespace {

constexpr ParameterInfo kKd{"kd", "1", "diffuse factor", 0, 10, 1e-4, 2, 0.0, true};
constexpr ParameterInfo kKs{"ks", "1", "lobe factor", 0, 100, 1e-4, 10, 1.0, true};
constexpr ParameterInfo kSlope{
    "m", "1", "slope rms, one-dimensional (alpha = sqrt(2) m may be given instead)", 1e-4, 10, 5e-3, 1, std::nullopt};

std::vector<ModelInfo> make_models() {
  ParameterInfo lambert_kd = kKd;
  lambert_kd.fallback = 1.0;
  lambert_kd.meaning = "directional reflectance";
  const std::vector<std::string_view> exact{"exact"};
  return {
      {ModelId::lambert, "lambert", "diffuse reflector", "f = kd/pi", "Lambert 1760", {lambert_kd}, {}, exact, true, true, true, false},
      {ModelId::pseudo_realistic, "pseudo-realistic", "Maillot's pseudo-realistic model (31)",
       "f = kd R0/pi + ks G R(cos_d) P(zeta_h)/(4 cos_i cos_o), P = exp(-tan^2/(2m^2))/(m sqrt(2 pi) cos^2)",
       "Maillot 1996, eq. (31)", {kSlope, kKd, kKs}, {}, exact, true, false, true, false},
      {ModelId::torrance_sparrow, "torrance-sparrow", "Torrance-Sparrow with normalised Beckmann density",
       "f = kd/pi + ks D G F(cos_d)/(4 cos_i cos_o)", "Torrance & Sparrow 1967, doi:10.1364/JOSA.57.001105",
       {kSlope, kKd, kKs}, {"v-cavity", "smith-separable", "smith-correlated", "smith-1967", "none"}, exact, true, true, true, false},
      {ModelId::beckmann_kirchhoff, "beckmann-kirchhoff", "Beckmann-Kirchhoff diffraction (18a), incoherent part + coherent energy",
       "f = kd/pi + ks R(cos_d) pi T^2 F'^2/(lambda^2 cos_i cos_o) sum_j Pois(j;g)/j exp(-v_xy^2 T^2/(4j))",
       "Beckmann & Spizzichino 1963; Maillot 1996, eq. (18a)",
       {{"sigma_um", "um", "height rms", 1e-4, 1e3, 0.02, 5, std::nullopt},
        {"correlation_um", "um", "correlation length T (1/e of the autocorrelation)", 1e-2, 1e5, 0.5, 100, std::nullopt},
        kKd, kKs},
       {}, {"exact", "rough-limit", "smooth-limit"}, true, false, false, true},
  };
}

}  // namespace

const std::vector<ModelInfo>& models() {
  static const std::vector<ModelInfo> all = make_models();
  return all;
}

const ModelInfo& model(ModelId id) { return models()[static_cast<std::size_t>(id)]; }

const ModelInfo& model(std::string_view name) {
  std::string known;
  for (const ModelInfo& info : models()) {
    if (info.name == name) return info;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", info.name);
  }
  throw input_error("{}: unknown model; expected one of {}", name, known);
}

std::size_t ModelInfo::index_of(std::string_view parameter) const {
  std::string known;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].name == parameter) return i;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", parameters[i].name);
  }
  throw input_error("{}: unknown parameter of {}; expected {}", parameter, name, known);
}

std::string_view ModelSpec::variant() const {
  switch (form) {
    case KirchhoffForm::series: return "exact";
    case KirchhoffForm::rough_limit: return "rough-limit";
    case KirchhoffForm::smooth_limit: return "smooth-limit";
  }
  return "";
}

void set_shadowing(ModelSpec& spec, std::string_view name) {
  if (spec.info().shadowings.empty())
    throw input_error("shadowing={}: {} has no choice of shadowing; expected none to be given", name, spec.info().name);
  spec.shadowing = shadowing_from(name);
}

void set_variant(ModelSpec& spec, std::string_view name) {
  const auto& known = spec.info().variants;
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw input_error("{}: unknown variant of {}; expected {}", name, spec.info().name, fmt::join(known, ", "));
  if (spec.id == ModelId::beckmann_kirchhoff)
    spec.form = name == "exact"         ? KirchhoffForm::series
                : name == "rough-limit" ? KirchhoffForm::rough_limit
                                        : KirchhoffForm::smooth_limit;
}

void check_values(const ModelInfo& info, std::span<const double> values) {
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    const ParameterInfo& p = info.parameters[i];
    if (!(values[i] >= p.lo && values[i] <= p.hi))
      throw input_error("{}={}: outside the box of {}; expected {} to {} {}", p.name, values[i], info.name, p.lo, p.hi,
                        p.unit == "1" ? "" : p.unit);
  }
}

}  // namespace gonio
