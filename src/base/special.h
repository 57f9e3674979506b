#pragma once
// Special functions over every number type: double, float, SIMD lanes, numbers with derivatives, 50 digits (the last by
// specialisation in reference/digits50.h). Few operations, no branch per lane, no loop whose length depends on data.
//
// The scaled complementary error function and its slope come from one polynomial each in y = 2t - 1, t = K/(x + K): one
// division, no exponential. With q(x) = 1/√π - x·erfcx(x):
//   erfcx(x) = exp(x²)·erfc(x),  erfcx' = -2q,  q > 0, q → 1/(2x²√π):  nothing cancels in a derivative.
// Measured against 60 digits, x = 1e-8...1e8, 8 lanes of double / 16 of float, largest relative error:
//   erfcx 8.3e-16 / 3.3e-7, q 1.6e-15 / 6.5e-7, W0 2.8e-16 / 1.5e-7, fast_exp 4e-16 / 8.2e-8, fast_log1p 9e-16 / 2e-7; Λ beside 1 + Λ 5.3e-16 / 2.5e-7;
//   1 + 2Λ as a fraction of polynomials, in lanes, 1.8e-14 / 2e-7.
#include <array>
#include <cstdint>

#include "base/ratio.h"
#include "base/special_tables.h"

namespace gonio {

/// Σ c_k y^k, even and odd powers apart (two chains of half the length).
template <class T, class C, std::size_t N>
T polynomial(const T& y, const std::array<C, N>& c) {
  const T y2 = y * y;
  T even = T(c[(N - 1) & ~std::size_t(1)]), odd = T(c[(N - 2) | 1]);
  for (std::size_t k = (N - 1) & ~std::size_t(1); k >= 2; k -= 2) even = multiply_add(even, y2, T(c[k - 2]));
  for (std::size_t k = (N - 2) | 1; k >= 3; k -= 2) odd = multiply_add(odd, y2, T(c[k - 2]));
  return multiply_add(odd, y, even);
}

/// 2^kPower·eˣ for x well below the type's upper end (the exponent of a decay). Lanes: x = k·ln 2 + r, |r| <= ln 2/2, a polynomial
/// in r, k + kPower added to the exponent bits; never below the smallest normal number, also at -∞. Elsewhere the type's own exp.
template <int kPower, class T>
T exp_of_decay(const T& x) {
  if constexpr (is_lanes_v<T>) {
    using S = scalar_t<T>;
    constexpr bool kDouble = sizeof(S) == 8;
    using Bits = std::conditional_t<kDouble, std::int64_t, std::int32_t>;
    using BitLanes = xsimd::batch<Bits, typename T::arch_type>;
    constexpr int kMantissa = kDouble ? 52 : 23;
    const T clamped = larger_of(x, T(S((kDouble ? -708.39 : -87.33) - kPower * 0.69314718055994530942)));
    // 1.5·2^mantissa: adding it rounds to an integer, and its last bits carry kPower.
    const T shift = T((kDouble ? S(6755399441055744.0) : S(12582912.0)) + S(kPower));
    const T shifted = multiply_add(clamped, T(S(1.4426950408889634074)), shift), k = shifted - shift;
    const T minus_ln2_high = T(kDouble ? S(-0.693147180369123816490) : S(-0.693359375));
    const T minus_ln2_low = T(kDouble ? S(-1.90821492927058770002e-10) : S(2.12194440e-4));
    const T r = multiply_add(k, minus_ln2_low, multiply_add(k, minus_ln2_high, clamped));
    const T tail = [&] {
      if constexpr (kDouble)
        return polynomial(r, kExpTail);
      else
        return polynomial(r, kExpTailFloat);
    }();
    const T e = multiply_add(r * r, tail, T(T(S(1)) + r));
    return xsimd::bitwise_cast<T>(xsimd::bitwise_cast<BitLanes>(e) +
                                  (xsimd::bitwise_cast<BitLanes>(shifted) << kMantissa));
  } else {
    using std::exp;
    if constexpr (kPower == 0)
      return exp(x);
    else
      return exp(x) * T(scalar_t<T>(std::ldexp(1.0, kPower)));
  }
}

/// eˣ. Lanes: 0 below the smallest normal number, the largest one's neighbourhood above: never NaN at ±∞.
template <class T>
T fast_exp(const T& x) {
  if constexpr (is_lanes_v<T>) {
    using S = scalar_t<T>;
    constexpr bool kDouble = sizeof(S) == 8;
    return select(x < T(S(kDouble ? -708.39 : -87.33)), T(S(0)),
                  exp_of_decay<0>(smaller_of(x, T(S(kDouble ? 709.0 : 88.0)))));
  } else {
    using std::exp;
    return exp(x);
  }
}

/// ln(whole + lost), whole a positive normal number, lost far below it.
/// whole = 2ᵏ·m, m in [√½, √2), ln m = 2·atanh((m-1)/(m+1)); what was lost goes into m - 1.
template <class T>
T logarithm_in_lanes(const T& whole, const T& lost) {
  using S = scalar_t<T>;
  constexpr bool kDouble = sizeof(S) == 8;
  using Bits = std::conditional_t<kDouble, std::int64_t, std::int32_t>;
  using BitLanes = xsimd::batch<Bits, typename T::arch_type>;
  constexpr int kMantissa = kDouble ? 52 : 23;
  constexpr Bits kRootHalf = kDouble ? Bits(0x3fe6a09e667f3bcd) : Bits(0x3f3504f3);
  const BitLanes bits = xsimd::bitwise_cast<BitLanes>(whole), above = bits - BitLanes(kRootHalf);
  const BitLanes exponent = above >> kMantissa;
  const T m = xsimd::bitwise_cast<T>(bits - (exponent << kMantissa));
  const T k = xsimd::to_float(exponent), f = (m - T(S(1))) + lost, t = f / (T(S(2)) + f);
  const T series = [&] {
    if constexpr (kDouble)
      return polynomial(T(t * t), kLogarithm);
    else
      return polynomial(T(t * t), kLogarithmFloat);
  }();
  return multiply_add(k, T(S(0.69314718055994530942)), T(t * series));
}

/// ln(1 + x), x >= 0 (lanes: up to the largest number; a few last places). Elsewhere the type's own.
template <class T>
T fast_log1p(const T& x) {
  if constexpr (is_lanes_v<T>) {
    const T one = T(scalar_t<T>(1)), whole = one + x;
    return logarithm_in_lanes(whole, T(select(x < one, T(x - (whole - one)), T(scalar_t<T>(0)))));
  } else {
    using std::log1p;
    return log1p(x);
  }
}

/// ln x, x > 0 (lanes: of a normal number; about -88 or -709 at 0).
template <class T>
T fast_log(const T& x) {
  if constexpr (is_lanes_v<T>) {
    return logarithm_in_lanes(x, T(scalar_t<T>(0)));
  } else {
    using std::log;
    return log(x);
  }
}

/// 1 + 2Λ (below) and what its slope takes from it.
template <class T>
struct SmithFraction {
  Ratio<T> value;
  T s2, s, x;  ///< s² as held, its root, 1/s²
};

/// 1 + 2Λ (below) as s·E(x), E in powers of x = 1/s², with x held where E is √x to the last place that counts for S.
template <class S, class T>
SmithFraction<T> smith_fraction(const T& s2) {
  using std::sqrt;
  constexpr bool kFloat = std::is_same_v<S, float>;
  const T held = larger_of(s2, T(S(kFloat ? kSmithLeastFloat : kSmithLeast))), s = sqrt(held), x = T(S(1)) / held;
  if constexpr (kFloat)
    return {{s * polynomial(x, kSmithOverFloat), polynomial(x, kSmithUnderFloat)}, held, s, x};
  else
    return {{s * polynomial(x, kSmithOver), polynomial(x, kSmithUnder)}, held, s, x};
}

/// The functions proper; numbers with derivatives (base/dual.h, base/jet.h) and 50 digits specialise it.
template <class T>
struct Special {
  static constexpr bool kFloat = std::is_same_v<scalar_t<T>, float>;

  // t here is 1/(x + K), so y = 2K·t - 1.
  static T erfcx(const T& x) {
    const T t = T(1) / (x + T(kErfcxScale)), y = multiply_add(T(2 * kErfcxScale), t, T(-1));
    if constexpr (kFloat)
      return t * polynomial(y, kErfcxFloat);
    else
      return t * polynomial(y, kErfcx);
  }

  static T scaled_q(const T& y) {
    if constexpr (kFloat)
      return polynomial(y, kErfcxSlopeFloat);
    else
      return polynomial(y, kErfcxSlope);
  }

  static T erfcx_q(const T& x) {
    const T t = T(1) / (x + T(kErfcxScale));
    return square(t) * scaled_q(multiply_add(T(2 * kErfcxScale), t, T(-1)));
  }

  /// With v = 1/(1 + K·s) = 1 - K/(a + K): exact where s and Λ are large, and its rounding hidden by exp(-a²) where not.
  static T smith_lambda_core(const T& s) { return smith_lambda_core(s, fast_exp(T(T(-1) / square(s)))); }
  /// Lanes: a fraction. Scalars: from Λ, to the last place.
  static Ratio<T> smith_visible(const T& s2) {
    using std::sqrt;
    if constexpr (is_lanes_v<T>)
      return smith_fraction<scalar_t<T>>(s2).value;
    else
      return whole(T(T(1) + T(2) * smith_lambda_core(T(sqrt(larger_of(s2, T(1e-30)))))));
  }

  static T smith_lambda_core(const T& s, const T& exp_minus_a2) {
    const T v = T(1) / multiply_add(T(kErfcxScale), s, T(1));
    return T(0.5 / (kErfcxScale * kErfcxScale)) * s * exp_minus_a2 * square(T(1) - v) *
           scaled_q(multiply_add(T(-2), v, T(1)));
  }
};

/// erfcx(x) = exp(x²)·erfc(x), x >= 0.
template <class T>
T erfcx(const T& x) {
  return Special<T>::erfcx(x);
}

/// 1/√π - x·erfcx(x) = -erfcx'(x)/2, x >= 0, with its own relative accuracy.
template <class T>
T erfcx_q(const T& x) {
  return Special<T>::erfcx_q(x);
}

/// Smith's Λ for Gaussian slopes as a function of s = alpha·tan θ = 1/a, s > 0:
///   Λ = ½ [exp(-a²)/(a√π) - erfc(a)] = ½ s·exp(-a²)·q(a),   dΛ/ds = exp(-a²)/(2√π).
/// What counts is its error beside 1 + Λ; relative to Λ alone it loses up to 4 digits more where exp(-a²) vanishes.
template <class T>
T smith_lambda_core(const T& s) {
  return Special<T>::smith_lambda_core(s);
}

/// 1 + 2Λ of Gaussian slopes, as a fraction, from s² = alpha²·tan²θ = 1/a² >= 0:
///   1 + 2Λ = erf(a) + exp(-a²)/(a√π) = s·E(a²),  E even in a and free of cancellation,  d(1 + 2Λ)/ds = exp(-a²)/√π.
/// Smith's height-correlated G is 2/((1 + 2Λ_i) + (1 + 2Λ_o)): sums of positive terms and no exponential.
template <class T>
auto smith_visible(const T& s2) {
  return Special<T>::smith_visible(s2);
}

/// erfc(1/s), s > 0: 0 at s = 0, whatever the square of 1/s does.
template <class T>
T erfc_of_inverse(const T& s) {
  return fast_exp(T(T(-1) / square(s))) * erfcx(T(T(1) / s));
}

/// √x and its derivative, both 0 at x <= 0 (a root's slope there is no number).
template <class T>
T safe_sqrt(const T& x) {
  using std::sqrt;
  return select(x > T(0), T(sqrt(select(x > T(0), x, T(1)))), T(0));
}

/// Lambert's W0, w·eʷ = x, x >= 0: a start within 3 %, then two steps of Fritsch, Shafer & Crowley 1973 (Commun. ACM 16, 123),
/// each of fourth order.
template <class T>
T lambert_w0(const T& x) {
  using std::log, std::log1p;
  const auto positive = x > T(0);
  const T z0 = select(positive, x, T(1));
  const T logarithm = log1p(z0);
  T w = logarithm * (T(1) - log1p(logarithm) / (T(2) + logarithm));
  for (int step = 0; step < 2; ++step) {
    const T z = log(T(z0 / w)) - w, next = T(1) + w, q = T(2) * next * (next + z * (T(2) / T(3)));
    w = w * (T(1) + z / next * ((q - z) / (q - T(2) * z)));
  }
  return select(positive, w, T(0));
}

/// cosⁿθ = (1 + tan²θ)^(-n/2): keeps its accuracy for tiny tan² and large n.
template <class T>
T pow_cos(const T& tan2, const T& n) {
  using std::log1p;
  return fast_exp(T(T(-0.5) * n * log1p(tan2)));
}

}  // namespace gonio
