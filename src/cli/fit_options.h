#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fit/fit.h"

namespace gonio::cli {

/// How to fit, as the command line says it: what `fit` and `batch` share.
struct FitOptions {
  std::string metric = "log", loss = "none", weighting, variant, hold_out = "middle", material, floor,
              intervals = "curvature", aperture, source, noise, signature;
  std::vector<std::string> settings, free, spectral;
  int starts = 16;
  double signature_scale = 1;

  std::string words() const;  ///< all of them, to tell one set of options from another
};

void add_fit_options(CLI::App& command, FitOptions& options);

/// The scan less the instrument's signature, where one is named.
Measurement cleaned(Measurement scan, const FitOptions& options);

/// InputError for what no fit of that model (a name, or a sum a+b) can take. `aperture_deg` is what the measurement states.
FitRequest request_for(const FitOptions& options, const std::string& model_name, std::uint64_t seed,
                       std::optional<double> aperture_deg = {});

}  // namespace gonio::cli
