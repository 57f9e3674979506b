#pragma once
// Formulas in 50 digits as the textbooks print them, written without the project's templates: the oracles of the tests.
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <algorithm>

namespace oracle {

using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<50>, boost::multiprecision::et_off>;

inline Real pi() { return boost::math::constants::pi<Real>(); }

struct Complex {
  Real re, im;
};
inline Complex operator+(const Complex& a, const Complex& b) { return {a.re + b.re, a.im + b.im}; }
inline Complex operator-(const Complex& a, const Complex& b) { return {a.re - b.re, a.im - b.im}; }
inline Complex operator*(const Complex& a, const Complex& b) { return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re}; }
inline Real norm(const Complex& a) { return a.re * a.re + a.im * a.im; }
inline Complex root(const Complex& a) {  // the branch with Im >= 0
  const Real r = sqrt(norm(a)), re = sqrt((r + abs(a.re)) / 2);
  if (re == 0) return {0, 0};
  const Real im = abs(a.im) / (2 * re);
  return a.re >= 0 ? Complex{re, im} : Complex{im, re};
}

struct Reflectances {
  Real s, p;
};

/// Fresnel's amplitudes: r_s = (c - w)/(c + w), r_p = (N²c - w)/(N²c + w), w = √(N² - sin²θ).
inline Reflectances fresnel(double theta_deg, double n, double k) {
  const Real theta = Real(theta_deg) * pi() / 180;
  const Complex index{Real(n), Real(k)}, n2 = index * index, c{cos(theta), 0};
  const Real sine = sin(theta);
  const Complex w = root(n2 - Complex{sine * sine, 0});
  return {norm(c - w) / norm(c + w), norm(n2 * c - w) / norm(n2 * c + w)};
}

/// Σ_{j>=1} g^j e^{-g}/(j!·j)·exp(-b/j), term by term over a window that leaves out less than 1e-50 of it.
inline Real kirchhoff_sum(const Real& g, const Real& b) {
  const double g0 = g.convert_to<double>(), b0 = b.convert_to<double>();
  double lo = std::max(1.0, g0), hi = g0 + std::sqrt(b0) + 30;  // the terms' peak x²·ln(x/g) = b lies between
  for (int i = 0; i < 200; ++i) {
    const double x = 0.5 * (lo + hi);
    (x * x * std::log(x / g0) < b0 ? lo : hi) = x;
  }
  const double spread = 25 * std::sqrt(lo) + 80;
  const long first = std::max(1L, static_cast<long>(lo - spread)), last = static_cast<long>(lo + spread);
  Real poisson = exp(first * log(g) - g - lgamma(Real(first + 1))), sum = 0;
  for (long j = first; j <= last; ++j) {
    sum += poisson / j * exp(-b / j);
    poisson *= g / (j + 1);
  }
  return sum;
}

/// Beckmann-Kirchhoff (18a), incoherent, R = 1, as printed with the geometry of Beckmann & Spizzichino; degrees and µm.
inline Real kirchhoff(double theta_i_deg, double theta_o_deg, double phi_deg, double sigma_um, double correlation_um,
                      double wavelength_um) {
  const Real degree = pi() / 180, ti = theta_i_deg * degree, to = theta_o_deg * degree, delta = (Real(phi_deg) - 180) * degree;
  const Real ci = cos(ti), co = cos(to), si = sin(ti), so = sin(to), half = sin(delta / 2);
  const Real u2 = (si - so) * (si - so) + 4 * si * so * half * half, w = ci + co;
  const Real wave = 2 * pi() / Real(wavelength_um), v_xy2 = wave * wave * u2;
  const Real g = pow(wave * Real(sigma_um) * w, 2), b = v_xy2 * Real(correlation_um) * Real(correlation_um) / 4;
  const Real f = (u2 + w * w) / (2 * w);
  return pi() * Real(correlation_um) * Real(correlation_um) * f * f / (Real(wavelength_um) * Real(wavelength_um) * ci * co) *
         kirchhoff_sum(g, b);
}

}  // namespace oracle
