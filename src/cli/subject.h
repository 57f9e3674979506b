#pragma once
#include "cli/arguments.h"

namespace gonio::cli {

/// What eval and table look at: a model with its values and surface, from the command line or from a fit.json.
struct Subject {
  ChosenModel model;
  Surface surface;
  std::vector<double> fitted_nm;    ///< wavelengths of the fit; empty on the command line, or when the fit states none
  bool from_fit = false, needs_wavelength = false, fixed_n = false;

  /// The wavelength to evaluate at: the one asked for, where the subject has values there; InputError when one is needed
  /// and none is given, or when a fit says nothing about it. 0 where no wavelength matters.
  double wavelength_for(std::optional<double> asked_nm) const;
};

Subject make_subject(const ModelArguments& model, const SurfaceArguments& surface);

}  // namespace gonio::cli
