#pragma once
#include <variant>

#include "brdf/facet_sampler.h"

namespace gonio {

/// The cosine lobe: pdf = cos θ/π.
template <class T>
struct CosineSampler {
  DirectionSample<T> sample(const UnitVector<T>&, const T&, const T& u1, const T& u2) const {
    using std::sqrt;
    const SineCosine<T> turn = sine_cosine_of_turn(u2);
    const T r = sqrt(u1), z = sqrt(T(1) - u1);
    return {{r * turn.cosine, r * turn.sine, z}, z / kPi<T>};
  }
  T pdf(const UnitVector<T>& i, const UnitVector<T>&) const { return i.z / kPi<T>; }
};

/// The uniform hemisphere: what bounds the weights of lobes that do not fall with the cosine.
template <class T>
struct HemisphereSampler {
  DirectionSample<T> sample(const UnitVector<T>&, const T&, const T& u1, const T& u2) const {
    using std::sqrt;
    const SineCosine<T> turn = sine_cosine_of_turn(u2);
    const T r = sqrt(T((T(1) - u1) * (T(1) + u1)));
    return {{r * turn.cosine, r * turn.sine, u1}, T(0.5) / kPi<T>};
  }
  T pdf(const UnitVector<T>&, const UnitVector<T>&) const { return T(0.5) / kPi<T>; }
};

/// A cosine power about an axis that the eye sets, v ∥ (-c_x·o_x, -c_y·o_y, c_z·o_z): pdf = (n+1)/(2π)·cosⁿs. With equal c it is Phong's lobe.
/// 1 - cos s = ½|i - v|², never from a rounded cosine.
template <class T>
struct AxisSampler {
  T c_x, c_y, c_z, n;

  DirectionSample<T> sample(const UnitVector<T>& o, const T&, const T& u1, const T& u2) const {
    using std::expm1, std::log, std::sqrt;
    const UnitVector<T> v = axis(o);
    const T fall = -expm1(T(log(u1) / (n + T(1)))), sine = sqrt(T(fall * (T(2) - fall)));  // 1 - cos s, sin s
    const SineCosine<T> turn = sine_cosine_of_turn(u2);
    // A frame about v, v.z >= 0 (Duff et al. 2017, JCGT 6(1)).
    const T over = T(-1) / (T(1) + v.z), xy = v.x * v.y * over, x = sine * turn.cosine, y = sine * turn.sine;
    const UnitVector<T> i{v.x + (x * (T(1) + square(v.x) * over) + y * xy - fall * v.x),
                          v.y + (x * xy + y * (T(1) + square(v.y) * over) - fall * v.y),
                          v.z - (x * v.x + y * v.y + fall * v.z)};
    return with_density(*this, i, o, i.z > T(0));
  }

  T pdf(const UnitVector<T>& i, const UnitVector<T>& o) const {
    using std::log1p;
    const UnitVector<T> v = axis(o);
    const T fall = T(0.5) * (square(T(i.x - v.x)) + square(T(i.y - v.y)) + square(T(i.z - v.z)));
    const auto facing = fall < T(1);
    const T power = fast_exp(T(n * log1p(T(-select(facing, fall, T(0))))));
    return select(facing, T((n + T(1)) / (T(2) * kPi<T>)*power), T(0));
  }

  UnitVector<T> axis(const UnitVector<T>& o) const { return normalised(T(-c_x * o.x), T(-c_y * o.y), T(c_z * o.z)); }
};

/// Deviations from the mirror direction in the mean plane, i_xy = -o_xy + ρ(cos φ, sin φ), ρ² by a law of its own:
/// pdf = p(ρ²)·cos_i, where p is a density over the plane. Directions outside the unit disc are empty.
///   abc       p ∝ (1 + b·ρ²)^-c up to ρ = 1 + sin θ_o (Low et al. 2012, smooth)
///   gaussian  p = exp(-ρ²·b)·b/π                       (diffraction)
enum class DiscKind { abc, gaussian };

template <class T>
struct DiscSampler {
  T b, c = T(1);
  DiscKind kind = DiscKind::abc;

  DirectionSample<T> sample(const UnitVector<T>& o, const T&, const T& u1, const T& u2) const {
    return with_density(*this, draw(o, u1, u2), o);
  }
  DrawnDirection<T> draw(const UnitVector<T>& o, const T& u1, const T& u2) const {
    using std::expm1, std::log1p, std::sqrt;
    const T rho2 =
        kind == DiscKind::gaussian
            ? T(-fast_log(u1) / b)
            : T(expm1(power_law_logarithm(T(T(1) - u1), T(T(1) - off_one(c)), T(log1p(T(b * farthest2(o)))))) / b);
    const T rho = sqrt(rho2);
    const SineCosine<T> turn = sine_cosine_of_turn(u2);
    // cos_i² = cos_o² + ρ·(2·o_xy·(cos, sin) - ρ): no difference of near equals where o grazes.
    const T z2 = square(o.z) + rho * (T(2) * (o.x * turn.cosine + o.y * turn.sine) - rho);
    return {{rho * turn.cosine - o.x, rho * turn.sine - o.y, sqrt(larger_of(z2, T(0)))}, z2 > T(0)};
  }

  T pdf(const UnitVector<T>& i, const UnitVector<T>& o) const {
    using std::expm1, std::log1p;
    const T rho2 = square(T(i.x + o.x)) + square(T(i.y + o.y));
    if (kind == DiscKind::gaussian) return fast_exp(T(-rho2 * b)) * b / kPi<T> * i.z;
    const T power = off_one(c), k = T(1) - power, limit2 = farthest2(o);
    const T whole = kPi<T> * expm1(T(k * log1p(T(b * limit2)))) / (k * b);
    return select(rho2 <= limit2, T(fast_exp(T(-power * log1p(T(b * rho2)))) / whole * i.z), T(0));
  }

 private:
  /// Largest ρ² of a direction in the disc, with room for rounding.
  static T farthest2(const UnitVector<T>& o) {
    using std::sqrt;
    return T(1.0001) * square(T(T(1) + sqrt(T(square(o.x) + square(o.y)))));
  }
};

/// Ashikhmin & Shirley's own law of facets, √((n_u+1)(n_v+1))/(2π)·cos^(n_u·cos²φ + n_v·sin²φ)ζ a steradian, its azimuths (not the lengths) weighed
/// as V-cavities show them to the eye, from the radius that the law has near the normal; beside it a cosine lobe for the diffuse
/// term. Weights: at most 1 over the share.
template <class T>
struct AshikhminShirleySampler {
  T n_u, n_v, diffuse_share;

  DirectionSample<T> sample(const UnitVector<T>& o, const T& u0, const T& u1, const T& u2) const {
    using std::expm1, std::log, std::sqrt;
    const T ax = width(n_u), ay = width(n_v), px = ax * o.x, py = ay * o.y, kappa = sqrt(T(square(px) + square(py)));
    const auto leans = kappa > T(0);
    const T over = T(1) / select(leans, kappa, T(1));
    const T along_x = select(leans, T(px * over), T(1)), along_y = select(leans, T(py * over), T(0));
    const T r2 = -log(u1);
    const SineCosine<T> azimuth = cavity_azimuth(T(sqrt(r2) * kappa / o.z), u2);
    const T x = ax * (azimuth.cosine * along_x - azimuth.sine * along_y),
            y = ay * (azimuth.cosine * along_y + azimuth.sine * along_x);
    const T length2 = square(x) + square(y);  // 2/(n(φ) + 1)
    const T scale = sqrt(T(expm1(T(r2 * length2)) / length2));
    const UnitVector<T> h = normalised(T(x * scale), T(y * scale), T(1));
    const UnitVector<T> cosine = CosineSampler<T>{}.sample(o, u0, u1, u2).direction, facet = mirrored(o, h);
    const auto diffuse = u0 < diffuse_share;
    const UnitVector<T> i{select(diffuse, cosine.x, facet.x), select(diffuse, cosine.y, facet.y),
                          select(diffuse, cosine.z, facet.z)};
    return with_density(*this, i, o, diffuse || dot(o, h) > T(0));
  }

  T pdf(const UnitVector<T>& i, const UnitVector<T>& o) const {
    using std::log1p, std::sqrt;
    const Directions<T> w = reduce(i.x, i.y, i.z, o.x, o.y, o.z);
    const T over = T(1) / (w.cos_i + w.cos_o), x = w.hx * over, y = w.hy * over, t = larger_of(w.tan2_h, T(1e-18));
    const T bend = log1p(t) / t;
    const T r2 = T(0.5) * ((n_u + T(1)) * square(x) + (n_v + T(1)) * square(y)) * bend;
    const T law = sqrt(T((n_u + T(1)) * (n_v + T(1)))) / (T(2) * kPi<T>)*fast_exp(T(-r2)) / w.cos_h();
    const T seen = larger_of(T(0), smaller_of(T(2), T(T(1) + sqrt(bend) * (x * o.x + y * o.y) / o.z)));
    return diffuse_share * i.z / kPi<T> + (T(1) - diffuse_share) * law * seen / (T(4) * w.cos_d);
  }

  static T width(const T& n) {
    using std::sqrt;
    return sqrt(T(2) / (n + T(1)));
  }
};

/// Beckmann-Kirchhoff's and He's lobes: facets of alpha = 2σ/T as Smith shows them (the rough limit); a Gaussian of the deviation from the
/// mirror direction, as wide as the series' terms are there, λ/(πT)·√(1 + g) (diffraction); the uniform hemisphere for the rest, since
/// these lobes do not fall at grazing. Facets have the larger share the larger g.
template <class T>
struct KirchhoffSampler {
  T sigma_um, correlation_um, wavelength_um;

  DirectionSample<T> sample(const UnitVector<T>& o, const T& u0, const T& u1, const T& u2) const {
    const Shares shares = shares_at(o);
    const auto facet = u0 < shares.facets, rest = u0 >= T(1) - uniform_share();
    const auto mirror = facets().draw(o, u1, u2), wave = shares.waves.draw(o, u1, u2);
    const auto uniform = HemisphereSampler<T>{}.sample(o, u0, u1, u2);
    const auto pick = [&](T UnitVector<T>::*component) {
      return T(select(facet, mirror.direction.*component,
                      T(select(rest, uniform.direction.*component, wave.direction.*component))));
    };
    const UnitVector<T> i{pick(&UnitVector<T>::x), pick(&UnitVector<T>::y), pick(&UnitVector<T>::z)};
    return with_density(*this, i, o, (facet && mirror.lit) || (!facet && (rest || wave.lit)));
  }

  T pdf(const UnitVector<T>& i, const UnitVector<T>& o) const {
    const Shares shares = shares_at(o);
    const T uniform = uniform_share(), waves = T(1) - uniform - shares.facets;
    return shares.facets * facets().pdf(i, o) + waves * shares.waves.pdf(i, o) +
           uniform * HemisphereSampler<T>{}.pdf(i, o);
  }

  T alpha() const { return T(2) * sigma_um / correlation_um; }
  T width() const { return larger_of(alpha(), T(wavelength_um / (kPi<T> * correlation_um))); }

  static T uniform_share() { return T(0.1); }

  struct Shares {
    T facets;
    DiscSampler<T> waves;
  };
  Shares shares_at(const UnitVector<T>& o) const {
    const T g = square(T(T(4) * kPi<T> * sigma_um * o.z / wavelength_um));
    const T inverse_width2 = square(T(kPi<T> * correlation_um / wavelength_um)) / (T(1) + g);
    return {smaller_of(larger_of(T(T(0.9) * g / (T(1) + g)), T(0.1)), T(0.8)),
            {inverse_width2, T(1), DiscKind::gaussian}};
  }
  FacetSampler<T> facets() const { return facets_seen(alpha(), alpha(), SlopeKind::gaussian, Shadowing::none); }
};

/// The sampler of a lobe: each lobe names its own by `sampler()` (`sampler(wavelength_um)` where it diffracts).
template <class T>
using LobeSampler = std::variant<CosineSampler<T>, FacetSampler<T>, AxisSampler<T>, DiscSampler<T>,
                                 AshikhminShirleySampler<T>, KirchhoffSampler<T>>;

}  // namespace gonio
