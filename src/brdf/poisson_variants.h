#pragma once
// Rivals of the diffraction series' own sums, for comparison: a fixed number of terms, and a Gauss rule in the Poisson weights.
#include "brdf/poisson_lanes.h"

namespace gonio {

/// ln(j!·j) in the number type (50 digits: reference/digits50.h).
template <class T>
T log_of_term(int j) {
  return T(kSeriesLog<double>[std::size_t(j)]);
}

/// scale·Σ_{j=1}^{terms}, as published programs cut the series (10 or 40 terms). What is cut is 1 - Q(terms+1, g) of the energy at
/// the mirror direction: a relative error of about g^N·exp(-g)/N! while g < N, and of 1 for g ≫ N: the lobe is lost.
template <class T>
T poisson_lobe_fixed_terms(const T& g, const T& b, const T& scale, int terms) {
  using std::log;
  const T log_g = log(g), half(0x1p-45);  // terms 2^90 times as large, for the range of float
  T sum(0);
  for (int j = 1; j <= terms; ++j) sum += exp_of_decay<90>(T(log_g * T(j) - g - log_of_term<T>(j) - b / T(j)));
  return sum * half * scale * half;
}

/// scale·Σ by the Gauss rule of `kNodes` nodes whose weight is Pois(·; g) (Charlier polynomials; the tridiagonal matrix has g + n on its
/// diagonal, √(n·g) beside it), for g >= 30; fewer, term by term. The nodes come from those of Hermite by Newton's method.
/// Exact for polynomials of degree 2·kNodes - 1 in j: near the mirror direction 1e-10 at g = 100. exp(-b/j)/j is none: the error grows with
/// b/g, since the nodes stay where Pois(j; g) is, and the tail of the lobe comes from j beyond them.
template <int kNodes, class T>
T poisson_lobe_gauss(const T& g, const T& b, const T& scale) {
  using std::sqrt;
  static const std::array<double, kNodes> kHermite = [] {  // zeros of He_n by bisection of its sign changes
    const auto value = [](double x) {
      double before = 0, now = 1;
      for (int n = 0; n < kNodes; ++n) {
        const double next = x * now - n * before;
        before = now, now = next;
      }
      return now;
    };
    std::array<double, kNodes> zeros{};
    int found = 0;
    for (double x = -8; x < 8 && found < kNodes; x += 0.01)
      if (value(x) * value(x + 0.01) < 0) {
        double lo = x, hi = x + 0.01;
        for (int step = 0; step < 50; ++step) (value(lo) * value(0.5 * (lo + hi)) < 0 ? hi : lo) = 0.5 * (lo + hi);
        zeros[std::size_t(found++)] = 0.5 * (lo + hi);
      }
    return zeros;
  }();
  const auto rough = g > T(30);
  const T mean = select(rough, g, T(30)), deviation = sqrt(mean);
  T sum(0);
  for (const double zero : kHermite) {
    T d = deviation * T(zero) + T((zero * zero - 1) / 6 + kNodes / 4.0), squares(1);  // x - g: known better than x
    for (int step = 0; step < 6; ++step) {  // orthonormal p_n(x), and their slopes
      T before(0), now(1), slope_before(0), slope(0);
      squares = T(1);
      for (int n = 0; n < kNodes; ++n) {
        const T down = sqrt(T(n) * mean), up = T(1) / sqrt(T(n + 1) * mean), shift = d - T(n);
        const T next = (shift * now - down * before) * up,
                slope_next = (now + shift * slope - down * slope_before) * up;
        before = now, now = next, slope_before = slope, slope = slope_next;
        if (n < kNodes - 1) squares += square(now);
      }
      d = d - now / slope;
    }
    const T x = mean + d;
    sum += exp_of_decay<90>(T(-b / x)) / (x * squares);
  }
  const T half(0x1p-45), by_nodes = sum * half * scale * half;
  return any(g <= T(30)) ? T(select(rough, by_nodes, poisson_lobe_fixed_terms(g, b, scale, 100))) : by_nodes;
}

}  // namespace gonio
