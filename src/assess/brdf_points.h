#pragma once
// Where the reflection models are measured: every (model, shadowing, variant), and for each the points of a sweep over
// its whole documented box, the directions a renderer or a fit may hand it, and any material.
#include <cstdint>
#include <string>
#include <vector>

#include "base/unit_vector.h"
#include "brdf/brdf.h"

namespace gonio {

/// Precision of the numbers that an evaluation receives and computes with.
enum class Precision { single, twofold };

/// One evaluation: everything it receives, each number exact in the precision it was made for.
struct BrdfPoint {
  std::vector<double> values;  ///< in the order of the model's parameters
  UnitVector<double> i, o;     ///< z > 0; unit to the precision's rounding
  Interface<double> surface;
  double wavelength_um;
  std::size_t set;  ///< points of one set share all but their directions
};

/// "torrance-sparrow smith-correlated schlick-f retro": what is not the model's only choice.
std::string case_name(const ModelSpec& spec);

/// Every model with every shadowing and variant it offers (once where the variant brings its own G), and turned back
/// once with its defaults.
std::vector<ModelSpec> brdf_cases();

struct PointOptions {
  std::uint64_t seed = 1;
  std::size_t sets = 64;          ///< of parameters, material and wavelength
  std::size_t directions = 48;    ///< pairs in each set
  bool fit_box = false;           ///< the box the fit searches in place of the documented one
  bool faceted_materials = true;  ///< n near 1, n < 1, k = 0 … 100; else one metal
};

/// Points of a case, the same for the same options. Parameters: corners of the box, then a scrambled Sobol sequence,
/// logarithmic where the box allows it (every fourth set with kd and ks at random, else kd = 0, ks = 1, so that nothing
/// hides the lobe). Directions: the exact normal twice, then all kinds in turn (uniform, on the lobe out to exp(-700)
/// of its peak, next to the mirror and to retro, exactly there, exact normal, grazing to 89.9999°).
std::vector<BrdfPoint> brdf_points(const ModelSpec& spec, Precision precision, const PointOptions& options);

/// Tangents of the half vector, along x and y, at which the lobe has fallen to half; 1 where it has none.
struct LobeWidth {
  double x, y;
};
LobeWidth lobe_width(const ModelSpec& spec, const std::vector<double>& values, const Interface<double>& surface,
                     double wavelength_um);

/// A number of this precision next to x.
double rounded(double x, Precision precision);

}  // namespace gonio
