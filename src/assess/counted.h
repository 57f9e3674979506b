#pragma once
// A number that counts the operations done with it: what one evaluation of a formula costs, from the formula's own code.
#include "base/special.h"

namespace gonio {

struct OperationCount {
  int add = 0, multiply = 0, fused = 0, divide = 0, root = 0, choose = 0, exponential = 0;

  /// Multiplications, fused or not, which share the units that a SIMD machine has least of; an exponential in lanes has 3 for
  /// its range and its polynomial's (double 11, float 7) beside them.
  int multiplier_slots(bool single) const { return multiply + fused + exponential * (single ? 10 : 14); }
};

struct Counted {
  double value = 0;
  inline static thread_local OperationCount count;

  Counted() = default;
  explicit Counted(double x) : value(x) {}
  explicit operator double() const { return value; }

  friend Counted operator+(Counted a, Counted b) { return ++count.add, Counted(a.value + b.value); }
  friend Counted operator-(Counted a, Counted b) { return ++count.add, Counted(a.value - b.value); }
  friend Counted operator*(Counted a, Counted b) { return ++count.multiply, Counted(a.value * b.value); }
  friend Counted operator/(Counted a, Counted b) { return ++count.divide, Counted(a.value / b.value); }
  friend Counted operator-(Counted a) { return Counted(-a.value); }
  friend bool operator<(Counted a, Counted b) { return a.value < b.value; }
  friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
  friend bool operator>=(Counted a, Counted b) { return a.value >= b.value; }
  friend Counted sqrt(Counted a) { return ++count.root, Counted(std::sqrt(a.value)); }
  friend Counted abs(Counted a) { return ++count.choose, Counted(std::abs(a.value)); }
  friend Counted exp(Counted a) { return ++count.exponential, Counted(std::exp(a.value)); }
  friend Counted erfc(Counted a) { return Counted(std::erfc(a.value)); }  // no path that is counted takes it
  friend Counted select(bool yes, const Counted& a, const Counted& b) { return ++count.choose, yes ? a : b; }
  friend Counted multiply_add(const Counted& a, const Counted& b, const Counted& c) {
    return ++count.fused, Counted(a.value * b.value + c.value);
  }
};

/// 1 + 2Λ as in lanes of double; the rest is on no path that is counted.
template <>
struct Special<Counted> {
  static Ratio<Counted> smith_visible(const Counted& s2) { return smith_fraction<double>(s2).value; }
  static Counted smith_lambda_core(const Counted& s) { return Counted(Special<double>::smith_lambda_core(s.value)); }
  static Counted erfcx(const Counted& x) { return Counted(Special<double>::erfcx(x.value)); }
};

/// Operations of one call.
template <class F>
OperationCount operations_of(F&& f) {
  Counted::count = {};
  f();
  return Counted::count;
}

}  // namespace gonio
