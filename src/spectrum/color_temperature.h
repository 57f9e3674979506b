#pragma once
// Correlated colour temperature: the Planckian radiator nearest in CIE 1960 (u, v), and the signed distance to it.
// CIE 015:2018, §9.5; Y. Ohno, LEUKOS 10, 47-55 (2014) for Duv (ANSI C78.377: positive above the locus, greenish).
// The locus is summed over the observer at whole nanometres and the distance minimised, not read from a table.
#include "spectrum/colorimetry.h"

namespace gonio {

/// c2 = hc/k in m·K (exact in SI 2019, rounded to ten digits).
inline constexpr double kSecondRadiationConstant = 1.438776877e-2;

/// Relative spectral radiance of a black body, per wavelength; 1 at 560 nm.
double planck_relative(double wavelength_nm, double kelvin);

/// u = 4X/(X + 15Y + 3Z), v = 6Y/(X + 15Y + 3Z); (0, 0) for black.
Chromaticity<double> ucs_1960(const Xyz<double>& c);

/// Where the black body lies in CIE 1960 (u, v).
Chromaticity<double> planckian_ucs(double kelvin, const Observer& observer);

struct ColorTemperature {
  double kelvin;    ///< 1000 to 100 000: the nearest there
  double duv;       ///< distance in (u, v), positive above the locus
  bool at_the_end;  ///< the nearest radiator is colder or hotter than that range
  bool meaningful;  ///< within it and |Duv| <= 0.05, where CIE lets the notion end
};

ColorTemperature color_temperature(const Chromaticity<double>& uv, const Observer& observer);
ColorTemperature color_temperature(const Xyz<double>& c, const Observer& observer);

}  // namespace gonio
