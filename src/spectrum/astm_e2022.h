#pragma once
// Tristimulus weights for reflectances measured at a coarse, even step: the method of ASTM E2022 (the tables of ASTM
// E308). Reflectance between the points is Lagrange's polynomial (cubic; quadratic in the first and last interval),
// light and observer stay at 1 nm; the interpolation is folded into the weights, which are then summed directly.
// Beyond the first and last point the reflectance is taken as there (E308, §7.3.2.2).
// A variant of color_of: equal to it at 1 nm; at 10 and 20 nm as good as the reflectance is smooth.
#include "spectrum/colorimetry.h"

namespace gonio {

/// Weights at first_nm, first_nm + step_nm, …, last_nm, with Y = 100 for the perfect diffuser. The sum runs over the
/// wavelengths common to light and observer. InputError unless first, last and step are whole nanometres, the range a
/// multiple (at least two) of the step, and some of the weights' range is common to light and observer.
ColorWeights astm_e2022_weights(const Spectrum& light, const Observer& observer, double first_nm, double last_nm,
                                double step_nm);

/// Tristimulus values of a reflectance at the weights' wavelengths, and the white of the same weights.
ColorSum color_by_weights(const Factor& data, const ColorWeights& weights);

}  // namespace gonio
