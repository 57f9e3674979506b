#pragma once
#include "assess/pair_arrays.h"
#include "base/dual.h"

namespace gonio {

/// torrance-sparrow with its derivatives by alpha, n and k, pairs in lanes: a batch is four blocks of `out`, f first.
GONIO_ONE_LOOP inline void derivatives_in_lanes(const TorranceSparrow<Dual<DoubleLanes, 1>> given,
                                                const Interface<Dual<DoubleLanes, 2>> surface,
                                                const PairArrays<double>& pairs, double* out) {
  auto lobe = given;
  lobe.form = FacetForm::exact, lobe.schlick_fresnel = false, lobe.shadowing = Shadowing::smith_correlated;
  for (std::size_t at = 0; at < PairArrays<double>::kPairs; at += DoubleLanes::size) {
    const auto w = pairs.lanes<DoubleLanes>(at);
    const auto f = joint_product(lobe.shape_fraction(w), surface.reflectance_of_cos2(w.cos2_d()));
    f.a.store_aligned(out + 4 * at);
    for (std::size_t i = 0; i < 3; ++i) f.v[i].store_aligned(out + 4 * at + (i + 1) * DoubleLanes::size);
  }
}
/// The same at one alpha, n, k.
inline void derivatives_in_lanes(double alpha, double n, double k, const PairArrays<double>& pairs, double* out) {
  using D1 = Dual<DoubleLanes, 1>;
  using D2 = Dual<DoubleLanes, 2>;
  derivatives_in_lanes({D1(DoubleLanes(alpha), 0)}, {D2(DoubleLanes(n), 0), D2(DoubleLanes(k), 1)}, pairs, out);
}

}  // namespace gonio
