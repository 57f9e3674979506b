#pragma once
#include "base/number.h"

namespace gonio {

/// A fraction not yet divided: the factors of a lobe multiply as fractions, and one division ends them all.
/// Either part may be a number without derivatives where the other has some.
template <class T, class U = T>
struct Ratio {
  T over;
  U under;
  auto value() const { return over / under; }
  /// Divided by x as well.
  template <class V>
  Ratio divided_by(const V& x) const {
    return {over, U(under * x)};
  }
};

template <class A, class B, class C, class D>
auto operator*(const Ratio<A, B>& a, const Ratio<C, D>& b) {
  return Ratio<decltype(a.over * b.over), decltype(a.under * b.under)>{a.over * b.over, a.under * b.under};
}

template <class T>
Ratio<T> whole(const T& x) {
  return {x, T(1)};
}

}  // namespace gonio
