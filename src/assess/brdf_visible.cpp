// What an error looks like: a sphere of gold, its colours by a variant beside those by the exact form.
#include "assess/brdf_speed.h"
#include "materials/database.h"

namespace gonio {

VisibleError visible_error(const ModelSpec& spec, const ModelSpec& exact, const std::vector<double>& values) {
  const SurfaceMaterial gold("Au", Database::bundled());
  std::vector<double> wavelength_nm;
  for (double nm = 380; nm <= 780; nm += 10) wavelength_nm.push_back(nm);
  std::vector<Interface<double>> surfaces;
  for (const double nm : wavelength_nm) surfaces.push_back(gold.at(nm));
  const auto evaluated = [&](const ModelSpec& model) -> BrdfOfPair {
    return [&, brdf = make_brdf<double>(model, values)](const UnitVector<double>& i, const UnitVector<double>& o,
                                                        std::size_t c) {
      return evaluate(brdf, reduce(i.x, i.y, i.z, o.x, o.y, o.z), surfaces[c], wavelength_nm[c] * 1e-3);
    };
  };
  return sphere_difference(evaluated(exact), evaluated(spec), wavelength_nm);
}

}  // namespace gonio
