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
  return {{LobeSum(fit.spec), fit.values, {}, {}}, Surface(index), std::nullopt};
}

bool is_fit_file(const std::string& name) { return name.ends_with(".json"); }

Surface surface_of(const FittedMaterial& fitted) {
  SurfaceArguments arguments;
  arguments.n = fitted.n, arguments.k = fitted.k;
  if (fitted.material) arguments.material = *fitted.material;
  return Surface(arguments);
}

constexpr double kStep_nm = 5;

/// From the first to the last wavelength of the fit, with all of them: n and k are curved in between.
std::vector<double> spectral_wavelengths(const FittedMaterial& fitted) {
  std::vector<double> all = fitted.wavelength_nm;
  for (double nm = all.front() + kStep_nm; nm < fitted.wavelength_nm.back(); nm += kStep_nm) all.push_back(nm);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<double> visible_wavelengths_of(const Surface& surface) {
  const bool database = surface.needs_wavelength();
  const double lo = std::max(360.0, database ? surface.material().range_lo_nm() : 0.0);
  const double hi = std::min(830.0, database ? surface.material().range_hi_nm() : 830.0);
  if (!(lo <= hi)) throw input_error("{}: has no data between 360 and 830 nm; expected --at NM", surface.name());
  std::vector<double> all;
  for (double nm = lo; nm < hi; nm += kStep_nm) all.push_back(nm);
  all.push_back(hi);
  return all;
}

std::vector<double> sampled_wavelengths(const Subject& subject, std::optional<double> at_nm) {
  if (at_nm || !subject.needs_wavelength()) return {subject.wavelength_for(at_nm)};
  if (subject.is_spectral()) return spectral_wavelengths(*subject.fitted);
  if (subject.fitted && !subject.surface.needs_wavelength()) return {subject.wavelength_for(at_nm)};
  return visible_wavelengths_of(subject.surface);
}

}  // namespace

std::vector<double> Subject::values_at(double wavelength_nm) const {
  return fitted ? fitted->values_at(wavelength_nm) : model.values;
}

bool Subject::needs_wavelength() const {
  return surface.needs_wavelength() || model.sum.needs_wavelength() || is_spectral();
}

double Subject::wavelength_for(std::optional<double> asked_nm) const {
  if (asked_nm && !(*asked_nm > 0 && *asked_nm < 1e7)) throw input_error("--at {}: out of range; expected a wavelength in nm", *asked_nm);
  if (fitted) return fitted->wavelength(asked_nm).value_or(0);
  if (asked_nm) return *asked_nm;
  if (needs_wavelength())
    throw input_error("{}: no wavelength; expected --at NM or a column wavelength_nm", model.sum.name());
  return 0;
}

Subject make_subject(const ModelArguments& model, const SurfaceArguments& surface) {
  if (model.model.starts_with(kPublished)) return published_subject(model, surface);
  if (!is_fit_file(model.model)) return {choose_model(model), Surface(surface), std::nullopt};
  if (!model.settings.empty() || !model.variant.empty() || surface.given())
    throw input_error("{}: a fit brings its own parameters and material; expected no --set, --variant, --material, --n", model.model);
  const FittedMaterial fitted = read_fit(model.model);
  return {{fitted.model, fitted.values, {}, {}}, surface_of(fitted), fitted};
}

SurfaceSamples sample_surface(const Subject& subject, std::optional<double> at_nm) {
  SurfaceSamples samples;
  samples.wavelength_nm = sampled_wavelengths(subject, at_nm);
  for (const double nm : samples.wavelength_nm) {
    samples.surface.interfaces.push_back(subject.surface.at(nm));
    samples.surface.wavelength_um.push_back(nm > 0 ? nm / 1000 : 0.55);
  }
  if (!subject.needs_wavelength()) samples.wavelength_nm = {0};
  return samples;
}

}  // namespace gonio::cli
