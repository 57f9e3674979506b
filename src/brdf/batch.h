#pragma once
// Many pairs of directions at a time, in SIMD lanes: the fast path. One model, one surface and one wavelength; or one pair and
// many wavelengths.
#include <algorithm>
#include <array>

#include "base/flush_to_zero.h"
#include "base/one_loop.h"
#include "brdf/lanes.h"

namespace gonio {

/// Unit vectors towards the light (i) and the eye (o), z > 0, each component in an array of its own, all of one length.
/// In float z >= 1.7e-6 (89.9999°); results below 1.2e-38 are 0.
template <class S>
struct DirectionPairs {
  std::span<const S> ix, iy, iz, ox, oy, oz;
  std::size_t size() const { return ix.size(); }
};

inline constexpr int kLobesOwn = -1;  ///< no constant: the lobe's own choice, looked at for every pair

/// Whole batches of one lobe, its choices constants of the loop: what the compiler makes one loop of.
template <int kShadowing, bool kExact, bool kRetro, class Lanes, class L>
GONIO_ONE_LOOP void evaluate_lanes(L lobe, const Lanes scale, const Lanes diffuse, const Interface<Lanes> surface,
                                   const Lanes wavelength_um, const DirectionPairs<scalar_t<Lanes>> pairs,
                                   std::size_t count, scalar_t<Lanes>* f_per_sr) {
  if constexpr (kShadowing != kLobesOwn) lobe.shadowing = static_cast<Shadowing>(kShadowing);
  if constexpr (kExact) lobe.form = FacetForm::exact, lobe.schlick_fresnel = false;
  for (std::size_t at = 0; at + Lanes::size <= count; at += Lanes::size) {
    const auto load = [at](std::span<const scalar_t<Lanes>> component) {
      return Lanes::load_unaligned(component.data() + at);
    };
    const Lanes ix = load(pairs.ix), iy = load(pairs.iy);
    const Directions<Lanes> w = reduce<Lanes>(kRetro ? Lanes(-ix) : ix, kRetro ? Lanes(-iy) : iy, load(pairs.iz),
                                              load(pairs.ox), load(pairs.oy), load(pairs.oz));
    multiply_add(scale, lobe_value<Lanes>(lobe, w, surface, wavelength_um), diffuse).store_unaligned(f_per_sr + at);
  }
}

/// Batches of a lobe that is a diffraction series, a block at a time: its sums in loops of their own.
template <class Lanes, class L>
GONIO_ONE_LOOP void evaluate_series(const L lobe, const Lanes scale, const Lanes diffuse,
                                    const Interface<Lanes> surface, const Lanes wavelength_um,
                                    const DirectionPairs<scalar_t<Lanes>> pairs, std::size_t count,
                                    scalar_t<Lanes>* f_per_sr) {
  using S = scalar_t<Lanes>;
  constexpr std::size_t kBlock = 16;
  const Lanes half = Lanes(S(std::ldexp(1.0, -kSeriesPower / 2)));
  std::array<Lanes, kBlock> g, b, factor, sum;
  g.fill(Lanes(S(1))), b.fill(Lanes(S(0))), factor.fill(Lanes(S(0)));
  for (std::size_t at = 0; at < count; at += kBlock * Lanes::size) {
    const std::size_t batches = std::min(kBlock, (count - at) / Lanes::size);
    for (std::size_t i = 0; i < batches; ++i) {
      const auto load = [at, i](std::span<const S> component) {
        return Lanes::load_unaligned(component.data() + at + i * Lanes::size);
      };
      const Directions<Lanes> w =
          reduce<Lanes>(load(pairs.ix), load(pairs.iy), load(pairs.iz), load(pairs.ox), load(pairs.oy), load(pairs.oz));
      const DiffractionSeries<Lanes> series = lobe.series(w, wavelength_um);
      g[i] = series.g, b[i] = series.b, factor[i] = series.scale * half * facet_reflectance<Lanes>(lobe, w, surface);
    }
    poisson_lobe_sums(g, b, sum);
    for (std::size_t i = 0; i < batches; ++i)
      multiply_add(scale, Lanes(sum[i] * half * factor[i]), diffuse).store_unaligned(f_per_sr + at + i * Lanes::size);
  }
}

/// The loop with the lobe's choices as constants, where it has any.
template <class Lanes, class L, class... Rest>
void evaluate_lobe_lanes(const L& lobe, bool retro, const Rest&... rest) {
  if (retro) return evaluate_lanes<kLobesOwn, false, true, Lanes>(lobe, rest...);
  if constexpr (requires { lobe.is_series(); })
    if (lobe.is_series()) return evaluate_series<Lanes>(lobe, rest...);
  constexpr bool kForms = std::is_same_v<L, TorranceSparrow<Lanes>>;
  const auto shadowed = [&]<Shadowing kShadowing>() {
    evaluate_lanes<static_cast<int>(kShadowing), kForms, false, Lanes>(lobe, rest...);
  };
  if constexpr (kForms)
    if (lobe.form != FacetForm::exact) return evaluate_lanes<kLobesOwn, false, false, Lanes>(lobe, rest...);
  if constexpr (requires { lobe.shadowing; }) {
    switch (lobe.shadowing) {
      case Shadowing::none:
        return shadowed.template operator()<Shadowing::none>();
      case Shadowing::v_cavity:
        return shadowed.template operator()<Shadowing::v_cavity>();
      case Shadowing::smith_separable:
        return shadowed.template operator()<Shadowing::smith_separable>();
      case Shadowing::smith_correlated:
        return shadowed.template operator()<Shadowing::smith_correlated>();
      case Shadowing::smith_1967:
        return shadowed.template operator()<Shadowing::smith_1967>();
    }
  }
  evaluate_lanes<kLobesOwn, false, false, Lanes>(lobe, rest...);
}

/// f_r in sr⁻¹ (no cosine) of every pair; `f_per_sr` as long as they are. Deltas evaluate to 0.
template <class Lanes>
void evaluate_pairs(const Brdf<Lanes>& brdf, const DirectionPairs<scalar_t<Lanes>>& pairs,
                    const Interface<Lanes>& surface, const Lanes& wavelength_um, std::span<scalar_t<Lanes>> f_per_sr) {
  using S = scalar_t<Lanes>;
  const FlushToZero flush;
  const Lanes diffuse = brdf.kd * (brdf.diffuse_times_r0() ? surface.r0() : Lanes(S(1))) / kPi<Lanes>;
  const auto run = [&](const DirectionPairs<S>& some, std::size_t count, S* f) {
    std::visit(
        [&](const auto& one) {
          evaluate_lobe_lanes<Lanes>(one, brdf.retro, brdf.ks, diffuse, surface, wavelength_um, some, count, f);
        },
        brdf.lobe);
  };
  run(pairs, pairs.size(), f_per_sr.data());
  const std::size_t done = pairs.size() / Lanes::size * Lanes::size, rest = pairs.size() - done;
  if (rest == 0) return;
  std::array<std::array<S, Lanes::size>, 7> last;
  const std::array<std::span<const S>, 6> all{pairs.ix, pairs.iy, pairs.iz, pairs.ox, pairs.oy, pairs.oz};
  for (std::size_t c = 0; c < all.size(); ++c)
    for (std::size_t lane = 0; lane < Lanes::size; ++lane) last[c][lane] = all[c][done + std::min(lane, rest - 1)];
  run({last[0], last[1], last[2], last[3], last[4], last[5]}, Lanes::size, last[6].data());
  std::copy_n(last[6].begin(), rest, f_per_sr.begin() + static_cast<std::ptrdiff_t>(done));
}

}  // namespace gonio
