#pragma once
#include <optional>

#include "brdf/brdf.h"
#include "brdf/direction_samplers.h"

namespace gonio {

using LocalDirection = UnitVector<double>;

/// The sampler that a lobe names. Lambert and the mirror have no lobe: the cosine stands there.
template <class T>
LobeSampler<T> lobe_sampler(const Lobe<T>& lobe, const T& wavelength_um) {
  return std::visit(
      [&]<class L>(const L& one) -> LobeSampler<T> {
        if constexpr (std::is_same_v<L, Lambert> || std::is_same_v<L, Mirror>)
          return CosineSampler<T>{};
        else if constexpr (L::kDiffracts)
          return one.sampler(wavelength_um);
        else
          return one.sampler();
      },
      lobe);
}

/// How far a lobe's slopes reach, for placing the cuts of a quadrature: the widths at which it has fallen to about 1/e.
struct SlopeExtent {
  double widest, narrowest;
  bool gaussian;  ///< and nothing beyond 9 widths
};
SlopeExtent slope_extent(const Lobe<double>& lobe, double wavelength_um);

/// The density from which a BRDF's directions are drawn that are no delta: a cosine lobe beside the lobe's own sampler.
template <class T>
struct LobeMixture {
  LobeSampler<T> lobe;
  T cosine_share = T(0);
  bool retro = false;

  DirectionSample<T> sample(const UnitVector<T>& o, const T& u0, const T& u1, const T& u2) const {
    const T left = T(1) - cosine_share;
    const auto diffuse = u0 < cosine_share;
    const T inner = select(diffuse, u0, T((u0 - cosine_share) / select(left > T(0), left, T(1))));
    DirectionSample<T> of_lobe = std::visit([&](const auto& one) { return one.sample(o, inner, u1, u2); }, lobe);
    if (retro) of_lobe.direction = turned(of_lobe.direction);
    const UnitVector<T> cosine = CosineSampler<T>{}.sample(o, u0, u1, u2).direction, &other = of_lobe.direction;
    const UnitVector<T> i{select(diffuse, cosine.x, other.x), select(diffuse, cosine.y, other.y),
                          select(diffuse, cosine.z, other.z)};
    return with_density(*this, i, o, diffuse || of_lobe.pdf_per_sr > T(0));
  }

  /// Per steradian, both above the horizon.
  T pdf(const UnitVector<T>& i, const UnitVector<T>& o) const {
    const UnitVector<T> given = retro ? turned(i) : i;
    const T of_lobe = std::visit([&](const auto& one) { return one.pdf(given, o); }, lobe);
    return cosine_share * i.z / kPi<T> + (T(1) - cosine_share) * of_lobe;
  }

 private:
  static UnitVector<T> turned(const UnitVector<T>& i) { return {-i.x, -i.y, i.z}; }
};

/// About what the two parts reflect, for the shares of samples.
template <class T>
struct PartEnergies {
  T diffuse, lobe;
};
template <class T>
PartEnergies<T> part_energies(const Brdf<T>& brdf, const T& r0) {
  return {brdf.kd * (brdf.diffuse_times_r0() ? r0 : T(1)), brdf.ks * (brdf.facets() ? r0 : T(1))};
}

/// In proportion to the energies, diffuse against lobe, each at least a tenth so that neither is starved.
template <class T>
LobeMixture<T> lobe_mixture(const Brdf<T>& brdf, const T& r0, const T& wavelength_um) {
  const auto [diffuse, lobe] = part_energies(brdf, r0);
  const bool density = !std::holds_alternative<Lambert>(brdf.lobe) && !std::holds_alternative<Mirror>(brdf.lobe);
  const auto lit = lobe > T(0);
  const T total = select(lit, T(diffuse + lobe), T(1));
  const T balanced = larger_of(T(0.1), smaller_of(T(0.9), T(diffuse / total)));
  const T cosine = density ? T(select(lit, T(select(diffuse > T(0), balanced, T(0))), T(1))) : T(1);
  return {lobe_sampler(brdf.lobe, wavelength_um), cosine, brdf.retro};
}

/// A direction i towards the light drawn for the eye o. A delta's f and pdf are energies (f without its 1/cos), never densities: its weight is
/// f/pdf, that of the others f·cos_i/pdf.
template <class T>
struct BrdfSample {
  UnitVector<T> i;
  T pdf;
  T f;
  bool delta;
};

/// sample and pdf of a whole Brdf at one wavelength (T a scalar).
template <class T>
class BrdfSampler {
 public:
  BrdfSampler(const Brdf<T>& brdf, const Interface<T>& surface, const T& wavelength_um)
      : brdf_(brdf),
        surface_(surface),
        wavelength_um_(wavelength_um),
        mixture_(lobe_mixture(brdf, T(surface.r0()), wavelength_um)) {}

  /// Empty when the drawn direction lies below the horizon (it carries nothing).
  std::optional<BrdfSample<T>> sample(const UnitVector<T>& o, const T& u0, const T& u1, const T& u2) const {
    const T share = delta_share(o.z);
    if (u0 < share) {
      const UnitVector<T> i = brdf_.retro ? o : UnitVector<T>{-o.x, -o.y, o.z};
      return BrdfSample<T>{i, share, coherent_energy(brdf_, o.z, surface_, wavelength_um_), true};
    }
    if (!(share < T(1))) return {};
    const DirectionSample<T> drawn = mixture_.sample(o, T((u0 - share) / (T(1) - share)), u1, u2);
    if (!(drawn.pdf_per_sr > T(0))) return {};
    const UnitVector<T>& i = drawn.direction;
    const Directions<T> w = reduce(i.x, i.y, i.z, o.x, o.y, o.z);
    return BrdfSample<T>{i, (T(1) - share) * drawn.pdf_per_sr, evaluate(brdf_, w, surface_, wavelength_um_), false};
  }

  /// Density of the directions that are no delta, per steradian.
  T pdf(const UnitVector<T>& i, const UnitVector<T>& o) const {
    if (!(i.z > T(0)) || !(o.z > T(0))) return T(0);
    return (T(1) - delta_share(o.z)) * mixture_.pdf(i, o);
  }

  /// Probability of drawing the delta; 0 where there is none.
  T delta_share(const T& cos_o) const {
    const T coherent = coherent_energy(brdf_, cos_o, surface_, wavelength_um_);
    if (!(coherent > T(1e-9))) return T(0);
    const T diffuse = brdf_.kd,
            rest = std::holds_alternative<Mirror>(brdf_.lobe) ? T(0) : T(brdf_.ks * surface_.r0() - coherent);
    if (!(diffuse + rest > T(0))) return std::holds_alternative<Mirror>(brdf_.lobe) ? T(1) : T(0.9);
    return larger_of(T(0.05), smaller_of(T(0.9), T(coherent / (diffuse + coherent + rest))));
  }

 private:
  Brdf<T> brdf_;
  Interface<T> surface_;
  T wavelength_um_;
  LobeMixture<T> mixture_;
};

}  // namespace gonio
