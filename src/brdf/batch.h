#pragma once
// Many pairs of directions at a time, in SIMD lanes: the fast path. One model, one surface and one wavelength; or one pair and
// many wavelengths.
#include <algorithm>
#include <array>

#include "base/flush_to_zero.h"
#include "brdf/lanes.h"

namespace gonio {

/// Unit vectors towards the light (i) and the eye (o), z > 0, each component in an array of its own, all of one length.
/// In float z >= 1.7e-6 (89.9999°); results below 1.2e-38 are 0.
template <class S>
struct DirectionPairs {
  std::span<const S> ix, iy, iz, ox, oy, oz;
  std::size_t size() const { return ix.size(); }
};

/// f_r of `lobe` alone over whole batches from `first` on: what the compiler makes one loop of.
template <class Lanes, class L>
[[gnu::flatten]] void evaluate_lanes(const L lobe, const Lanes scale, const Lanes diffuse, const Interface<Lanes> surface,
                                     const Lanes wavelength_um, bool retro, const DirectionPairs<scalar_t<Lanes>>& pairs,
                                     std::size_t count, scalar_t<Lanes>* f_per_sr) {
  for (std::size_t at = 0; at + Lanes::size <= count; at += Lanes::size) {
    const auto load = [at](std::span<const scalar_t<Lanes>> component) { return Lanes::load_unaligned(component.data() + at); };
    const Lanes ix = load(pairs.ix), iy = load(pairs.iy);
    const Directions<Lanes> w = reduce<Lanes>(retro ? Lanes(-ix) : ix, retro ? Lanes(-iy) : iy, load(pairs.iz), load(pairs.ox),
                                              load(pairs.oy), load(pairs.oz));
    multiply_add(scale, lobe_value<Lanes>(lobe, w, surface, wavelength_um), diffuse).store_unaligned(f_per_sr + at);
  }
}

/// f_r in sr⁻¹ (no cosine) of every pair; `f_per_sr` as long as they are. Deltas evaluate to 0.
template <class Lanes>
void evaluate_pairs(const Brdf<Lanes>& brdf, const DirectionPairs<scalar_t<Lanes>>& pairs, const Interface<Lanes>& surface,
                    const Lanes& wavelength_um, std::span<scalar_t<Lanes>> f_per_sr) {
  using S = scalar_t<Lanes>;
  const FlushToZero flush;
  const Lanes diffuse = brdf.kd * (brdf.diffuse_times_r0() ? surface.r0() : Lanes(S(1))) / kPi<Lanes>;
  const auto run = [&](const DirectionPairs<S>& some, std::size_t count, S* f) {
    std::visit([&](const auto& one) { evaluate_lanes<Lanes>(one, brdf.ks, diffuse, surface, wavelength_um, brdf.retro, some, count, f); },
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
