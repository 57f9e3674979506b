#include "fit/lobe_lanes.h"

#include "brdf/lanes.h"

namespace gonio {

std::vector<DoubleLanes> facet_reflectances(const LanePoints& points, const LobeAt& at) {
  const Brdf<DoubleLanes> brdf = spread_brdf<DoubleLanes>(at.model, at.values);
  std::vector<DoubleLanes> all(points.batches());
  for (const LaneGroup& group : points.groups) {
    const Interface<DoubleLanes> surface = spread<DoubleLanes>(group.surface);
    for (std::size_t batch = group.first; batch < group.first + group.batches; ++batch) {
      Directions<DoubleLanes> w = points.directions(batch);
      if (brdf.retro) w = turned_back(w);
      all[batch] =
          std::visit([&](const auto& lobe) { return facet_reflectance<DoubleLanes>(lobe, w, surface); }, brdf.lobe);
    }
  }
  return all;
}

void evaluate_lobe(const LanePoints& points, const LobeAt& at, std::span<const DoubleLanes> reflectance, bool slopes,
                   LobeColumns& columns) {
  const std::size_t count = slopes ? at.slopes() : 0;
  columns.value.resize(points.batches());
  columns.slope.resize(count);
  for (auto& column : columns.slope) column.resize(points.batches());
  if (count == 0) return lobe_pass<0>(points, at, reflectance, 0, columns);
  for (std::size_t first = 0; first < count;) {
    const std::size_t left = count - first;
    if (left == 1)
      lobe_pass<1>(points, at, reflectance, first, columns), first += 1;
    else if (left == 2)
      lobe_pass<2>(points, at, reflectance, first, columns), first += 2;
    else
      lobe_pass<4>(points, at, reflectance, first, columns), first += 4;
  }
}

}  // namespace gonio
