#pragma once
#include "base/number.h"

namespace gonio {

/// How far the series below is summed, by number type: terms under `cut` of the sum end it; from peak `coarse_from` on the
/// nodes are `step` standard deviations apart. tests/brdf/poisson_series_test.cpp shows the error on both sides of each.
template <class T>
struct SeriesPrecision {
  static constexpr double cut = 1e-18, coarse_from = 48, step = 0.65;
};
template <>
struct SeriesPrecision<float> {
  static constexpr double cut = 1e-9, coarse_from = 24, step = 0.9;
};

/// ln Γ(x+1) - (x+½) ln x + x - ½ ln 2π (Loader's stirlerr), x >= 1, absolute error a few roundings.
/// De Moivre's series from x = 8; below, Γ's recurrence carries x there.
template <class T>
T stirling_error(const T& x) {
  using std::log;
  const T y = select(x < T(8), x + T(7), x);
  const T r = T(1) / y, r2 = square(r);
  const T series =
      r * (T(1) / T(12) -
           r2 * (T(1) / T(360) -
                 r2 * (T(1) / T(1260) -
                       r2 * (T(1) / T(1680) -
                             r2 * (T(1) / T(1188) -
                                   r2 * (T(691) / T(360360) - r2 * (T(1) / T(156) - r2 * (T(3617) / T(122400)))))))));
  const T product = (x + T(1)) * (x + T(2)) * (x + T(3)) * (x + T(4)) * (x + T(5)) * (x + T(6)) * (x + T(7));
  return series + select(x < T(8), (y + T(0.5)) * log(y) - (x + T(0.5)) * log(x) - T(7) - log(product), T(0));
}

/// x ln(x/g) + g - x without cancellation at x ≈ g (Loader 2000): with d = x - g, v = d/(x+g),
///   d·v + 2x(v³/3 + v⁵/5 + …).
/// d comes beside x: for g ≫ 1 the two are known better than their difference.
template <class T>
T poisson_deviance(const T& x, const T& d, const T& g) {
  using std::abs, std::log;
  const T v = d / (x + g), v2 = square(v);
  T odd(0);
  for (int n = 25; n >= 3; n -= 2) odd = T(1) / T(n) + v2 * odd;
  return select(abs(v) < T(0.25), d * v + T(2) * x * v * v2 * odd, x * log(x / g) - d);
}

/// One term of the series at a real index x = g + d >= 1: Pois(x; g)/x · exp(-b/x), from its logarithm; 2⁶⁰ times as large, and the
/// exponential in two halves, so that in float a term is still there down to 1e-56: what multiplies the sum may be 1e24.
template <class T>
T poisson_lobe_term(const T& x, const T& d, const T& g, const T& b) {
  using std::exp, std::sqrt;
  const T half = T(0x1p30) * exp(T(-0.5) * (stirling_error(x) + poisson_deviance(x, d, g) + b / x));
  return half / (x * sqrt(T(2) * kPi<T> * x)) * half;
}

/// Where the terms peak, less g: x² ln(x/g) = b, x = g·exp(W(2b/g²)/2), W Lambert's (Winitzki's approximation, 2 %: only
/// the placing of the nodes depends on it).
template <class T>
T poisson_lobe_peak_offset(const T& g, const T& b) {
  using std::exp, std::expm1, std::log, std::log1p;
  // Smooth surfaces far from the mirror direction: 2b/g² leaves every range (1e60 and more), its logarithm does not.
  const T log_g = log(g), q = T(2) * b / g / g;
  const auto huge = q > T(1e12);
  const T l = select(huge, T(log(select(huge, T(T(2) * b), T(1))) - T(2) * log_g), T(log1p(select(huge, T(0), q))));
  const T half_w = T(0.5) * l * (T(1) - log1p(l) / (T(2) + l));
  return select(huge, T(exp(half_w + log_g) - g), T(g * expm1(select(huge, T(0), half_w))));
}

/// scale · Σ_{j>=1} Pois(j; g)/j · exp(-b/j): the diffraction series of Beckmann & Spizzichino 1963 (Maillot 1996 eq. (18a)),
/// g > 0, b = v_xy²T²/4 >= 0.
///
/// Summed from the largest term outwards until the rest is below the number type's precision. Where the terms are broad
/// (peak far from 1) they are samples of a smooth bell, and by Poisson's summation formula the trapezoidal rule over it
/// keeps its accuracy with steps longer than 1: relative error about 2·exp(-2π²/step²), at any g, and also in the tails,
/// since the nodes follow the peak of the whole term, not of the Poisson weights.
template <class T>
T poisson_lobe_sum(const T& g, const T& b, const T& scale = T(1)) {
  using std::floor, std::sqrt;
  using Precision = SeriesPrecision<scalar_t<T>>;
  const auto g0 = value_of(g), b0 = value_of(b);
  using V = std::remove_cvref_t<decltype(g0)>;
  const V offset = poisson_lobe_peak_offset(g0, b0), peak = larger_of(V(g0 + offset), V(1));
  const V deviation = V(1) / sqrt(V(1) / peak + V(2) * b0 / (peak * peak * peak));
  const auto coarse = peak > V(Precision::coarse_from);
  const V step = select(coarse, larger_of(V(Precision::step) * deviation, V(1)), V(1));
  const V middle = select(coarse, offset, V(V(floor(peak + V(0.5))) - g0));  // the central node, less g
  // The nodes carry no derivatives; g does: its own are in x - g.
  const T shift = T(g0) - g;
  const auto term = [&](const V& d) { return poisson_lobe_term(T(larger_of(V(g0 + d), V(1))), T(T(d) + shift), g, b); };

  T sum = term(middle);
  for (int side = 0; side < 2; ++side) {
    const V stride = side == 0 ? step : V(-step);
    T last = sum;
    for (V d = middle + stride;; d += stride) {
      const auto inside = g0 + d >= V(0.5);
      if (!any(inside)) break;
      last = select(inside, term(d), T(0));
      sum += last;
      if (!any(value_of(last) > V(Precision::cut) * value_of(sum))) break;
    }
  }
  return T(step) * sum * T(0x1p-30) * scale * T(0x1p-30);
}

}  // namespace gonio
