#pragma once
#include <string>

#include "fit/fitted_material.h"
#include "scene/scene.h"

namespace gonio {

/// A fitted material to render. InputError when the fit says nothing about one of the scene's wavelengths: fitted
/// elsewhere, with no database material to carry it over, or kd and ks of their own at its wavelengths.
SceneMaterial scene_material(std::string name, const FittedMaterial& fitted, const std::vector<double>& wavelengths_nm);

}  // namespace gonio
