#pragma once
// A model as another program can take it: scene text or a table of directions, and what it costs in accuracy.
#include <string>
#include <vector>

#include "assess/sphere_difference.h"
#include "brdf/lobe_sum.h"

namespace gonio::cli {

/// What is exported: a model with its surface at each wavelength.
struct ExportSource {
  LobeSum model;
  std::vector<std::vector<double>> values;  ///< one list for all wavelengths, or one for each (kd or ks differ)
  std::vector<double> wavelengths_nm;       ///< increasing, at least one
  std::vector<Interface<double>> surfaces;  ///< at each of them
  std::string material;                     ///< for the header

  /// Whether one model with one list of values says it: else only a table can.
  bool is_one_lobe() const { return !model.is_sum() && values.size() == 1; }
  const std::vector<double>& values_at(std::size_t wavelength) const {
    return values[values.size() > 1 ? wavelength : 0];
  }
  BrdfOfPair f() const;
  /// Model, variant, parameters, material, wavelengths: one line.
  std::string described() const;
};

/// Sum over a grid of directions and over the wavelengths, and on a sphere.
struct ExportError {
  double rms_log10 = 0, largest_log10 = 0;
  std::size_t pairs = 0, vanishing = 0;  ///< values above 1e-4 of the grid's peak: compared; gone in the export
  VisibleError sphere{0, 0};
  double delta = 0;  ///< largest share of the light in a delta, which is left out

  /// The line of the file's header.
  std::string described() const;
};

/// theta_i 0 to 75° and theta_o 0 to 75° by 7.5°, phi 0 to 180° by 15°, phi_i 0 to 90° by 30°.
ExportError export_error(const ExportSource& source, const BrdfOfPair& exported);

/// What is written. `table` is empty where scene text alone says everything.
struct Exported {
  std::string text;   ///< the scene text, with its header
  std::string table;  ///< bytes of an RGL file
  ExportError error;
  std::string kind;  ///< roughconductor, diffuse, blendbsdf, conductor, mix, measured, …
};

enum class ExportTarget { rgl, mitsuba, pbrt };

/// `table_name` is how the scene text calls the RGL file. InputError, one line, for what the target cannot express.
Exported exported(const ExportSource& source, ExportTarget target, const std::string& table_name);

}  // namespace gonio::cli
