#pragma once
// The loops of lobe_lanes.h, for the sources that instantiate them.
#include <oneapi/tbb/parallel_for.h>

#include "base/dual.h"
#include "base/flush_to_zero.h"
#include "base/one_loop.h"
#include "brdf/lanes.h"
#include "fit/lobe_lanes.h"

namespace gonio {

template <int N>
struct PassNumber {
  using type = Dual<DoubleLanes, N>;
};
template <>
struct PassNumber<0> {
  using type = DoubleLanes;
};

/// Whether the reflectance of a lobe's facets depends on nothing but n, k and the angle.
template <class L>
inline constexpr bool kPlainFacets = L::kFacets && !requires {
  &L::facet_reflectance;
};

/// The lobe's value where R is known already (1 for lobes that have no facets).
template <class T, class L>
T lobe_without_reflectance(const L& lobe, const Directions<DoubleLanes>& w, const T& wavelength_um) {
  if constexpr (requires { lobe.shape_fraction(w); })
    return T(lobe.shape_fraction(w).value());
  else
    return shape_of<T>(lobe, w, wavelength_um);
}

/// Batches from … to of one group.
template <int N, bool kKnownReflectance, class T, class L>
GONIO_ONE_LOOP void lobe_batches(const L lobe, bool retro, const Interface<T> surface, const T wavelength_um,
                                 const LanePoints& points, const DoubleLanes* reflectance, std::size_t from,
                                 std::size_t to, DoubleLanes* value, DoubleLanes* const* slope, double const* scale) {
  for (std::size_t batch = from; batch < to; ++batch) {
    Directions<DoubleLanes> w = points.directions(batch);
    if (retro) w = turned_back(w);
    T f;
    if constexpr (kKnownReflectance)
      f = lobe_without_reflectance<T>(lobe, w, wavelength_um) * reflectance[batch];
    else
      f = lobe_value<T>(lobe, w, surface, wavelength_um);
    if constexpr (N == 0) {
      value[batch] = f;
    } else {
      value[batch] = f.a;
      for (int i = 0; i < N; ++i)
        if (slope[i]) slope[i][batch] = f.v[static_cast<std::size_t>(i)] * DoubleLanes(scale[i]);
    }
  }
}

template <int N>
void lobe_pass(const LanePoints& points, const LobeAt& at, std::span<const DoubleLanes> reflectance, std::size_t first,
               LobeColumns& columns) {
  using T = typename PassNumber<N>::type;
  std::vector<T> values;
  for (const double x : at.values) values.push_back(T(DoubleLanes(x)));
  T n = T(DoubleLanes(at.n.value_or(1))), k = T(DoubleLanes(at.k.value_or(0)));
  std::array<DoubleLanes*, N + 1> slope{};
  std::array<double, N + 1> scale{};
  if constexpr (N > 0)
    for (std::size_t i = 0; i < std::size_t(N) && first + i < columns.slope.size(); ++i) {
      slope[i] = columns.slope[first + i].data();
      const std::size_t place = first + i, own = at.varied.size();
      scale[i] = place < own ? at.values[at.varied[place]] : place == own ? *at.n : *at.k;
      (place < own ? values[at.varied[place]] : place == own ? n : k).v[i] = DoubleLanes(1.0);
    }
  const Brdf<T> brdf = make_brdf<T>(at.model, values);
  constexpr std::size_t kBlock = 128;  // batches
  for (const LaneGroup& group : points.groups) {
    Interface<T> surface{T(DoubleLanes(group.surface.n)), T(DoubleLanes(group.surface.k)), group.surface.perfect};
    if (at.n) surface = {n, k, false};
    const T wavelength_um(DoubleLanes(group.wavelength_um));
    std::visit(
        [&]<class L>(const L& lobe) {
          const auto run = [&](std::size_t from, std::size_t to) {
            const FlushToZero flush;
            if constexpr (kPlainFacets<L>)
              if (!reflectance.empty())
                return lobe_batches<N, true, T>(lobe, brdf.retro, surface, wavelength_um, points, reflectance.data(),
                                                from, to, columns.value.data(), slope.data(), scale.data());
            lobe_batches<N, false, T>(lobe, brdf.retro, surface, wavelength_um, points, nullptr, from, to,
                                      columns.value.data(), slope.data(), scale.data());
          };
          const std::size_t end = group.first + group.batches;
          if (group.batches <= 2 * kBlock) return run(group.first, end);
          const std::size_t blocks = (group.batches + kBlock - 1) / kBlock;
          tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
            const std::size_t from = group.first + block * kBlock;
            run(from, std::min(from + kBlock, end));
          });
        },
        brdf.lobe);
  }
}

}  // namespace gonio
