#pragma once
#include <string_view>

#include "base/special.h"

namespace gonio {

/// Shadowing-masking functions on which papers disagree have a name each.
enum class Shadowing { none, v_cavity, smith_separable, smith_correlated, smith_1967 };

std::string_view name_of(Shadowing shadowing);
/// InputError for an unknown name.
Shadowing shadowing_from(std::string_view name);

/// V-cavity (Torrance & Sparrow 1967, Blinn 1977): G = min(1, 2 n·h n·i / i·h, 2 n·h n·o / o·h), as a fraction without a root:
/// 2 n·h/cos_d = (cos_i + cos_o)/cos²_d.
template <class T>
Ratio<T> v_cavity(const T& cos_i, const T& cos_o, const T& cos2_d) {
  return {smaller_of(cos2_d, T((cos_i + cos_o) * smaller_of(cos_i, cos_o))), cos2_d};
}

/// Smith's Λ for Gaussian slopes (Smith 1967 eq. 20-24 as in Heitz 2014), a = cot θ / alpha:
///   Λ = ½ [exp(-a²)/(a√π) - erfc(a)];  Λ → 0 at the normal, → 1/(2a√π) at grazing.
template <class T>
T smith_lambda(const T& tan2, const T& alpha) {
  using std::sqrt;
  // At the normal sqrt(0) has no derivative; from tan² = 1e-30 on Λ is 0 in every number type.
  return smith_lambda_core(T(alpha * sqrt(larger_of(tan2, T(1e-30)))));
}

/// The same as it is printed, with exp and erfc: relative error of Λ grows as 1/Λ beyond a = 2, harmless beside 1 + Λ.
template <class T>
T smith_lambda_as_printed(const T& tan2, const T& alpha) {
  using std::erfc, std::exp, std::sqrt;
  const T a = T(1) / (alpha * sqrt(larger_of(tan2, T(1e-30))));
  return larger_of(T(0), T(T(0.5) * (exp(-square(a)) / (a * kSqrtPi<T>)-erfc(a))));
}

/// Smith's original shadowing function of one direction (1967): S = (1 - ½ erfc a)/(1 + Λ).
template <class T>
T smith_1967(const T& tan2, const T& alpha) {
  using std::sqrt;
  const T s = alpha * sqrt(larger_of(tan2, T(1e-30)));
  return (T(1) - T(0.5) * erfc_of_inverse(s)) / (T(1) + smith_lambda_core(s));
}

/// Schlick 1992's rational function for smith_1967: v/(v - k·v + k), v = cos θ, k = m·√(2/π) = alpha/√π.
template <class T>
T schlick_g1(const T& cosine, const T& alpha) {
  const T k = alpha / kSqrtPi<T>;
  return cosine / (cosine - k * cosine + k);
}

/// Walter et al. 2007, eq. (27): rational function for 1/(1+Λ), a = cot θ/alpha; 1 from a = 1.6 on.
template <class T>
T walter_g1(const T& tan2, const T& alpha) {
  using std::sqrt;
  const T s = alpha * sqrt(larger_of(tan2, T(1e-30)));  // 1/a
  return select(s > T(0.625), T((T(3.535) * s + T(2.181)) / (square(s) + T(2.276) * s + T(2.577))), T(1));
}

/// G of both directions, w a pair of directions (brdf/directions.h). Separable: G1(i)·G1(o), G1 = 1/(1+Λ) = 2/(1 + (1+2Λ));
/// correlated in height: 1/(1 + Λ_i + Λ_o) = 2/((1+2Λ_i) + (1+2Λ_o)).
template <class T, class Pair>
Ratio<T> shadowing_masking(Shadowing shadowing, const Pair& w, const T& alpha) {
  const T alpha2 = square(alpha);
  switch (shadowing) {
    case Shadowing::none:
      return whole(T(1));
    case Shadowing::v_cavity:
      return v_cavity(T(w.cos_i), T(w.cos_o), T(w.cos2_d()));
    case Shadowing::smith_separable: {
      const auto i = smith_visible(T(alpha2 * w.tan2_i)), o = smith_visible(T(alpha2 * w.tan2_o));
      const auto two = i.under + i.under;
      return {T(two * (o.under + o.under)), (i.over + i.under) * (o.over + o.under)};
    }
    case Shadowing::smith_correlated: {
      const auto i = smith_visible(T(alpha2 * w.tan2_i)), o = smith_visible(T(alpha2 * w.tan2_o));
      return {T((i.under + i.under) * o.under), multiply_add(i.over, o.under, T(o.over * i.under))};
    }
    case Shadowing::smith_1967:
      return whole(T(smith_1967(T(w.tan2_i), alpha) * smith_1967(T(w.tan2_o), alpha)));
  }
  return whole(T(1));
}

}  // namespace gonio
