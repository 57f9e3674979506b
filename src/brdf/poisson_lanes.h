#pragma once
// The diffraction series in SIMD lanes: every lane its own g and b, one loop for all of them.
#include <utility>

#include "base/special.h"
#include "brdf/poisson_series.h"
#include "brdf/poisson_tables.h"

namespace gonio {

/// Two ways to sum, by the index X of the largest term:
///   X < turn  term by term from j = 1, the weights by their recurrence; so too where the terms are `narrowest` or less
///             (squared standard deviation X/(1 + 2c)), and the sum is no integral;
///   above     the trapezoidal rule in √x, x = X(1 + δ)², `before` + `after` + 1 nodes `step` standard deviations apart. In √x a
///             term is nearly Gaussian for every b: by Poisson's summation formula the rule loses about 2·exp(-2π²/step²).
/// What is left out lies below `cut` of the sum.
template <class S>
struct LaneSeries {
  static constexpr double turn = 32, narrowest = 1.8, step = 0.86, cut = 1e-12;
  static constexpr int before = 10, after = 8;  ///< nodes on either side of X
  static constexpr int power =
      90;  ///< the sum is 2^power times as large, and keeps the tails that a prefactor of 1e24 brings back
};
template <>
struct LaneSeries<float> {
  static constexpr double turn = 18, narrowest = 0.8, step = 1.2, cut = 2e-7;
  static constexpr int before = 5, after = 4, power = 90;
};

/// Where the terms peak, X: X²·ln(X/g) = b; and c = ln(X/g), offset = X - g. Any X near the peak will do.
template <class V>
struct SeriesPeak {
  V x, c, offset;
};

template <class V>
SeriesPeak<V> series_peak(const V& g, const V& b) {
  // X = g·exp(W(2b/g²)/2), W Lambert's by Winitzki's approximation (2 %), rounded to an X of which c and X - g are exact.
  using S = scalar_t<V>;
  const auto all = [](double x) { return V(S(x)); };
  const V l = fast_log1p(smaller_of(V(all(2) * b / square(g)), all(1e30)));
  const V z = fast_exp(V(all(0.5) * l * (all(1) - fast_log1p(l) / (all(2) + l)))) - all(1);
  return {multiply_add(g, z, g), fast_log1p(z), g * z};
}

/// Σ_{j>=1}, term by term up to the last one that counts in any lane where `here`: Pois(j; g)/j by its recurrence, times exp(-b/j), each
/// with half of the power. `T` carries derivatives, if any.
template <class T, class V>
T sum_by_terms(const T& g, const T& b, const V& peak, const decltype(V(0) < V(1))& here) {
  using S = scalar_t<V>;
  constexpr int kHalf = LaneSeries<S>::power / 2;
  const V most = select(here, peak, V(S(0)));
  T weight = g * exp_of_decay<kHalf>(T(-g)), sum = weight * exp_of_decay<kHalf>(T(-b));
  const T minus_b = -b;
  for (int j = 2; j < kSeriesTable; ++j) {
    weight = weight * (g * T(kSeriesStep<S>[std::size_t(j)]));
    const T term = weight * exp_of_decay<kHalf>(T(minus_b * T(kSeriesInverse<S>[std::size_t(j)])));
    sum += term;
    if ((j & 3) == 0 && !any(here && (V(S(j)) < most || value_of(term) > V(S(LaneSeries<S>::cut)) * value_of(sum))))
      break;
  }
  return sum;
}

/// u·ln u - u + 1, u = (1+δ)², δ = -0.86…0.72 (float -0.84…0.75): what a term loses by it is below 2e-12 (5.3e-7) of the largest,
/// for every X >= turn.
template <class V>
V deviance_of_root(const V& delta) {
  if constexpr (std::is_same_v<scalar_t<V>, float>)
    return square(delta) * polynomial(delta, kDevianceFloat);
  else
    return square(delta) * polynomial(delta, kDeviance);
}

/// The trapezoidal rule about X. At x = X·u, u = (1+δ)², dx = 2X(1+δ)dδ, the logarithm of a term is, beside constants,
///   -X·[u·ln u - u + 1 + c·u] - b/x - stirling(x) - 1.5·ln x + (X - g).
template <class T, class V>
T sum_by_nodes(const T& g, const T& b, const SeriesPeak<V>& peak) {
  using std::sqrt;
  using S = scalar_t<V>;
  using Rule = LaneSeries<S>;
  const auto all = [](double x) { return V(S(x)); };
  const V g0 = value_of(g), b0 = value_of(b), one = all(1), inverse = one / peak.x, inverse2 = square(inverse),
          tilt = b0 * inverse2;
  const V step = all(0.5 * Rule::step) * sqrt(inverse / (one + all(2) * tilt));  // of δ, half of that of x/X
  const V s1 = multiply_add(b0, inverse, inverse * all(1.0 / 12)), s3 = inverse * inverse2 * all(-1.0 / 360),
          s5 = s3 * inverse2 * all(-2.0 / 7);
  T sum = T(S(0));
  for (int k = -Rule::before; k <= Rule::after; ++k) {
    const V delta = all(k) * step, root = one + delta, u = square(root), r = one / u;
    V whole = s1;  // of b/x + stirling(x)
    if constexpr (!std::is_same_v<S, float>) whole = multiply_add(square(r), multiply_add(square(r), s5, s3), s1);
    const V fall =
        multiply_add(peak.x, multiply_add(peak.c, u, deviance_of_root(delta)), multiply_add(r, whole, V(-peak.offset)));
    if constexpr (std::is_same_v<T, V>) {
      sum += r * exp_of_decay<Rule::power>(V(-fall));
    } else {  // the nodes and X carry no derivatives: g and b do
      const T moved = T(peak.x * u / g0 - one) * (g - T(g0)) - (b - T(b0)) * T(r * inverse);
      sum += T(r) * exp_of_decay<Rule::power>(T(moved - T(fall)));
    }
  }
  return T(all(2 * 0.39894228040143267794) * step * sqrt(inverse)) * sum;
}

/// 2^LaneSeries::power times Σ_{j>=1} Pois(j; g)/j·exp(-b/j): see poisson_series.h, whose sum in 50 digits judges this one.
template <class T>
T poisson_lobe_sum_in_lanes(const T& g, const T& b) {
  const auto peak = series_peak(value_of(g), value_of(b));
  using V = std::remove_cvref_t<decltype(peak.x)>;
  using Rule = LaneSeries<scalar_t<V>>;
  const V widest = V(scalar_t<V>(1)) + peak.c + peak.c;
  const auto low = peak.x < larger_of(V(scalar_t<V>(Rule::turn)), V(V(scalar_t<V>(Rule::narrowest)) * widest));
  if (!any(low)) return sum_by_nodes(g, b, peak);
  const T terms = sum_by_terms(g, b, peak.x, low);
  return xsimd::all(low) ? terms : select(low, terms, sum_by_nodes(g, b, peak));
}

/// scale times the series, by the method that suits the number type: in lanes the one above, else poisson_lobe_sum.
template <class T>
T diffraction_series(const T& g, const T& b, const T& scale) {
  using V = std::remove_cvref_t<decltype(value_of(g))>;
  if constexpr (is_lanes_v<V>) {
    const T half = T(scalar_t<V>(std::ldexp(1.0, -LaneSeries<scalar_t<V>>::power / 2)));
    return poisson_lobe_sum_in_lanes(g, b) * half * scale * half;
  } else {
    return poisson_lobe_sum(g, b, scale);
  }
}

}  // namespace gonio
