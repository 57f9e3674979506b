#pragma once
#include "brdf/direction_sample.h"
#include "brdf/slope_laws.h"
#include "brdf/visible_slopes.h"
#include "surface/shadowing.h"

namespace gonio {

/// Which facets the eye sees: as facets of V-cavities (any law), or as Smith has it (Gaussian and GGX slopes).
enum class Visibility { v_cavity, smith };

/// Directions mirrored in facets drawn as the eye sees them. The density is, per steradian,
///   v_cavity  D(h)·min(1, 2·cos_h·cos_o/cos_d)/(4·cos_o),
///   smith     D(h)/((1 + Λ(o))·4·cos_o):
/// f·cos_i/pdf of a faceted lobe is R·G over the eye's own masking, without D or a cosine: grazing views cost no more than others.
/// GGX with Smith: Dupuy & Benyoub 2023 (HPG, doi:10.1111/cgf.14867), a cap of the unit sphere in the stretched space.
template <class T>
struct FacetSampler {
  T alpha_x, alpha_y;  ///< widths of the law's slopes along and across the grain
  SlopeLaw<T> law;
  Visibility visibility = Visibility::v_cavity;

  DirectionSample<T> sample(const UnitVector<T>& o, const T&, const T& u1, const T& u2) const {
    return with_density(*this, draw(o, u1, u2), o);
  }
  DrawnDirection<T> draw(const UnitVector<T>& o, const T& u1, const T& u2) const {
    const UnitVector<T> h = normal(o, u1, u2);
    return {mirrored(o, h), dot(o, h) > T(0)};
  }

  T pdf(const UnitVector<T>& i, const UnitVector<T>& o) const {
    const Directions<T> w = reduce(i.x, i.y, i.z, o.x, o.y, o.z);
    const T over = T(1) / (w.cos_i + w.cos_o),
            slopes = square(T(w.hx * over / alpha_x)) + square(T(w.hy * over / alpha_y));
    const T d = law.density(slopes) * square(T(1) + w.tan2_h) / (alpha_x * alpha_y);
    if (visibility == Visibility::smith) return T(0.25) * d / area(o);
    return T(0.25) * d * smaller_of(T(T(1) / o.z), T(T(2) * w.cos_h() / w.cos_d));
  }

  /// A facet's normal as seen from o.
  UnitVector<T> normal(const UnitVector<T>& o, const T& u1, const T& u2) const {
    using std::sqrt;
    if (visibility == Visibility::smith && law.kind == SlopeKind::ggx) return ggx_normal(o, u1, u2);
    const T px = alpha_x * o.x, py = alpha_y * o.y, kappa = sqrt(T(square(px) + square(py)));
    const auto leans = kappa > T(0);
    const T over = T(1) / select(leans, kappa, T(1));
    const T along_x = select(leans, T(px * over), T(1)), along_y = select(leans, T(py * over), T(0));
    T towards, across;
    if (visibility == Visibility::smith) {
      towards = visible_gaussian_slope(o.z, kappa, area(o), u1);
      across = gaussian_slope(u2);
    } else {
      const T r = sqrt(law.radius2(u1));
      const SineCosine<T> azimuth = cavity_azimuth(T(r * kappa / o.z), u2);
      towards = r * azimuth.cosine;
      across = r * azimuth.sine;
    }
    return normalised(T(alpha_x * (towards * along_x - across * along_y)),
                      T(alpha_y * (towards * along_y + across * along_x)), T(1));
  }

  /// The surface's projected area as Smith has it, o_z·(1 + Λ), ∫ D·max(0, o·h) dω_h.
  T area(const UnitVector<T>& o) const {
    using std::sqrt;
    const T stretched2 = square(T(alpha_x * o.x)) + square(T(alpha_y * o.y));
    if (law.kind == SlopeKind::ggx) return T(0.5) * (o.z + sqrt(T(square(o.z) + stretched2)));
    return o.z * (T(1) + smith_lambda(T(stretched2 / square(o.z)), T(1)));
  }

  T widest() const { return larger_of(alpha_x, alpha_y) * law.width(); }
  T narrowest() const { return smaller_of(alpha_x, alpha_y) * law.core(); }

 private:
  UnitVector<T> ggx_normal(const UnitVector<T>& o, const T& u1, const T& u2) const {
    using std::sqrt;
    const UnitVector<T> w = normalised(T(alpha_x * o.x), T(alpha_y * o.y), o.z);
    const SineCosine<T> turn = sine_cosine_of_turn(u1);
    const T z = (T(1) - u2) * (T(1) + w.z) - w.z, radius = sqrt(larger_of(T((T(1) - z) * (T(1) + z)), T(0)));
    return normalised(T(alpha_x * (radius * turn.cosine + w.x)), T(alpha_y * (radius * turn.sine + w.y)), T(z + w.z));
  }
};

/// The facets of a lobe whose G is one of Shadowing's: cavities for theirs, Smith's visible normals for the others (and for none at all,
/// where the weight is then constant).
template <class T>
FacetSampler<T> facets_seen(const T& alpha_x, const T& alpha_y, SlopeKind kind, Shadowing shadowing) {
  return {alpha_x, alpha_y, {kind}, shadowing == Shadowing::v_cavity ? Visibility::v_cavity : Visibility::smith};
}

}  // namespace gonio
