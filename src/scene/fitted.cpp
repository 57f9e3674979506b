#include "scene/fitted.h"

namespace gonio {

SceneMaterial scene_material(std::string name, const FittedMaterial& fitted,
                             const std::vector<double>& wavelengths_nm) {
  for (const double nm : wavelengths_nm) (void)fitted.wavelength(nm);
  SceneMaterial material{std::move(name), fitted.model.first(), fitted.values, fitted.material.value_or("perfect"), {}};
  if (fitted.n) material.fixed_interface = Interface<double>{*fitted.n, 0, false};
  return material;
}

}  // namespace gonio
