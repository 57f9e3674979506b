#pragma once
// The diffraction series in SIMD lanes: every lane its own g and b, no loop whose length depends on them.
#include <bit>
#include <utility>

#include "base/one_loop.h"
#include "base/special.h"
#include "brdf/poisson_series.h"
#include "brdf/poisson_tables.h"

namespace gonio {

/// Two ways to sum, by the index X of the largest term, X²·ln(X/g) = b, c = ln(X/g):
///   X < least, or terms too narrow for an integral (X/(1 + 2c), their squared standard deviation, below `narrowest`):
///           the first `few`, `some` or `most` terms, which leave out less than `left_out` of the sum up to X = `few_to`, `some_to`, `least`;
///   above   Laplace's estimate of the integral times a polynomial in 1/X and 1/√(1 + spread·c), which holds what the estimate lacks.
///           The sum differs from its integral by 2·exp(-2π²·narrowest) at most (Poisson's summation formula).
/// Where terms are narrow and X is beyond `most` the sum lies below the range of S.
/// Largest relative errors over g = 1e-8…1e6 and every b (tests/brdf/poisson_lanes_test.cpp): 4e-11 in double, 9e-6 in float.
template <class S>
struct LaneSeries {
  static constexpr double least = 25.6, narrowest = 1.4, left_out = 2e-11, spread = 9, largest_log = 32;
  static constexpr int few = 24, some = 44, most = 64;
  static constexpr double few_to = 4.95, some_to = 14.2, largest_c = 14.2;
};
template <>
struct LaneSeries<float> {
  static constexpr double least = 11.9, narrowest = 0.8, left_out = 1e-6, spread = 10, largest_log = 17;
  static constexpr int few = 14, some = 22, most = 30;
  static constexpr double few_to = 3.57, some_to = 7.4, largest_c = 7;
};

/// 2^t for t <= 100, 0 far below.
template <class V>
V exp2_of(const V& t) {
  using S = scalar_t<V>;
  constexpr bool kDouble = sizeof(S) == 8;
  const auto of_rest = [](const V& r) {
    if constexpr (kDouble)
      return polynomial(r, kExp2);
    else
      return polynomial(r, kExp2Float);
  };
#ifdef __AVX512DQ__
  if constexpr (sizeof(V) == 64 && kDouble)
    return _mm512_scalef_pd(of_rest(V(_mm512_reduce_pd(t, 0))), _mm512_roundscale_pd(t, 0));
  if constexpr (sizeof(V) == 64 && !kDouble)
    return _mm512_scalef_ps(of_rest(V(_mm512_reduce_ps(t, 0))), _mm512_roundscale_ps(t, 0));
#endif
  using Bits = std::conditional_t<kDouble, std::int64_t, std::int32_t>;
  using BitLanes = xsimd::batch<Bits, typename V::arch_type>;
  const V held = larger_of(t, V(S(kDouble ? -1021 : -125))), shift = V(kDouble ? S(6755399441055744.0) : S(12582912.0));
  const V shifted = held + shift;
  return xsimd::bitwise_cast<V>(xsimd::bitwise_cast<BitLanes>(of_rest(V(held - (shifted - shift)))) +
                                (xsimd::bitwise_cast<BitLanes>(shifted) << (kDouble ? 52 : 23)));
}

/// 2^k for whole numbers k within the range of S.
template <class V>
V power_of_two(const V& k) {
  using S = scalar_t<V>;
  constexpr bool kDouble = sizeof(S) == 8;
  using Bits = std::conditional_t<kDouble, std::int64_t, std::int32_t>;
  using BitLanes = xsimd::batch<Bits, typename V::arch_type>;
  const V shifted = k + V(kDouble ? S(6755399441055744.0) : S(12582912.0));
  return xsimd::bitwise_cast<V>(xsimd::bitwise_cast<BitLanes>(V(S(1))) +
                                (xsimd::bitwise_cast<BitLanes>(shifted) << (kDouble ? 52 : 23)));
}

/// Σ c_ak t^a s^k.
template <class T, class C, std::size_t A, std::size_t K>
T polynomial(const T& t, const T& s, const std::array<std::array<C, K>, A>& c) {
  T sum = polynomial(s, c[A - 1]);
  for (std::size_t a = A - 1; a > 0; --a) sum = multiply_add(sum, t, polynomial(s, c[a - 1]));
  return sum;
}

/// A function's value as T, with the derivatives that x has, slope times.
template <class T, class V>
T with_slope(const T& x, const V& value, const V& slope) {
  if constexpr (std::is_same_v<T, V>)
    return value;
  else
    return chain(x, value, slope);
}

/// Where the terms peak; from c = `largest_c` on (l = ln(1 + 2b/g²) is held at `largest_log`) c and X are too small.
template <class T>
struct SeriesPeak {
  T x, c, above;  ///< X, ln(X/g), X/g - 1
};

template <class T>
SeriesPeak<T> series_peak(const T& g, const T& b) {
  // 2c = W(2b/g²), Lambert's: a fraction in l, then one step of Newton's method (float) or Halley's for c = b/X².
  using V = std::remove_cvref_t<decltype(value_of(g))>;
  using S = scalar_t<V>;
  const auto all = [](double x) { return V(S(x)); };
  const T inverse_g = V(S(1)) / g, q = (b + b) * inverse_g * inverse_g;
  const V g0 = value_of(g), b0 = value_of(b), one = all(1);
  const V l = smaller_of(fast_log1p(smaller_of(value_of(q), all(1e30))), all(LaneSeries<S>::largest_log));
  const V w = [&] {
    if constexpr (std::is_same_v<S, float>)
      return V(l * polynomial(l, kLambertOverFloat) / polynomial(l, kLambertUnderFloat));
    else
      return V(l * polynomial(l, kLambertOver) / polynomial(l, kLambertUnder));
  }();
  const V c0 = all(0.5) * w;
  // e^c and e^c - 1, each to its last places.
  const V k = xsimd::nearbyint(V(c0 * all(1.4426950408889634))), power = power_of_two(k);
  constexpr bool kFloat = std::is_same_v<S, float>;
  const V high = all(kFloat ? -0.693359375 : -0.693147180369123816490),
          small = all(kFloat ? 2.12194440e-4 : -1.90821492927058770002e-10);
  const V r = multiply_add(k, small, multiply_add(k, high, c0));
  const V tail = [&] {
    if constexpr (kFloat)
      return polynomial(r, kExpTailFloat);
    else
      return polynomial(r, kExpTail);
  }();
  const V rest = r * multiply_add(r, tail, one), grown = multiply_add(power, rest, power),
          z0 = multiply_add(power, rest, V(power - one));
  // Held: where l has ended, or g² is out of range, anything may come.
  const V x0 = g0 * grown, x2 = square(x0), inverse = one / (x2 * (one + w)),
          newton = smaller_of(V(multiply_add(V(-c0), x2, b0) * inverse), all(0.01)),
          step =
              kFloat ? newton : V(newton * multiply_add(V(-newton), multiply_add(x2, inverse, one), one)),  // Halley's
      more = step * multiply_add(all(0.5), step, one);
  const V c = c0 + step, z = multiply_add(grown, more, z0), growth = one + z;
  const T peak_c = with_slope(q, c, V(all(0.5) / (square(growth) * multiply_add(all(2), c, one))));
  const T above = with_slope(peak_c, z, growth);
  return {multiply_add(g, above, g), peak_c, above};
}

/// The first kTerms terms: exp(-b/j) for the upper half, the lower ones their squares, by Horner's rule in g.
template <int kTerms, class T>
T sum_of_first(const T& g, const T& b) {
  using V = std::remove_cvref_t<decltype(value_of(g))>;
  using S = scalar_t<V>;
  constexpr int kHalf = kTerms / 2;
  const T minus_b = T(V(S(kSeriesShift))) - b * V(S(1.4426950408889634074));
  std::array<T, kHalf + 1> even;
  const auto weight = [](int j) { return V(kSeriesWeight<S>[std::size_t(j)]); };
  T sum = T(V(S(0)));
#pragma GCC unroll 64
  for (int j = kTerms; j > kHalf; --j) {
    const T t = minus_b * V(kSeriesInverse<S>[std::size_t(j)]);
    const V e = exp2_of(value_of(t));
    const T term = with_slope(t, e, V(V(S(0.69314718055994530942)) * e));
    if (j % 2 == 0) even[std::size_t(j / 2)] = term;
    sum = multiply_add(sum, g, term * weight(j));
  }
#pragma GCC unroll 64
  for (int j = kHalf; j >= 1; --j) {
    const T term = square(even[std::size_t(j)]);
    if (j % 2 == 0) even[std::size_t(j / 2)] = term;
    sum = multiply_add(sum, g, term * weight(j));
  }
  return g * exp_of_decay<0>(T(-g)) * sum;
}

/// Laplace's estimate, mended: exp(-[2c·X - X + g])/(X·√(1 + 2c))·H.
template <class T>
T sum_by_bell(const T& g, const T& b, const SeriesPeak<T>& peak) {
  using std::sqrt;
  using V = std::remove_cvref_t<decltype(value_of(g))>;
  using S = scalar_t<V>;
  const auto all = [](double x) { return V(S(x)); };
  const V one = all(1);
  const T wide = sqrt(one + peak.c * all(2)), spread = sqrt(one + peak.c * all(LaneSeries<S>::spread)),
          product = wide * spread, inverse = one / (peak.x * product), y = product * inverse;
  const T s = wide * peak.x * inverse * all(2) - T(one), t = y * all(2 * LaneSeries<S>::least) - T(one);
  const T fall = multiply_add(g, multiply_add(peak.above, T(peak.c - T(one)), peak.c), T(b * y));
  const T lacks = [&] {
    if constexpr (std::is_same_v<S, float>)
      return polynomial(t, s, kSeriesBellFloat);
    else
      return polynomial(t, s, kSeriesBell);
  }();
  return exp_of_decay<kSeriesPower>(T(-fall)) * (spread * inverse) * (one + y * lacks);
}

/// Whether a lane takes the terms, and the X up to which it needs them (0 where it does not).
template <class V>
struct SeriesChoice {
  decltype(V() < V()) low;
  V reach;
};
template <class T>
auto series_choice(const SeriesPeak<T>& peak) {
  const auto x = value_of(peak.x), c = value_of(peak.c);
  using V = std::remove_cvref_t<decltype(x)>;
  using Rule = LaneSeries<scalar_t<V>>;
  const auto all = [](double value) { return V(scalar_t<V>(value)); };
  const auto low = x < larger_of(all(Rule::least), V(all(Rule::narrowest) * multiply_add(all(2), c, all(1))));
  return SeriesChoice<V>{low, select(low, select(c > all(Rule::largest_c), all(Rule::least), x), all(0))};
}

/// As many terms as the lane of the largest X needs.
template <class T, class V>
T sum_of_terms(const T& g, const T& b, const V& reach) {
  using Rule = LaneSeries<scalar_t<V>>;
  const auto beyond = [&](double x) { return any(reach > V(scalar_t<V>(x))); };
  if (!beyond(Rule::few_to)) return sum_of_first<Rule::few>(g, b);
  if (!beyond(Rule::some_to)) return sum_of_first<Rule::some>(g, b);
  return sum_of_first<Rule::most>(g, b);
}

/// 2^kSeriesPower times Σ_{j>=1} Pois(j; g)/j·exp(-b/j): see poisson_series.h, whose sum in 50 digits judges this one.
template <class T>
T poisson_lobe_sum_in_lanes(const T& g, const T& b) {
  const SeriesPeak<T> peak = series_peak(g, b);
  const auto [low, reach] = series_choice(peak);
  if (!any(low)) return sum_by_bell(g, b, peak);
  const T terms = sum_of_terms(T(select(low, g, T(1))), b, reach);
  return xsimd::all(low) ? terms : select(low, terms, sum_by_bell(g, b, peak));
}

/// The lanes chosen, side by side at `to` (room for a whole batch); how many.
template <class V, class Mask>
std::size_t pack(const Mask& chosen, const V& x, scalar_t<V>* to) {
  using S = scalar_t<V>;
#ifdef __AVX512F__
  if constexpr (sizeof(V) == 64) {
    if constexpr (sizeof(S) == 8)
      V(_mm512_maskz_compress_pd(chosen.data, x)).store_unaligned(to);
    else
      V(_mm512_maskz_compress_ps(chosen.data, x)).store_unaligned(to);
    return std::size_t(std::popcount(chosen.data));
  }
#endif
  std::array<S, V::size> all;
  x.store_unaligned(all.data());
  std::array<bool, V::size> takes;
  chosen.store_unaligned(takes.data());
  std::size_t count = 0;
  for (std::size_t lane = 0; lane < V::size; ++lane) to[count] = all[lane], count += takes[lane];
  return count;
}
/// Back from there, the other lanes as they were.
template <class V, class Mask>
std::size_t unpack(const Mask& chosen, const scalar_t<V>* from, V& x) {
  using S = scalar_t<V>;
#ifdef __AVX512F__
  if constexpr (sizeof(V) == 64) {
    if constexpr (sizeof(S) == 8)
      x = _mm512_mask_expand_pd(x, chosen.data, V::load_unaligned(from));
    else
      x = _mm512_mask_expand_ps(x, chosen.data, V::load_unaligned(from));
    return std::size_t(std::popcount(chosen.data));
  }
#endif
  std::array<S, V::size> all;
  x.store_unaligned(all.data());
  std::array<bool, V::size> takes;
  chosen.store_unaligned(takes.data());
  std::size_t count = 0;
  for (std::size_t lane = 0; lane < V::size; ++lane)
    if (takes[lane]) all[lane] = from[count++];
  x = V::load_unaligned(all.data());
  return count;
}

/// The same of many: short loops, which a machine that runs ahead overlaps, and the terms of those lanes alone that take them.
template <class V, std::size_t N>
GONIO_ONE_LOOP void poisson_lobe_sums(const std::array<V, N>& g, const std::array<V, N>& b, std::array<V, N>& sum) {
  using S = scalar_t<V>;
  std::array<SeriesPeak<V>, N> peak;
  for (std::size_t i = 0; i < N; ++i) peak[i] = series_peak(g[i], b[i]);

  std::array<S, (N + 1) * V::size> low_g, low_b, low_reach;
  std::array<decltype(V() < V()), N> low;
  std::size_t count = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const SeriesChoice<V> choice = series_choice(peak[i]);
    low[i] = choice.low;
    pack(low[i], b[i], low_b.data() + count), pack(low[i], choice.reach, low_reach.data() + count);
    count += pack(low[i], g[i], low_g.data() + count);
  }
  for (std::size_t i = 0; i < N; ++i)
    if (!xsimd::all(low[i])) sum[i] = sum_by_bell(g[i], b[i], peak[i]);
  if (count == 0) return;

  const auto fill = [&](std::array<S, (N + 1) * V::size>& all, S with) { V(with).store_unaligned(all.data() + count); };
  fill(low_g, S(1)), fill(low_b, S(0)), fill(low_reach, S(0));
  for (std::size_t at = 0; at < count; at += V::size) {
    const auto load = [at](const auto& all) { return V::load_unaligned(all.data() + at); };
    sum_of_terms(load(low_g), load(low_b), load(low_reach)).store_unaligned(low_g.data() + at);
  }
  for (std::size_t i = 0, at = 0; i < N; ++i) at += unpack(low[i], low_g.data() + at, sum[i]);
}

/// Sums of the series times their scales: what a diffracting lobe is made of.
template <class T>
struct DiffractionSeries {
  T g, b, scale;
};

/// scale times the series, by the method that suits the number type: in lanes the one above, else poisson_lobe_sum.
template <class T>
T value_of_series(const DiffractionSeries<T>& series) {
  const auto& [g, b, scale] = series;
  using V = std::remove_cvref_t<decltype(value_of(g))>;
  if constexpr (is_lanes_v<V>) {
    const V half = V(scalar_t<V>(std::ldexp(1.0, -kSeriesPower / 2)));
    return poisson_lobe_sum_in_lanes(g, b) * half * scale * half;
  } else {
    return poisson_lobe_sum(g, b, scale);
  }
}

}  // namespace gonio
