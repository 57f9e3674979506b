#pragma once
// What an error of a BRDF looks like: the colours of a lit sphere by one beside those by another.
#include <functional>
#include <vector>

#include "base/unit_vector.h"

namespace gonio {

/// f_r in sr⁻¹ of unit vectors towards light and eye, at the wavelength with that index.
using BrdfOfPair =
    std::function<double(const UnitVector<double>& i, const UnitVector<double>& o, std::size_t wavelength)>;

/// ΔE_2000 over the pixels of a sphere.
struct VisibleError {
  double mean, largest;
};

/// D65 at 45° from the eye, 1931 observer, the brightest pixel of `exact` Y = 100: `shown` against `exact`. Radiances are linear between
/// the wavelengths; a single one stands for all of them (grey).
VisibleError sphere_difference(const BrdfOfPair& exact, const BrdfOfPair& shown,
                               const std::vector<double>& wavelengths_nm);

}  // namespace gonio
