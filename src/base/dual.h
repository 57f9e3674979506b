#pragma once
// Forward derivatives over any number type, SIMD lanes above all: Dual<DoubleLanes, 3> carries a value and three derivatives
// in every lane. The counterpart of ceres::Jet (base/jet.h), which holds a scalar.
//
// Comparisons look at the value and give T's mask. Where a derivative is no number (a root at 0) the models choose a branch
// with `select`, whose unused side may then hold anything: it is dropped, never multiplied by 0.
#include <array>
#include <cmath>

#include "base/special.h"

namespace gonio {

template <class T, int N>
struct Dual {
  T a = T(0);          ///< the value
  std::array<T, N> v;  ///< its derivatives

  Dual() { v.fill(T(0)); }
  explicit Dual(const T& value) : a(value) { v.fill(T(0)); }
  /// A constant; a variable with its own index has derivative 1 there.
  template <class S>
  requires(std::is_arithmetic_v<S> && !std::is_same_v<S, T>) explicit Dual(S value) : a(T(scalar_t<T>(value))) {
    v.fill(T(0));
  }
  Dual(const T& value, int index) : Dual(value) { v[index] = T(1); }
};

template <class T, int N>
struct scalar<Dual<T, N>> {
  using type = scalar_t<T>;
};
template <class T, int N>
struct ValueOf<Dual<T, N>> {
  static T of(const Dual<T, N>& x) { return x.a; }
};

/// f(x) from its value and slope at x.
template <class T, int N>
Dual<T, N> chain(const Dual<T, N>& x, const T& value, const T& slope) {
  Dual<T, N> r(value);
  for (int i = 0; i < N; ++i) r.v[i] = slope * x.v[i];
  return r;
}

template <class T, int N>
Dual<T, N> operator-(const Dual<T, N>& x) {
  Dual<T, N> r(-x.a);
  for (int i = 0; i < N; ++i) r.v[i] = -x.v[i];
  return r;
}
template <class T, int N>
Dual<T, N> operator+(const Dual<T, N>& x, const Dual<T, N>& y) {
  Dual<T, N> r(x.a + y.a);
  for (int i = 0; i < N; ++i) r.v[i] = x.v[i] + y.v[i];
  return r;
}
template <class T, int N>
Dual<T, N> operator-(const Dual<T, N>& x, const Dual<T, N>& y) {
  Dual<T, N> r(x.a - y.a);
  for (int i = 0; i < N; ++i) r.v[i] = x.v[i] - y.v[i];
  return r;
}
template <class T, int N>
Dual<T, N> operator*(const Dual<T, N>& x, const Dual<T, N>& y) {
  Dual<T, N> r(x.a * y.a);
  for (int i = 0; i < N; ++i) r.v[i] = multiply_add(x.a, y.v[i], T(x.v[i] * y.a));
  return r;
}
template <class T, int N>
Dual<T, N> operator/(const Dual<T, N>& x, const Dual<T, N>& y) {
  const T inverse = T(scalar_t<T>(1)) / y.a, near = x.a * inverse,
          ratio = multiply_add(multiply_add(T(-near), y.a, x.a), inverse, near);  // one division, its rounding mended
  Dual<T, N> r(ratio);
  for (int i = 0; i < N; ++i) r.v[i] = inverse * multiply_add(T(-ratio), y.v[i], x.v[i]);
  return r;
}
// With a number without derivatives, such as a cosine of the directions: no zeros are carried.
template <class T, int N>
Dual<T, N> operator+(const Dual<T, N>& x, const T& y) {
  Dual<T, N> r(x);
  r.a += y;
  return r;
}
template <class T, int N>
Dual<T, N> operator+(const T& x, const Dual<T, N>& y) {
  return y + x;
}
template <class T, int N>
Dual<T, N> operator*(const Dual<T, N>& x, const T& y) {
  return chain(x, T(x.a * y), y);
}
template <class T, int N>
Dual<T, N> operator*(const T& x, const Dual<T, N>& y) {
  return y * x;
}
template <class T, int N>
Dual<T, N> operator/(const Dual<T, N>& x, const T& y) {
  return x * T(T(scalar_t<T>(1)) / y);
}
template <class T, int N>
Dual<T, N> operator/(const T& x, const Dual<T, N>& y) {
  const T inverse = T(scalar_t<T>(1)) / y.a, ratio = x * inverse;
  return chain(y, ratio, T(-ratio * inverse));
}

template <class T, int N>
Dual<T, N> multiply_add(const Dual<T, N>& x, const T& y, const Dual<T, N>& z) {
  Dual<T, N> r(multiply_add(x.a, y, z.a));
  for (int i = 0; i < N; ++i) r.v[i] = multiply_add(x.v[i], y, z.v[i]);
  return r;
}

/// a·b, a fraction with derivatives by its own variables, b by others, those of a first: neither carries zeros for the other's.
template <class T, int N, int M>
Dual<T, N + M> joint_product(const Ratio<Dual<T, N>>& a, const Ratio<Dual<T, M>>& b) {
  const T inverse = T(scalar_t<T>(1)) / (a.under.a * b.under.a);
  const T f = a.over.a * b.over.a * inverse, a_over = a.over.a * inverse, b_over = b.over.a * inverse,
          a_share = f * a.under.a * inverse, b_share = f * b.under.a * inverse;
  Dual<T, N + M> r(f);
  for (int i = 0; i < N; ++i) r.v[i] = multiply_add(a.over.v[i], b_over, T(-(a.under.v[i] * b_share)));
  for (int i = 0; i < M; ++i) r.v[N + i] = multiply_add(b.over.v[i], a_over, T(-(b.under.v[i] * a_share)));
  return r;
}

template <class T, int N>
Dual<T, N>& operator+=(Dual<T, N>& x, const Dual<T, N>& y) {
  return x = x + y;
}
template <class T, int N>
Dual<T, N>& operator-=(Dual<T, N>& x, const Dual<T, N>& y) {
  return x = x - y;
}
template <class T, int N>
Dual<T, N>& operator*=(Dual<T, N>& x, const Dual<T, N>& y) {
  return x = x * y;
}
template <class T, int N>
Dual<T, N>& operator/=(Dual<T, N>& x, const Dual<T, N>& y) {
  return x = x / y;
}

template <class T, int N>
auto operator<(const Dual<T, N>& x, const Dual<T, N>& y) {
  return x.a < y.a;
}
template <class T, int N>
auto operator>(const Dual<T, N>& x, const Dual<T, N>& y) {
  return x.a > y.a;
}
template <class T, int N>
auto operator<=(const Dual<T, N>& x, const Dual<T, N>& y) {
  return x.a <= y.a;
}
template <class T, int N>
auto operator>=(const Dual<T, N>& x, const Dual<T, N>& y) {
  return x.a >= y.a;
}
template <class T, int N>
auto operator==(const Dual<T, N>& x, const Dual<T, N>& y) {
  return x.a == y.a;
}

template <class T, int N, class Mask>
Dual<T, N> select(const Mask& mask, const Dual<T, N>& yes, const Dual<T, N>& no) {
  Dual<T, N> r(select(mask, yes.a, no.a));
  for (int i = 0; i < N; ++i) r.v[i] = select(mask, yes.v[i], no.v[i]);
  return r;
}
template <class T, int N>
Dual<T, N> select(bool yes, const Dual<T, N>& a, const Dual<T, N>& b) {
  return yes ? a : b;
}

template <class T, int N>
Dual<T, N> square(const Dual<T, N>& x) {
  return chain(x, T(x.a * x.a), T(x.a + x.a));
}
template <class T, int N>
Dual<T, N> abs(const Dual<T, N>& x) {
  if constexpr (is_lanes_v<T>) {
    const T sign = xsimd::bitofsign(x.a);
    Dual<T, N> r(T(x.a ^ sign));
    for (int i = 0; i < N; ++i) r.v[i] = x.v[i] ^ sign;
    return r;
  } else {
    return select(x.a < T(scalar_t<T>(0)), -x, x);
  }
}
template <class T, int N>
Dual<T, N> sqrt(const Dual<T, N>& x) {
  using std::sqrt;
  const T root = sqrt(x.a);
  return chain(x, root, T(T(0.5) / root));
}
template <class T, int N>
Dual<T, N> exp(const Dual<T, N>& x) {
  const T e = fast_exp(x.a);
  return chain(x, e, e);
}
template <int kPower, class T, int N>
Dual<T, N> exp_of_decay(const Dual<T, N>& x) {
  const T e = exp_of_decay<kPower>(x.a);
  return chain(x, e, e);
}
template <class T, int N>
Dual<T, N> fast_exp(const Dual<T, N>& x) {
  return exp(x);
}
template <class T, int N>
Dual<T, N> expm1(const Dual<T, N>& x) {
  using std::expm1;
  return chain(x, T(expm1(x.a)), fast_exp(x.a));
}
template <class T, int N>
Dual<T, N> log(const Dual<T, N>& x) {
  using std::log;
  return chain(x, T(log(x.a)), T(T(1) / x.a));
}
template <class T, int N>
Dual<T, N> log1p(const Dual<T, N>& x) {
  using std::log1p;
  return chain(x, T(log1p(x.a)), T(T(1) / (T(1) + x.a)));
}
template <class T, int N>
Dual<T, N> sin(const Dual<T, N>& x) {
  using std::cos, std::sin;
  return chain(x, T(sin(x.a)), T(cos(x.a)));
}
template <class T, int N>
Dual<T, N> cos(const Dual<T, N>& x) {
  using std::cos, std::sin;
  return chain(x, T(cos(x.a)), T(-sin(x.a)));
}
template <class T, int N>
Dual<T, N> atan(const Dual<T, N>& x) {
  using std::atan;
  return chain(x, T(atan(x.a)), T(T(1) / (T(1) + square(x.a))));
}
template <class T, int N>
Dual<T, N> atan2(const Dual<T, N>& y, const Dual<T, N>& x) {
  using std::atan2;
  const T length2 = square(x.a) + square(y.a), inverse = T(1) / select(length2 > T(0), length2, T(1));
  Dual<T, N> r(T(atan2(y.a, x.a)));
  for (int i = 0; i < N; ++i) r.v[i] = (x.a * y.v[i] - y.a * x.v[i]) * inverse;
  return r;
}
template <class T, int N>
Dual<T, N> erfc(const Dual<T, N>& x) {
  using std::erfc;
  return chain(x, T(erfc(x.a)), T(T(-2) / kSqrtPi<T> * fast_exp(T(-square(x.a)))));
}
template <class T, int N>
Dual<T, N> erf(const Dual<T, N>& x) {
  using std::erf;
  return chain(x, T(erf(x.a)), T(T(2) / kSqrtPi<T> * fast_exp(T(-square(x.a)))));
}
/// x^p, x >= 0; at x = 0 the derivatives are 0 (that of p > 1; of a smaller p there is none).
template <class T, int N>
Dual<T, N> pow(const Dual<T, N>& x, const Dual<T, N>& p) {
  using std::log, std::pow;
  const auto positive = x.a > T(0);
  const T base = select(positive, x.a, T(1)), raised = pow(base, p.a), logarithm = log(base);
  Dual<T, N> r(select(positive, raised, T(pow(x.a, p.a))));
  for (int i = 0; i < N; ++i)
    r.v[i] = select(positive, T(raised * multiply_add(logarithm, p.v[i], T(p.a / base * x.v[i]))), T(0));
  return r;
}

/// The slopes of the special functions, in closed form.
template <class T, int N>
struct Special<Dual<T, N>> {
  static Dual<T, N> erfcx(const Dual<T, N>& x) {
    return chain(x, Special<T>::erfcx(x.a), T(T(-2) * Special<T>::erfcx_q(x.a)));
  }
  /// q' = 2x·q - erfcx = 2(x·q) - erfcx, by its parts (second derivatives of erfcx are not the models' business).
  static Dual<T, N> erfcx_q(const Dual<T, N>& x) {
    const T q = Special<T>::erfcx_q(x.a);
    return chain(x, q, T(T(2) * x.a * q - Special<T>::erfcx(x.a)));
  }
  static Dual<T, N> smith_lambda_core(const Dual<T, N>& s) {
    const T e = fast_exp(T(T(-1) / square(s.a)));
    return chain(s, Special<T>::smith_lambda_core(s.a, e), T(T(0.5) / kSqrtPi<T> * e));
  }
  /// d/d(s²) = exp(-1/s²)/(2s√π), as part of the numerator: no division but that of x = 1/s². Below the least s² of the
  /// fraction it is 0, as there 1 + 2Λ is 1.
  static Ratio<Dual<T, N>, T> smith_visible(const Dual<T, N>& s2) {
    const SmithFraction<T> f = smith_fraction<scalar_t<T>>(s2.a);
    const T slope = T(0.5) / kSqrtPi<T> * fast_exp(T(-f.x)) * f.s * f.x * f.value.under;
    return {chain(s2, f.value.over, select(f.s2 > s2.a, T(0), slope)), f.value.under};
  }
};

}  // namespace gonio
