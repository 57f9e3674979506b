#include "scene/fitted.h"

namespace gonio {

SceneMaterial scene_material(std::string name, const FittedMaterial& fitted,
                             const std::vector<double>& wavelengths_nm) {
  SceneMaterial material{std::move(name), fitted.model, fitted.values, fitted.material.value_or("perfect"), {}};
  for (const double nm : wavelengths_nm) {
    const std::vector<double> values = fitted.values_at(fitted.wavelength(nm));
    if (fitted.is_spectral()) material.by_wavelength.push_back(values);
  }
  if (fitted.n) material.fixed_interface = Interface<double>{*fitted.n, fitted.k.value_or(0), false};
  return material;
}

}  // namespace gonio
