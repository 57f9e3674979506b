#include "materials/surfaces.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "materials/database.h"

namespace gonio {
namespace {

bool is_gas(const Interface<double>& surface) { return surface.n > 1 && surface.n < 1.01 && surface.k < 1e-3; }

}  // namespace

std::vector<NamedSurface> database_surfaces(double step_nm) {
  std::vector<NamedSurface> all;
  for (const Entry* entry : Database::bundled().all()) {
    if (entry->kind != "optical-constants") continue;
    const SurfaceMaterial material(entry->id);
    const double from = std::max(280.0, std::ceil(material.range_lo_nm() / step_nm) * step_nm);
    for (double nm = from; nm <= std::min(1100.0, material.range_hi_nm()); nm += step_nm) {
      Interface<double> surface;
      try {
        surface = material.at(nm);
      } catch (const InputError&) {
        continue;  // k is not known there
      }
      if (!is_gas(surface)) all.push_back({entry->id, nm, surface});
    }
  }
  return all;
}

}  // namespace gonio
