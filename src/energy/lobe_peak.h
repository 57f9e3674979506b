#pragma once
#include <vector>

#include "brdf/brdf.h"
#include "brdf/sampling.h"

namespace gonio {

/// Whether a Brdf has a lobe that is no delta.
inline bool has_shape(const Brdf<double>& brdf) {
  return brdf.ks > 0 && !std::holds_alternative<Lambert>(brdf.lobe) && !std::holds_alternative<Mirror>(brdf.lobe);
}

/// Where a lobe lit from i is highest: the mirror direction, lafortune's axis; turned back, towards the light.
inline UnitVector<double> peak_of(const Brdf<double>& brdf, const UnitVector<double>& i) {
  const UnitVector<double> given = brdf.retro ? UnitVector<double>{-i.x, -i.y, i.z} : i;
  if (const auto* one = std::get_if<Lafortune<double>>(&brdf.lobe)) return one->sampler().axis(given);
  return {-given.x, -given.y, given.z};
}

/// Of the lobe in directions: twice its slopes, the narrower foreshortened, and the width of diffraction.
inline std::vector<double> widths_of(const Brdf<double>& brdf, double cos_i, double wavelength_um) {
  const SlopeExtent slopes = slope_extent(brdf.lobe, wavelength_um);
  return {2 * slopes.widest, 2 * slopes.narrowest, 2 * slopes.narrowest * cos_i};
}

}  // namespace gonio
