#include "brdf/models.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "brdf/model_lists.h"

namespace gonio {
namespace {

/// The thesis's own, in the order of PHYSICS.
std::vector<ModelInfo> thesis_models() {
  ParameterInfo lambert_kd = kKd;
  lambert_kd.fallback = 1.0;
  lambert_kd.meaning = "directional reflectance";
  const std::vector<std::string_view> exact{"exact"};
  return {
      {ModelId::lambert,
       "lambert",
       "diffuse reflector",
       "f = kd/pi",
       "Lambert 1760",
       {lambert_kd},
       {},
       exact,
       true,
       true,
       true,
       false},
      {ModelId::pseudo_realistic,
       "pseudo-realistic",
       "Maillot's pseudo-realistic model (31)",
       "f = kd R0/pi + ks G R(cos_d) P(zeta_h)/(4 cos_i cos_o), P = exp(-tan^2/(2m^2))/(m sqrt(2 pi) cos^2)",
       "Maillot 1996, eq. (31)",
       {kSlope, kKd, kKs},
       {},
       exact,
       true,
       false,
       true,
       false},
      {ModelId::torrance_sparrow,
       "torrance-sparrow",
       "Torrance-Sparrow with normalised Beckmann density",
       "f = kd/pi + ks D G F(cos_d)/(4 cos_i cos_o)",
       "Torrance & Sparrow 1967, doi:10.1364/JOSA.57.001105",
       {kSlope, kKd, kKs},
       {"v-cavity", "smith-separable", "smith-correlated", "smith-1967", "none"},
       {"exact", "schlick-f", "schlick-d", "schlick-g", "schlick", "walter-g", "erfcx", "erfc", "tabulated"},
       true,
       true,
       true,
       false},
      {ModelId::beckmann_kirchhoff,
       "beckmann-kirchhoff",
       "Beckmann-Kirchhoff diffraction (18a), incoherent part + coherent energy",
       "f = kd/pi + ks R(cos_d) pi T^2 F'^2/(lambda^2 cos_i cos_o) sum_j Pois(j;g)/j exp(-v_xy^2 T^2/(4j)); "
       "nieto-vesperinas-1982: times (cos_i/cos_o)^2",
       "Beckmann & Spizzichino 1963; Maillot 1996, eq. (18a)",
       {{"sigma_um", "um", "height rms", 1e-4, 1e3, 0.02, 5, std::nullopt},
        {"correlation_um", "um", "correlation length T (1/e of the autocorrelation)", 1e-2, 1e5, 0.5, 100,
         std::nullopt},
        kKd,
        kKs},
       {},
       {"exact", "rough-limit", "smooth-limit", "nieto-vesperinas-1982", "outwards", "series-10", "series-40",
        "gauss-12"},
       true,
       false,
       false,
       true,
       {"nieto-vesperinas-1982"}},
      {ModelId::stogryn_1967,
       "stogryn-1967",
       "Very rough surfaces of finite conductivity, R by polarisation at half the angle between i and o",
       "f = kd/pi + ks R(cos_d) D/(4 cos_i cos_o), Beckmann's D; in-plane-s, -p: R_s, R_p of light in the plane of "
       "incidence",
       "Stogryn 1967; Maillot 1996, I.2.3.4",
       {kSlope, kKd, kKs},
       {},
       {"exact", "in-plane-s", "in-plane-p"},
       true,
       false,
       false,
       false},
  };
}

}  // namespace

const std::vector<ModelInfo>& models() {
  static const std::vector<ModelInfo> all = [] {
    std::vector<ModelInfo> list = thesis_models();
    for (const auto& family : {faceted_models(), classical_models(), empirical_models()})
      list.insert(list.end(), family.begin(), family.end());
    return list;
  }();
  return all;
}

const ModelInfo& model(ModelId id) {
  const auto found =
      std::find_if(models().begin(), models().end(), [&](const ModelInfo& info) { return info.id == id; });
  return *found;  // every id is listed: tests/brdf/models_test.cpp
}

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

bool ModelSpec::reciprocal() const {
  const auto& exceptions = info().variants_not_reciprocal;
  return info().reciprocal && std::find(exceptions.begin(), exceptions.end(), variant()) == exceptions.end();
}

void set_retro(ModelSpec& spec, std::string_view yes_or_no) {
  if (yes_or_no != "yes" && yes_or_no != "no") throw input_error("retro={}: unknown; expected yes or no", yes_or_no);
  if (yes_or_no == "yes" && spec.id == ModelId::lambert)
    throw input_error("retro=yes: {} has no lobe to turn back; expected a model with a lobe", spec.info().name);
  spec.retro = yes_or_no == "yes";
}

void set_shadowing(ModelSpec& spec, std::string_view name) {
  if (spec.info().shadowings.empty())
    throw input_error("shadowing={}: {} has no choice of shadowing; expected none to be given", name, spec.info().name);
  const Shadowing shadowing = shadowing_from(name);
  const auto& known = spec.info().shadowings;
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw input_error("shadowing={}: {} has no such form; expected {}", name, spec.info().name, fmt::join(known, ", "));
  spec.shadowing = shadowing;
}

void set_variant(ModelSpec& spec, std::string_view name) {
  const auto& known = spec.info().variants;
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end())
    throw input_error("{}: unknown variant of {}; expected {}", name, spec.info().name, fmt::join(known, ", "));
  spec.form = static_cast<std::size_t>(found - known.begin());
}

void check_values(const ModelInfo& info, std::span<const double> values) {
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    const ParameterInfo& p = info.parameters[i];
    if (!(values[i] >= p.lo && values[i] <= p.hi))
      throw input_error("{}={}: outside the box of {}; expected {} to {} {}", p.name, values[i], info.name, p.lo, p.hi,
                        p.unit == "1" ? "" : p.unit);
  }
}

void check_values(const ModelSpec& spec, std::span<const double> values) {
  check_values(spec.info(), values);
  const bool rational_d = spec.variant() == "schlick-d" || spec.variant() == "schlick";
  if (rational_d && values[0] > 0.5)
    throw input_error("m={}: Schlick's D diverges there; expected m up to 0.5 (alpha up to 1/sqrt(2)) with variant {}",
                      values[0], spec.variant());
}

}  // namespace gonio
