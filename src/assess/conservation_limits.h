#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/brdf.h"
#include "energy/cos_nodes.h"
#include "energy/limits.h"

namespace gonio {

/// A surface over the visible range, as far as its data reach.
struct MetalSurface {
  std::string symbol;  ///< "Au"; "F = 1" of facets that reflect everything
  std::string id;      ///< of the database's entry
  SurfaceSamples samples;
  std::vector<NodeValues> at_nodes;  ///< of the samples: what the tables multiply
  double node_error = 0;  ///< what the tables lose on R beyond their own error: above 0 for Cs and Rb, whose n is small
};

inline constexpr double kVisibleLo_nm = 360, kVisibleHi_nm = 830, kVisibleStep_nm = 10;

/// F = 1, then every metallic element whose symbol is the alias of optical constants that reach some of the visible range, by symbol.
std::vector<MetalSurface> conservation_metals();
MetalSurface white_facets();

/// A model by its slope alone, ks = 1.
struct ConservationModel {
  std::string_view name;
  Lobe<double> (*lobe)(double slope_rms);
};
/// pseudo-realistic, whose E may exceed 1, and torrance-sparrow, whose E does not.
const std::array<ConservationModel, 2>& conservation_models();

/// (43) over all incidences and wavelengths of a surface, from the tables of E: every limit lowered by their error.
struct SlopeLimits {
  double slope_rms = 0;
  double largest_e = 0, theta_deg = 0, wavelength_nm = 0;  ///< max E (ks = 1), and where
  double ks_max = 0;                                       ///< kd = 0
  double kd_max = 0, kd_max_at_half = 0;                   ///< ks = 1 and ks = 0.5; 0 where the lobe alone breaks (43)
  double turning_kd = 0;  ///< ks = 0.5: the behaviour is "specular" below, "diffuse" above (Maillot 1996, §III.8)
};
/// InputError without the tables that the build makes.
SlopeLimits slope_limits(const ConservationModel& model, double slope_rms, const MetalSurface& metal);

/// Slopes from 0.01 to 2 in equal ratios: what the tables hold.
std::vector<double> conservation_slopes();

/// One surface under one model over conservation_slopes().
struct MetalLimits {
  std::size_t model;
  const MetalSurface* metal;
  std::vector<SlopeLimits> over_slopes;
};
std::vector<MetalLimits> metal_limits(const std::vector<MetalSurface>& metals);

}  // namespace gonio
