#pragma once
// Sums of a spectrum over an observer. They run at whole nanometres, linear between the points of each table (CIE
// 015:2018).
#include <functional>
#include <string>
#include <vector>

#include "spectrum/color.h"
#include "spectrum/spectrum.h"

namespace gonio {

/// Colour-matching functions on common wavelengths.
struct Observer {
  std::vector<double> wavelength_nm, xbar, ybar, zbar;

  double lo_nm() const { return wavelength_nm.front(); }
  double hi_nm() const { return wavelength_nm.back(); }
  Xyz<double> at(double nm) const;
};

/// What is lit and seen: a reflectance (or transmittance) factor and where it is known.
struct Factor {
  double lo_nm, hi_nm;
  std::function<double(double nm)> at;
  std::string name = "data";  ///< for messages
};

struct ColorSum {
  Xyz<double> xyz, white;  ///< Y = 100 for the perfect diffuser; white from the same sum
  double lo_nm, hi_nm;     ///< whole nanometres summed over
  double
      share_left_out;  ///< of ∫S·ȳ over the observer's range; where the light is not known its nearest value stands in
};

/// The share of ∫S·ȳ above which a sum is refused unless asked for.
inline constexpr double kMostLeftOut = 0.01;

/// Sums over the intersection of light, observer and data. InputError when nothing is common, when the light has no
/// power there, or when more than kMostLeftOut is left out and `allow_partial` is false.
ColorSum color_of(const Factor& data, const Spectrum& light, const Observer& observer, bool allow_partial = false);

/// Everything `gonio color` tells of one colour.
struct ColorValues {
  Xyz<double> xyz;
  Chromaticity<double> xy;
  Lab<double> lab;
  Luv<double> luv;
};
ColorValues color_values(const ColorSum& sum);

struct ColorDifference {
  double ab, uv, e2000;
};
ColorDifference color_difference(const ColorValues& p, const ColorValues& q);

/// XYZ of radiance spectra known at fixed wavelengths and linear between them, as one weighted sum a component:
/// X = Σ x[w]·L[w] and so on, equal to the sum at whole nanometres over the wavelengths' range, with Y = 1 for L = 1.
struct ColorWeights {
  std::vector<double> wavelength_nm, x, y, z;

  template <class T>
  Xyz<T> xyz(const T* radiance) const {
    Xyz<T> sum{T(0), T(0), T(0)};
    for (std::size_t w = 0; w < x.size(); ++w) {
      sum.x += T(x[w]) * radiance[w];
      sum.y += T(y[w]) * radiance[w];
      sum.z += T(z[w]) * radiance[w];
    }
    return sum;
  }
};

/// The weights of at least two increasing wavelengths. InputError when no whole nanometre is common with the observer.
ColorWeights color_weights(const std::vector<double>& wavelength_nm, const Observer& observer);

}  // namespace gonio
