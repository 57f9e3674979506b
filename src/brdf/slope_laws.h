#pragma once
#include "base/number.h"
#include "base/special.h"

namespace gonio {

/// Laws of slopes that are drawn by their closed inverse. r² is the squared slope after division by the widths along and across the
/// grain, u in (0, 1) the share of slopes that lie outside the circle of r; a density of slopes p(r²) has ∫ p·2πr dr = 1.
///   gaussian        r² = -ln u                                      Beckmann, Ward
///   ggx             r² = (1-u)/u                                    Trowbridge-Reitz
///   power           r² = u^(-1/q) - 1: D ∝ cos^(2q-2) at width 1    Blinn
///   angle_gaussian  D·cos ∝ exp(-(cζ)²)·ζ/sin ζ up to 90° (width 1)
///   abc             D·cos ∝ (1 + b(1 - cos ζ))^-c up to 90° (width 1)    Low et al.
///   shifted_gamma   ∝ (a + r²)^-p to r² = 1, then its end value times exp(1 - r²): within a factor e of Bagher et al.'s
///                   exp(-r²)(a + r²)^-p on the first part, above it by a power on the second
enum class SlopeKind { gaussian, ggx, power, angle_gaussian, abc, shifted_gamma };

/// log(1 + v·(eᵏᴸ - 1))/k: the inverse of the integral of a power law, k = 1 - exponent, L the logarithm of its range.
template <class T>
T power_law_logarithm(const T& v, const T& k, const T& range) {
  using std::expm1, std::log1p;
  return log1p(T(v * expm1(T(k * range)))) / k;
}

/// The exponent of a power law kept off 1, where its integral turns into a logarithm (a sampler may be 0.1 % off its lobe).
template <class T>
T off_one(const T& exponent) {
  const T k = T(1) - exponent;
  return T(1) - select(k < T(0), smaller_of(k, T(-1e-3)), larger_of(k, T(1e-3)));
}

template <class T>
struct SlopeLaw {
  SlopeKind kind = SlopeKind::gaussian;
  T a = T(1);  ///< q of power, c of angle_gaussian, b of abc, a of shifted_gamma
  T b = T(1);  ///< c of abc, p of shifted_gamma

  T radius2(const T& u) const {
    using std::expm1, std::log, std::log1p, std::sqrt;
    switch (kind) {
      case SlopeKind::gaussian:
        return -log(u);
      case SlopeKind::ggx:
        return (T(1) - u) / u;
      case SlopeKind::power:
        return expm1(T(-log(u) / a));
      case SlopeKind::angle_gaussian: {
        using std::cos, std::sin;
        const T zeta = sqrt(T(-log1p(T((u - T(1)) * within_right_angle())))) / a;
        return square(T(sin(zeta) / larger_of(T(cos(zeta)), T(1e-7))));
      }
      case SlopeKind::abc: {
        const T fall = expm1(power_law_logarithm(T(T(1) - u), T(T(1) - off_one(b)), T(log1p(a)))) / a;
        return fall * (T(2) - fall) / square(larger_of(T(T(1) - fall), T(1e-7)));
      }
      case SlopeKind::shifted_gamma: {
        const T k = T(1) - off_one(b), core = gamma_core(), tail = gamma_tail(), v = (T(1) - u) * (core + tail);
        const T inside = a * expm1(T(log1p(T(k * smaller_of(v, core))) / k));
        return select(v < core, inside, T(T(1) - log(smaller_of(T(u * (core + tail) / tail), T(1)))));
      }
    }
    return T(0);
  }

  /// p(r²) of slopes in units of the widths.
  T density(const T& r2) const {
    using std::exp, std::log1p, std::sqrt;
    switch (kind) {
      case SlopeKind::gaussian:
        return fast_exp(T(-r2)) / kPi<T>;
      case SlopeKind::ggx:
        return T(1) / (kPi<T> * square(T(1) + r2));
      case SlopeKind::power:
        return a / kPi<T> * fast_exp(T(-(a + T(1)) * log1p(r2)));
      case SlopeKind::angle_gaussian: {
        using std::atan;
        const T r = sqrt(larger_of(r2, T(1e-20))), zeta = atan(r);
        return square(a) * fast_exp(T(-square(T(a * zeta)))) * zeta / (r * (T(1) + r2) * kPi<T> * within_right_angle());
      }
      case SlopeKind::abc: {
        using std::expm1;
        const T root = sqrt(T(1) + r2), fall = r2 / (root * (T(1) + root)), c = off_one(b), k = T(1) - c;
        const T whole = T(2) * kPi<T> * expm1(T(k * log1p(a))) / (k * a);
        return fast_exp(T(-c * log1p(T(a * fall)))) / (whole * root * (T(1) + r2));
      }
      case SlopeKind::shifted_gamma: {
        const T p = off_one(b), steep = p * log1p(T(smaller_of(r2, T(1)) / a));
        return fast_exp(T(smaller_of(T(T(1) - r2), T(0)) - steep)) / (kPi<T> * a * (gamma_core() + gamma_tail()));
      }
    }
    return T(0);
  }

  /// The slope, in units of the widths, by which the law has fallen to about 1/e.
  T width() const {
    using std::sqrt;
    switch (kind) {
      case SlopeKind::power:
        return T(1) / sqrt(a);
      case SlopeKind::angle_gaussian:
        return smaller_of(T(1), T(T(1) / a));
      case SlopeKind::abc:
        return T(1) / sqrt(T(1) + T(0.5) * a);
      default:
        return T(1);
    }
  }

  /// The slope, likewise, over which its innermost part changes.
  T core() const {
    using std::sqrt;
    return kind == SlopeKind::shifted_gamma ? T(sqrt(smaller_of(a, T(1)))) : width();
  }

 private:
  /// Share of the Gaussian of ζ (times ζ) below 90°.
  T within_right_angle() const {
    using std::expm1;
    return -expm1(T(-square(T(T(0.5) * kPi<T> * a))));
  }
  /// Masses of the two parts over a^(1-p).
  T gamma_core() const {
    using std::expm1, std::log1p;
    const T k = T(1) - off_one(b);
    return expm1(T(k * log1p(T(T(1) / a)))) / k;
  }
  T gamma_tail() const {
    using std::log1p;
    return fast_exp(T(-off_one(b) * log1p(T(T(1) / a)))) / a;
  }
};

}  // namespace gonio
