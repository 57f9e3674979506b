#include "cli/subject.h"

#include <algorithm>

#include "base/error.h"
#include "fit/published_parameters.h"

namespace gonio::cli {
namespace {

constexpr std::string_view kPublished = "published:";

/// A row of a published table brings its parameters and, where F is of an index, that index.
Subject published_subject(const ModelArguments& model, const SurfaceArguments& surface) {
  if (!model.settings.empty() || !model.variant.empty() || surface.given())
    throw input_error("{}: a published row brings its own parameters; expected no --set, --variant, --material, --n", model.model);
  const PublishedFit fit = published_fit(std::string_view(model.model).substr(kPublished.size()));
  SurfaceArguments index;
  if (!fit.surface.perfect) index.n = fit.surface.n;
  return {{fit.spec, fit.values, {}, {}}, Surface(index), std::nullopt};
}

bool is_fit_file(const std::string& name) { return name.ends_with(".json"); }

Surface surface_of(const FittedMaterial& fitted) {
  SurfaceArguments arguments;
  arguments.n = fitted.n;
  if (fitted.material) arguments.material = *fitted.material;
  return Surface(arguments);
}

}  // namespace

double Subject::wavelength_for(std::optional<double> asked_nm) const {
  if (asked_nm && !(*asked_nm > 0 && *asked_nm < 1e7)) throw input_error("--at {}: out of range; expected a wavelength in nm", *asked_nm);
  if (fitted) return fitted->wavelength(asked_nm).value_or(0);
  if (asked_nm) return *asked_nm;
  if (model.spec.info().needs_wavelength || surface.needs_wavelength())
    throw input_error("{}: no wavelength; expected --at NM or a column wavelength_nm", model.spec.info().name);
  return 0;
}

Subject make_subject(const ModelArguments& model, const SurfaceArguments& surface) {
  if (model.model.starts_with(kPublished)) return published_subject(model, surface);
  if (!is_fit_file(model.model)) return {choose_model(model), Surface(surface), std::nullopt};
  if (!model.settings.empty() || !model.variant.empty() || surface.given())
    throw input_error("{}: a fit brings its own parameters and material; expected no --set, --variant, --material, --n", model.model);
  const FittedMaterial fitted = read_fit(model.model);
  return {{fitted.model.first(), fitted.values, {}, {}}, surface_of(fitted), fitted};
}

SurfaceSamples sample_surface(const Subject& subject, std::optional<double> at_nm) {
  const bool database = subject.surface.needs_wavelength(), depends = database || subject.model.spec.info().needs_wavelength;
  const bool one_only = at_nm || !depends || (subject.fitted && !database);
  std::vector<double> wavelengths;
  if (one_only) {
    wavelengths.push_back(subject.wavelength_for(at_nm));
  } else {
    const double lo = std::max(360.0, database ? subject.surface.material().range_lo_nm() : 0.0);
    const double hi = std::min(830.0, database ? subject.surface.material().range_hi_nm() : 830.0);
    if (!(lo <= hi)) throw input_error("{}: has no data between 360 and 830 nm; expected --at NM", subject.surface.name());
    for (double nm = lo; nm < hi; nm += 5) wavelengths.push_back(nm);
    wavelengths.push_back(hi);
  }
  SurfaceSamples samples;
  samples.wavelength_nm = wavelengths;
  for (const double nm : wavelengths) {
    samples.surface.interfaces.push_back(subject.surface.at(nm));
    samples.surface.wavelength_um.push_back(nm > 0 ? nm / 1000 : 0.55);
  }
  if (!depends) samples.wavelength_nm = {0};
  return samples;
}

}  // namespace gonio::cli
