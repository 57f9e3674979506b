#pragma once
#include "base/two_terms.h"
#include "base/unit_vector.h"
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"
#include "surface/normals.h"
#include "surface/shadowing.h"

namespace gonio {

/// The density of normals, in the order of the model's variants.
enum class DielectricNormals { ggx, beckmann };

/// The generalised half vector of i (near side) and o (far side), H = ±(i + n·o) with H_z > 0, in factors that lose nothing as
/// n → 1 or where the facet is seen at grazing: components of H, a = i·H and b = -o·H summed with their
/// rounding errors, |H|² = (n-1)² + 2ne with e = ½|i + o|² = 1 + i·o.
/// Snell's law at the facet holds by construction, so T = 1 - F has no difference left: a + nb = ∓(n²-1),
/// na + b = ∓(n²-1)(1-e), T_s = 4nab/(n²-1)², T_p = T_s/(i·o)².
template <class T>
struct RefractingFacet {
  T a, b, length2, tan2;  ///< a = b = 0: no facet refracts i into o
  T transmittance;        ///< unpolarised, of the facet
};

template <class T>
RefractingFacet<T> refracting_facet(const UnitVector<T>& i, const UnitVector<T>& o, const T& n) {
  const T m = n - T(1), up = select(m > T(0), T(-1), T(1));
  const T e = T(0.5) * (square(T(i.x + o.x)) + square(T(i.y + o.y)) + square(T(i.z + o.z)));
  const auto component = [&](const T& near, const T& far) {
    const TwoTerms<T> sum = sum_of(TwoTerms<T>{near, T(0)}, product_of(n, far));
    return TwoTerms<T>{up * sum.value, up * sum.rest};
  };
  const TwoTerms<T> x = component(i.x, o.x), y = component(i.y, o.y), z = component(i.z, o.z);
  const auto along = [&](const UnitVector<T>& v) {
    const TwoTerms<T> sum =
        sum_of(sum_of(product_of(v.x, x.value), product_of(v.y, y.value)), product_of(v.z, z.value));
    return T(sum.value + (sum.rest + (v.x * x.rest + v.y * y.rest + v.z * z.rest)));
  };
  const T hx = x.value + x.rest, hy = y.value + y.rest, hz = z.value + z.rest;
  const T a = along(i), b = -along(o);
  const auto refracts = a > T(0) && b > T(0) && hz > T(0);
  const T contrast = select(refracts, T(m * (n + T(1))), T(1)), cosine = select(refracts, T(T(1) - e), T(1));
  const T t_s = T(4) * n * a * b / square(contrast);
  RefractingFacet<T> facet;
  facet.a = select(refracts, a, T(0));
  facet.b = select(refracts, b, T(0));
  facet.length2 = select(refracts, T(square(m) + T(2) * n * e), T(1));
  facet.tan2 = select(refracts, T((square(hx) + square(hy)) / square(hz)), T(0));
  facet.transmittance = select(refracts, T(T(0.5) * t_s * (T(1) + T(1) / square(cosine))), T(0));
  return facet;
}

/// Walter, Marschner, Li & Torrance 2007 (EGSR, doi:10.2312/EGWR/EGSR07/195-206): reflection and refraction by facets that
/// are dielectric interfaces of relative index n = n_o/n_i (far over near side),
///   f_r = D(h)·G·F/(4·cos_i·cos_o)                                                            eq. (20)
///   f_t = |i·h|·|o·h|/(cos_i·|cos_o|)·n²·(1 - F)·G·D(h)/(i·h + n·o·h)²,  h ∥ i + n·o            eq. (21)
/// f_t is for radiance: n_i²·f_t(i→o) = n_o²·f_t(o→i), and ∫ f_t·|cos_o| dω_o is the energy that passes.
/// Symbols: alpha roughness, the same to both sides; D GGX (their D) or Beckmann; G = G1(i)·G1(o) of Smith, as there.
/// Reciprocal, single scattering: R + T <= 1, → 1 as alpha → 0. At n = 1 the transmitted part is a delta and f_t is 0.
/// Here G1 is exact for both densities (their rational fit for Beckmann is up to 3.1e-3 off).
template <class T>
struct RoughDielectric {
  static constexpr bool kFacets = true, kDiffracts = false;
  T alpha;
  DielectricNormals normals = DielectricNormals::ggx;

  T density(const T& tan2_h) const { return density(tan2_h, T(1)); }
  T density(const T& tan2_h, const T& scale) const {
    if (normals == DielectricNormals::beckmann) return beckmann_d(tan2_h, alpha, scale);
    const T x = alpha * (T(1) + tan2_h) / (square(alpha) + tan2_h);
    return scale * square(x) / kPi<T>;
  }
  /// Smith's masking of one direction; GGX: Λ = (√(1 + α²tan²) - 1)/2.
  T g1(const T& tan2) const {
    using std::sqrt;
    if (normals == DielectricNormals::beckmann) return T(1) / (T(1) + smith_lambda(tan2, alpha));
    return T(2) / (T(1) + sqrt(T(1) + square(alpha) * tan2));
  }

  FacetSampler<T> sampler() const {
    const SlopeKind kind = normals == DielectricNormals::ggx ? SlopeKind::ggx : SlopeKind::gaussian;
    return facets_seen(alpha, alpha, kind, Shadowing::smith_separable);
  }

  /// Reflection, without R.
  template <class G>
  T shape(const Directions<G>& w) const {
    return density(T(w.tan2_h), T(g1(T(w.tan2_i)) * g1(T(w.tan2_o)) / (T(4) * T(w.cos_i) * T(w.cos_o))));
  }

  /// Refraction from i (z > 0) to o (z < 0), 1/sr, for radiance.
  T transmission(const UnitVector<T>& i, const UnitVector<T>& o, const T& n) const {
    const RefractingFacet<T> facet = refracting_facet(i, o, n);
    const T g = g1((square(i.x) + square(i.y)) / square(i.z)) * g1((square(o.x) + square(o.y)) / square(o.z));
    const T scale = facet.a * facet.b / square(facet.length2) * square(n) * facet.transmittance * g / (i.z * -o.z);
    return density(facet.tan2, scale);
  }
};

}  // namespace gonio
