#pragma once
#include "cli/arguments.h"
#include "energy/limits.h"
#include "fit/fitted_material.h"

namespace gonio::cli {

/// What eval and table look at: a model with its values and surface, from the command line or from a fit.json.
struct Subject {
  ChosenModel model;
  Surface surface;
  std::optional<FittedMaterial> fitted;

  /// The values at a wavelength of wavelength_for(): kd and ks of a fit may differ between wavelengths.
  std::vector<double> values_at(double wavelength_nm) const;
  bool is_spectral() const { return fitted && fitted->is_spectral(); }
  /// Whether anything depends on the wavelength.
  bool needs_wavelength() const;

  /// The wavelength to evaluate at: the one asked for, where the subject has values there. InputError when one is needed
  /// and none is given, or when a fit says nothing about it. 0 where no wavelength matters.
  double wavelength_for(std::optional<double> asked_nm) const;
};

/// InputError for what no model or fit is; a fit takes neither --set nor --material.
Subject make_subject(const ModelArguments& model, const SurfaceArguments& surface);

/// The subject's surface at one wavelength, or over the visible range (360-830 nm) as far as its data reach, 5 nm apart;
/// of a fit whose kd or ks differ between wavelengths, from the first to the last of these, and each of them.
SurfaceSamples sample_surface(const Subject& subject, std::optional<double> at_nm);

}  // namespace gonio::cli
