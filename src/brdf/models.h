#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/beckmann_kirchhoff.h"
#include "surface/shadowing.h"

namespace gonio {

enum class ModelId { lambert, pseudo_realistic, torrance_sparrow, beckmann_kirchhoff };

/// A parameter as users see it. [lo, hi] is the documented box, refused outside; [fit_lo, fit_hi] the smaller box the fit
/// searches, on a logarithmic scale. Without `fallback` the parameter must be given.
struct ParameterInfo {
  std::string_view name, unit, meaning;
  double lo, hi, fit_lo, fit_hi;
  std::optional<double> fallback;
  bool linear = false;  ///< f is proportional to it (kd, ks)
};

struct ModelInfo {
  ModelId id;
  std::string_view name, summary, formula, source;
  std::vector<ParameterInfo> parameters;  ///< in the order of make_brdf's values
  std::vector<std::string_view> shadowings, variants;
  bool reciprocal, conserving, bounded_at_grazing, needs_wavelength;

  /// Position in `parameters`; InputError naming the model's parameters when unknown.
  std::size_t index_of(std::string_view parameter) const;
};

/// Every model, in the order of PHYSICS.
const std::vector<ModelInfo>& models();
const ModelInfo& model(ModelId id);
/// InputError for an unknown name, listing the known ones.
const ModelInfo& model(std::string_view name);

/// A model and the choices that are no numbers.
struct ModelSpec {
  ModelId id = ModelId::lambert;
  Shadowing shadowing = Shadowing::smith_correlated;  ///< torrance-sparrow
  KirchhoffForm form = KirchhoffForm::series;         ///< beckmann-kirchhoff

  const ModelInfo& info() const { return model(id); }
  std::string_view variant() const;
};

/// Sets `shadowing=` or the variant by name; InputError when the model has no such choice.
void set_shadowing(ModelSpec& spec, std::string_view name);
void set_variant(ModelSpec& spec, std::string_view name);

/// Values in the order of info().parameters, each checked against its box (InputError: non-finite or outside).
void check_values(const ModelInfo& info, std::span<const double> values);

}  // namespace gonio
