#pragma once
// Dispersion formulas of the refractiveindex.info database (M. N. Polyanskiy, Sci. Data 11, 94 (2024)): the refractive
// index of a transparent medium from its published coefficients. Wavelength w in µm, coefficients c0, c1, … in source
// order.
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "base/number.h"

namespace gonio {

enum class Dispersion {
  kSellmeier,            ///< formula 1: n² - 1 = c0 + Σ c_i·w²/(w² - c_{i+1}²)
  kSellmeier2,           ///< formula 2: n² - 1 = c0 + Σ c_i·w²/(w² - c_{i+1})
  kPolynomial,           ///< formula 3: n² = c0 + Σ c_i·w^c_{i+1}
  kRefractiveIndexInfo,  ///< formula 4: n² = c0 + c1·w^c2/(w² - c3^c4) + c5·w^c6/(w² - c7^c8) + Σ_{i>=9} c_i·w^c_{i+1}
  kCauchy,               ///< formula 5: n = c0 + Σ c_i·w^c_{i+1}
  kGases,                ///< formula 6: n - 1 = c0 + Σ c_i/(c_{i+1} - w^-2)
  kHerzberger,           ///< formula 7: n = c0 + c1·L + c2·L² + c3·w² + c4·w⁴ + c5·w⁶, L = 1/(w² - 0.028)
  kRetro,                ///< formula 8: (n² - 1)/(n² + 2) = c0 + c1·w²/(w² - c2) + c3·w²
  kExotic,               ///< formula 9: n² = c0 + c1/(w² - c2) + c3·(w - c4)/((w - c4)² + c5)
};

/// The names entries give the formulas, in the order of refractiveindex.info's numbers 1 to 9.
inline constexpr std::string_view kDispersionNames[] = {
    "sellmeier",  "sellmeier-2", "polynomial", "refractiveindex-info", "cauchy", "gases",
    "herzberger", "retro",       "exotic"};

inline std::optional<Dispersion> dispersion_named(std::string_view name) {
  for (std::size_t i = 0; i < std::size(kDispersionNames); ++i)
    if (kDispersionNames[i] == name) return static_cast<Dispersion>(i);
  return std::nullopt;
}

/// Whether the formula takes this many coefficients: formulas 1, 2, 3, 5, 6 c0 and whole pairs, formula 4 its two
/// groups of four first, formulas 7 to 9 a fixed number (of formula 7 those of the highest powers may be left out).
inline bool takes_coefficients(Dispersion formula, std::size_t count) {
  switch (formula) {
    case Dispersion::kRefractiveIndexInfo:
      return count >= 5 && count % 2 == 1 && count != 7;
    case Dispersion::kHerzberger:
      return count >= 3 && count <= 6;
    case Dispersion::kRetro:
      return count == 4;
    case Dispersion::kExotic:
      return count == 6;
    default:
      return count >= 1 && count % 2 == 1;
  }
}

/// Σ c_i·w^c_{i+1} from c[first] on.
template <class T>
T power_sum(std::span<const double> c, std::size_t first, const T& w) {
  using std::pow;
  T sum(0);
  for (std::size_t i = first; i + 1 < c.size(); i += 2) sum += T(c[i]) * pow(w, T(c[i + 1]));
  return sum;
}

/// n² - 1 of formulas 1 and 2; a resonance is c_{i+1} itself or its square.
template <class T>
T sellmeier_sum(std::span<const double> c, bool squared, const T& w) {
  const T w2 = square(w);
  T sum(c[0]);
  for (std::size_t i = 1; i + 1 < c.size(); i += 2) {
    const T pole = squared ? square(T(c[i + 1])) : T(c[i + 1]);
    sum += T(c[i]) * w2 / (w2 - pole);
  }
  return sum;
}

/// n² of formula 4.
template <class T>
T refractiveindex_info_sum(std::span<const double> c, const T& w) {
  using std::pow;
  T sum(c[0]);
  for (std::size_t i = 1; i + 3 < c.size() && i <= 5; i += 4)
    sum += T(c[i]) * pow(w, T(c[i + 1])) / (square(w) - pow(T(c[i + 2]), T(c[i + 3])));
  return sum + power_sum(c, 9, w);
}

/// n - 1 of formula 6.
template <class T>
T gas_sum(std::span<const double> c, const T& w) {
  const T w_2 = T(1) / square(w);
  T sum(c[0]);
  for (std::size_t i = 1; i + 1 < c.size(); i += 2) sum += T(c[i]) / (T(c[i + 1]) - w_2);
  return sum;
}

/// n of formula 7.
template <class T>
T herzberger(std::span<const double> c, const T& w) {
  const T w2 = square(w), l = T(1) / (w2 - T(0.028));
  T n = T(c[0]) + l * (T(c[1]) + T(c[2]) * l), power = w2;
  for (std::size_t i = 3; i < c.size(); ++i, power *= w2) n += T(c[i]) * power;
  return n;
}

/// n² of formula 8: (1 + 2s)/(1 - s).
template <class T>
T retro_square(std::span<const double> c, const T& w) {
  const T w2 = square(w), s = T(c[0]) + T(c[1]) * w2 / (w2 - T(c[2])) + T(c[3]) * w2;
  return (T(1) + T(2) * s) / (T(1) - s);
}

/// n² of formula 9.
template <class T>
T exotic_square(std::span<const double> c, const T& w) {
  const T d = w - T(c[4]);
  return T(c[0]) + T(c[1]) / (square(w) - T(c[2])) + T(c[3]) * d / (square(d) + T(c[5]));
}

/// The refractive index at a wavelength in µm (> 0). Not a number where the formula has no real root: outside its
/// range, which the caller knows. Requires takes_coefficients(formula, c.size()).
template <class T>
T refractive_index(Dispersion formula, std::span<const double> c, const T& wavelength_um) {
  using std::sqrt;
  switch (formula) {
    case Dispersion::kSellmeier:
      return sqrt(T(1) + sellmeier_sum(c, true, wavelength_um));
    case Dispersion::kSellmeier2:
      return sqrt(T(1) + sellmeier_sum(c, false, wavelength_um));
    case Dispersion::kPolynomial:
      return sqrt(T(c[0]) + power_sum(c, 1, wavelength_um));
    case Dispersion::kRefractiveIndexInfo:
      return sqrt(refractiveindex_info_sum(c, wavelength_um));
    case Dispersion::kCauchy:
      return T(c[0]) + power_sum(c, 1, wavelength_um);
    case Dispersion::kGases:
      return T(1) + gas_sum(c, wavelength_um);
    case Dispersion::kHerzberger:
      return herzberger(c, wavelength_um);
    case Dispersion::kRetro:
      return sqrt(retro_square(c, wavelength_um));
    case Dispersion::kExotic:
      return sqrt(exotic_square(c, wavelength_um));
  }
  return T(0);
}

}  // namespace gonio
