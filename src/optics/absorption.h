#pragma once
// Absorption inside a medium of index n + ik (time factor e^{-iωt}): E ~ exp(-2πk·z/λ), intensity ~ exp(-4πk·z/λ).
// Maillot 1996, §I.1.2 (corrected: his skin depth is printed upside down, his conductivity in Gaussian units).
#include <cmath>

#include "base/number.h"

namespace gonio {

/// Complex refractive index n + ik.
template <class T>
struct ComplexIndex {
  T n, k;
};

/// The root of ε = ε1 + iε2 (ε2 >= 0): the larger of n, k from its root, the other from n·k = ε2/2, so that nothing
/// cancels. (0, 0) for ε = 0.
template <class T>
ComplexIndex<T> index_of_permittivity(const T& eps1, const T& eps2) {
  using std::abs, std::sqrt;
  const T larger = sqrt(T(0.5) * (sqrt(square(eps1) + square(eps2)) + abs(eps1)));
  const T smaller = select(larger > T(0), T(0.5) * eps2 / select(larger > T(0), larger, T(1)), T(0));
  return {select(eps1 >= T(0), larger, smaller), select(eps1 >= T(0), smaller, larger)};
}

/// The electric constant ε0 in F/m (CODATA 2018).
inline constexpr double kElectricConstant = 8.8541878128e-12;
/// The magnetic constant µ0 in H/m (CODATA 2018).
inline constexpr double kMagneticConstant = 1.25663706212e-6;
/// The speed of light in m/s (exact).
inline constexpr double kLightSpeed = 299792458;

/// Angular frequency in rad/s of a wavelength in vacuum.
template <class T>
T angular_frequency(const T& wavelength_nm) {
  return T(2) * kPi<T> * T(kLightSpeed) / (wavelength_nm * T(1e-9));
}

/// Index of a medium of relative permittivity eps_r and conductivity in S/m: n², k² = ½(√(ε_r² + x²) ± ε_r),
/// x = γ/(ω·ε0).
template <class T>
ComplexIndex<T> index_of_conductivity(const T& eps_r, const T& conductivity_s_per_m, const T& wavelength_nm) {
  return index_of_permittivity(eps_r,
                               T(conductivity_s_per_m / (angular_frequency(wavelength_nm) * T(kElectricConstant))));
}

/// Where the field has fallen to 1/e: λ/(2πk), in the unit of the wavelength in vacuum (infinite for k = 0). For a good
/// conductor (γ ≫ ωε) this is √(2/(ω·µ0·γ)).
template <class T>
T field_depth(const T& k, const T& wavelength) {
  return wavelength / (T(2) * kPi<T> * k);
}

/// Where the intensity has fallen to 1/e: λ/(4πk), the depth of the thesis's Table 1.
template <class T>
T intensity_depth(const T& k, const T& wavelength) {
  return wavelength / (T(4) * kPi<T> * k);
}

/// The share of intensity left after a path inside the medium: exp(-4πk·d/λ); path and wavelength in one unit.
template <class T>
T internal_transmittance(const T& k, const T& path, const T& wavelength) {
  using std::exp;
  return exp(T(-4) * kPi<T> * k * path / wavelength);
}

}  // namespace gonio
