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
};

/// By the name an entry gives it: sellmeier, sellmeier-2, polynomial, refractiveindex-info, cauchy, gases.
inline std::optional<Dispersion> dispersion_named(std::string_view name) {
  constexpr std::string_view kNames[] = {"sellmeier", "sellmeier-2", "polynomial", "refractiveindex-info",
                                         "cauchy",    "gases"};
  for (std::size_t i = 0; i < std::size(kNames); ++i)
    if (kNames[i] == name) return static_cast<Dispersion>(i);
  return std::nullopt;
}

/// Whether the formula takes this many coefficients: c0 and whole pairs (or, for formula 4, its two groups of four
/// first).
inline bool takes_coefficients(Dispersion formula, std::size_t count) {
  if (formula == Dispersion::kRefractiveIndexInfo) return count >= 5 && count % 2 == 1 && count != 7;
  return count >= 1 && count % 2 == 1;
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
  }
  return T(0);
}

}  // namespace gonio
