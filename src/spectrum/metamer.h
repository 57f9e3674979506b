#pragma once
// Metamerism: two reflectances of one colour under one light and of two under another.
// A metameric black b adds nothing to the colour under the first light (G. Wyszecki, Farbe 2, 39 (1953)). Among the
// blacks that shift X, Y and Z under the second light by a given amount, the one of least roughness (sum of squared
// second differences at 1 nm) is the solution of one linear system; r + t·b is followed in each direction of the shift
// until it meets 0 or 1. The most different of these smooth metamers is taken; rougher ones may differ more.
#include "spectrum/colorimetry.h"

namespace gonio {

struct Metamer {
  Spectrum original, reflectance;  ///< at whole nanometres
  ColorSum first, second;          ///< the metamer's colours under the two lights
  ColorSum first_original, second_original;
  double delta_e_first, delta_e_second;  ///< CIEDE2000 from the original: 0 to rounding, and the metamerism
  double roughness_added;                ///< rms second difference of the black, per nm²
};

/// Over the wavelengths common to the data, both lights and the observer. InputError for lights that are proportional
/// there, for a reflectance outside 0 to 1 (a rounding's 1e-9 aside), and where color_of refuses. delta_e_second is 0
/// where no such metamer exists (the perfect diffuser, an optimal colour).
Metamer metamer_of(const Factor& data, const Spectrum& first, const Spectrum& second, const Observer& observer,
                   bool allow_partial = false);

}  // namespace gonio
