#pragma once
#include "base/scaled_exp.h"
#include "base/two_terms.h"
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"

namespace gonio {

/// How the lobe is scaled, in the order of the model's variants.
enum class LafortuneForm { as_published, normalised };

/// Lafortune, Foo, Torrance & Greenberg 1997 (SIGGRAPH, doi:10.1145/258734.258801), one generalised cosine lobe, eq. (4):
///   f = [c_z·i_z·o_z - c_x·i_x·o_x - c_y·i_y·o_y]ⁿ where positive, else 0
/// (the paper's Cx = -c_x, Cy = -c_y: positive c_x, c_y lean to the mirror side; `retro` turns the lobe to the light).
///   normalised   times (n + 2)/(2π·max(c)ⁿ), as the MERL tables of Ngan, Durand & Matusik 2005 have it.
/// Symbols: c_x, c_y, c_z in [0, 1] (larger ones only scale: ks), n > 0 exponent; ks is ρs.
/// Reciprocal; no Fresnel factor; E is not held below 1; f <= 1 as published, so E is bounded at grazing.
/// Near its top the lobe is written about the mirror direction: with δ = ½|o - r|², i_z·o_z - i_x·o_x - i_y·o_y = 1 - δ, and
///   s/max(c) = 1 + x, x = (c_z - max)/max - δ·c_z/max + ((c_z - c_x)·i_x·o_x + (c_z - c_y)·i_y·o_y)/max,
/// so that the n-th power, exp(n·log1p(x)), loses nothing at n = 1e5; below half of it s is summed exactly, since
/// its terms may cancel. Where c_x = c_y = c_z it is Phong's lobe.
template <class T>
struct Lafortune {
  static constexpr bool kFacets = false, kDiffracts = false;
  T c_x, c_y, c_z, n;
  LafortuneForm form = LafortuneForm::as_published;

  AxisSampler<T> sampler() const { return {c_x, c_y, c_z, n}; }

  template <class G>
  T shape(const Directions<G>& w) const {
    using std::log, std::log1p;
    const T largest = larger_of(c_z, larger_of(c_x, c_y));
    const T delta = T(0.5) * T(square(w.hx) + square(w.hy) + square(w.cos_i - w.cos_o));
    const T x = excess(w, T(c_z - largest), delta) / largest;
    const auto low = x < T(-0.5);
    const T s = plain_sum(w) / largest;
    const auto lit = !low || s > T(0);
    const T log_s = select(low, T(log(select(low && lit, s, T(1)))), T(log1p(select(low, T(0), x))));
    if (form == LafortuneForm::normalised)
      return select(lit, scaled_exp(T((n + T(2)) / (T(2) * kPi<T>)), T(-n * log_s)), T(0));
    return select(lit, T(fast_exp(T(n * (log_s + log(largest))))), T(0));
  }

 private:
  /// s - max(c), from terms that may cancel next to grazing.
  template <class G>
  T excess(const Directions<G>& w, const T& missing, const T& delta) const {
    TwoTerms<T> sum = sum_of(TwoTerms<T>{missing, T(0)}, product_of(T(-delta), c_z));
    sum = sum_of(sum, product_of(T(c_z - c_x), T(w.ix), T(w.ox)));
    sum = sum_of(sum, product_of(T(c_z - c_y), T(w.iy), T(w.oy)));
    return sum.value + sum.rest;
  }
  /// c_z·i_z·o_z - c_x·i_x·o_x - c_y·i_y·o_y, as if in three times the precision.
  template <class G>
  T plain_sum(const Directions<G>& w) const {
    const TwoTerms<T> x = product_of(c_x, T(-w.ix)), y = product_of(c_y, T(-w.iy)), z = product_of(c_z, T(w.cos_i));
    const T ox(w.ox), oy(w.oy), oz(w.cos_o);
    return sum_of_products(std::array<T, 6>{z.value, x.value, y.value, z.rest, x.rest, y.rest},
                           std::array<T, 6>{oz, ox, oy, oz, ox, oy});
  }
};

}  // namespace gonio
