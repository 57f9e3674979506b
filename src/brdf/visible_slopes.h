#pragma once
#include "base/special.h"

namespace gonio {

// How a facet's slopes are drawn in proportion to their area as seen by the eye. Directions are stretched by the widths along and
// across the grain, so that the law of slopes is round: a facet of slopes (x, y), x towards the eye, is seen with o_z + κ·x, where κ is the
// length of the eye's stretched components in the mean plane. Nothing here branches on a number.

/// Sine and cosine together.
template <class T>
struct SineCosine {
  T sine, cosine;
};
template <class T>
SineCosine<T> sine_cosine(const T& x) {
  if constexpr (is_lanes_v<T>) {
    const auto both = xsimd::sincos(x);
    return {both.first, both.second};
  } else {
    using std::cos, std::sin;
    return {T(sin(x)), T(cos(x))};
  }
}

// sin(πt/2)/t and cos(πt/2) in powers of t², |t| <= ½: least-maximum fits, 5e-16 and 4e-9, 6e-11.
inline constexpr std::array<double, 8> kQuarterSine{1.570796326794897,     -0.6459640975062628,   0.07969262624683066,
                                                    -0.004681754147534543, 0.0001604413020599181, -3.599457018239261e-6,
                                                    5.8575083132813916e-8, -2.45414225825445e-9};
inline constexpr std::array<double, 8> kQuarterCosine{
    1.0000000000000002,    -1.233700550136187,    0.2536695079018166,   -0.02086348077805528,
    0.0009192604184110533, -2.520279097227507e-5, 4.730689917912139e-7, -8.46084161077494e-9};
inline constexpr std::array<float, 4> kQuarterSineFloat{1.5707963217F, -0.6459634602F, 0.0796800325F, -0.0046016571F};
inline constexpr std::array<float, 5> kQuarterCosineFloat{0.9999999999F, -1.2337005396F, 0.2536691826F, -0.0208599360F,
                                                          0.0009033630F};

/// Of 2πu, 0 <= u <= 1.
template <class T>
SineCosine<T> sine_cosine_of_turn(const T& u) {
  if constexpr (is_lanes_v<T>) {
    using S = scalar_t<T>;
    const T quarters = T(S(4)) * u, k = xsimd::nearbyint(quarters), t = quarters - k, t2 = square(t);
    SineCosine<T> near;
    if constexpr (std::is_same_v<S, float>)
      near = {t * polynomial(t2, kQuarterSineFloat), polynomial(t2, kQuarterCosineFloat)};
    else
      near = {t * polynomial(t2, kQuarterSine), polynomial(t2, kQuarterCosine)};
    // k = 0…4: the quarter turns, of which 1 and 3 exchange the two.
    const auto odd = k == T(S(1)) || k == T(S(3));
    const T sine = select(odd, near.cosine, near.sine), cosine = select(odd, near.sine, near.cosine);
    const auto second = k == T(S(2)), third = k == T(S(3));
    return {select(second || third, T(-sine), sine), select(k == T(S(1)) || second, T(-cosine), cosine)};
  } else {
    return sine_cosine(T(T(2) * kPi<T> * u));
  }
}

/// Steps that take the solvers below from their starts to the number type's precision.
template <class T>
inline constexpr bool kSinglePrecision = std::is_same_v<scalar_t<T>, float>;

/// The azimuth ψ from the eye's of a facet of a V-cavity whose slopes have length r, e = r·κ/o_z. A facet and the opposite one cover the
/// cavity's opening, so that the eye sees max(0, 1 + e·cos ψ) of one to max(0, 1 - e·cos ψ) of the other (Heitz & d'Eon 2014, EGSR,
/// sec. 4.2); instead of drawing and flipping, ψ has the density min(2, max(0, 1 + e·cos ψ))/(2π), continuous in u. With M = π|2u - 1|:
///   2ψ = M                              while e·cos(M/2) > 1 (the facet alone is seen),
///   x - e₁·sin x + s·(1 - cos x) = π - M, x = π - ψ₁ - ψ, e₁ = min(e, 1), s = √(e² - 1) or 0, ψ₁ = acos(1/e) or 0,
/// Kepler's equation where e <= 1. Halley's steps from a start that follows its linear, square and cubic parts: the error of the
/// share is 5e-8 after two steps, 3e-16 after three (tests/brdf/visible_slopes_test.cpp).
template <class T>
SineCosine<T> cavity_azimuth(const T& e, const T& u) {
  using std::cbrt, std::sqrt;
  const T rest = larger_of(T(T(2) * kPi<T> * smaller_of(u, T(T(1) - u))), T(1e-9));  // π - M
  const T e1 = smaller_of(e, T(1)), s = sqrt(larger_of(T((e - T(1)) * (e + T(1))), T(0)));
  const T over = T(1) / rest, linear = (T(1) - e1) * over, half_square = T(0.5) * s * over;
  T x = T(1) / cbrt(T(e1 * over / T(6) + square(linear) * linear + half_square * sqrt(half_square)));
  x = smaller_of(x, kPi<T>);
  for (int step = 0; step < (kSinglePrecision<T> ? 2 : 3); ++step) {
    const SineCosine<T> half = sine_cosine(T(T(0.5) * x));
    const T versine = T(2) * square(half.sine), sine = T(2) * half.sine * half.cosine;
    const T slope = larger_of(T(T(1) - e1 + e1 * versine + s * sine), T(1e-30));
    const T bend = e1 * sine + s * (T(1) - versine);
    const T newton = (x - e1 * sine + s * versine - rest) / slope;
    x = larger_of(T(x - newton / larger_of(T(T(1) - T(0.5) * newton * bend / slope), T(0.1))), T(0));
    x = smaller_of(x, kPi<T>);
  }
  const T inverse = T(1) / larger_of(e, T(1)), sine_1 = s * inverse;
  const SineCosine<T> of_x = sine_cosine(x), whole = sine_cosine(T(T(0.5) * (kPi<T> - rest)));
  const auto alone = e * whole.cosine > T(1);
  const T sine = select(alone, whole.sine, T(sine_1 * of_x.cosine + inverse * of_x.sine));
  const T cosine = select(alone, whole.cosine, T(sine_1 * of_x.sine - inverse * of_x.cosine));
  return {select(u < T(0.5), T(-sine), sine), cosine};
}

/// ½·erfc(x) and ½·erfc(-x), x of either sign.
template <class T>
struct GaussianShares {
  T outside, inside;
};
template <class T>
GaussianShares<T> gaussian_shares(const T& x, const T& exp_minus_x2) {
  using std::abs;
  const auto negative = x < T(0);
  const T less = T(0.5) * exp_minus_x2 * erfcx(T(abs(x))), more = T(1) - less;
  return {select(negative, more, less), select(negative, less, more)};
}

/// x with ½·erfc(x) = u to a few thousandths (Winitzki 2008, "A handy approximation for the error function and its inverse").
template <class T>
T rough_gaussian_slope(const T& u) {
  using std::sqrt;
  const T q = T(2) * smaller_of(u, T(T(1) - u)), l = fast_log(T(q * (T(2) - q)));
  const T a = T(0.147), b = T(2) / (kPi<T> * a) + T(0.5) * l;
  const T size = sqrt(larger_of(T(sqrt(T(square(b) - l / a)) - b), T(0)));
  return select(u < T(0.5), size, T(-size));
}

/// x with ½·erfc(x) = u: a slope of the density exp(-x²)/√π. Halley's steps on erfcx(x) - q·exp(x²).
template <class T>
T gaussian_slope(const T& u) {
  const T q = T(2) * smaller_of(u, T(T(1) - u)), start = rough_gaussian_slope(u);
  T x = select(start < T(0), T(-start), start);
  for (int step = 0; step < (kSinglePrecision<T> ? 1 : 3); ++step) {
    const T newton = T(0.5) * kSqrtPi<T> * (erfcx(x) - q * fast_exp(T(square(x))));
    x = larger_of(T(x + newton / (T(1) + x * newton)), T(0));
  }
  return select(u < T(0.5), x, T(-x));
}

/// A Gaussian slope towards the eye as Smith's masking sees it: density (o_z + κ·x)·exp(-x²)/√π where positive, by inversion of
///   S(x) = o_z·½erfc(x) + κ/(2√π)·exp(-x²) = u·S(-o_z/κ)
/// (Heitz & d'Eon 2014; Jakob 2014, "An improved visible normal sampling routine for the Beckmann distribution", take the same density).
/// `area` = S(-o_z/κ) = o_z·(1 + Λ). Newton's steps on ln S above the median and on √(1 - S) below, where the density starts in
/// proportion to the distance from its end: 3 steps leave 2e-6 of the share, 4 6e-10, 5 1e-14.
template <class T>
T visible_gaussian_slope(const T& o_z, const T& kappa, const T& area, const T& u) {
  using std::sqrt;
  const T end = o_z / larger_of(kappa, T(1e-30)), above = T(1) - u;
  const T flat = o_z / area, tilted = kappa / (T(2) * kSqrtPi<T> * area);
  const T exp_end = fast_exp(T(-square(end))), beyond = gaussian_shares(end, exp_end).outside;
  const T grazing_share = T(1) / (T(1) + end * (T(1.2) + end)), grazing = sqrt(T(-fast_log(u)));
  T x = larger_of(T((T(1) - grazing_share) * rough_gaussian_slope(u) + grazing_share * grazing),
                  T(T(0.05) * grazing - end));
  const auto upper = u < T(0.5);
  for (int step = 0; step < (kSinglePrecision<T> ? 4 : 5); ++step) {
    const T e = fast_exp(T(-square(x)));
    const auto [outside, inside] = gaussian_shares(x, e);
    const T density = larger_of(T(e * (flat / kSqrtPi<T> + T(2) * tilted * x)), T(1e-30));
    const T s = larger_of(T(flat * outside + tilted * e), T(1e-30));
    const T c = larger_of(T(flat * (inside - beyond) - tilted * (e - exp_end)), T(1e-12));
    const T forward = s / density * fast_log(T(s / u)), backward = T(2) * c / density * (sqrt(T(above / c)) - T(1));
    const T next = x + select(upper, forward, backward);
    x = smaller_of(larger_of(next, T(T(0.5) * (x - end))), T(7));
  }
  return x;
}

}  // namespace gonio
