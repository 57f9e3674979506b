#pragma once
#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace gonio {

/// A scene file (YAML). Keys, with their defaults in brackets; angles in degrees:
///   camera:       {position, look_at, fov_deg [30], width [320], height [240]}
///   materials:    name: {model, material [perfect], set: {parameter: value, …}, shadowing, variant}, or
///                 {fit: fit.json}
///   spheres:      list of {center, radius, material}
///   ground:       {height [0], radius [100], material}
///   lights:       list of {center, radius, radiance, illuminant [constant]}
///   room:         {from, to, material, emission [{radiance: 0}]}: a closed box, from its lower to its upper corner,
///                 around everything else, in place of a ground and an environment; emission as an environment
///   environment:  {radiance, illuminant [constant]}
///   wavelengths_nm: one number, a list, or {from, to, step}  [390 to 700 in steps of 10]
/// Radiance is the spectral radiance at 560 nm, scaled along the illuminant. Unknown keys are refused. InputError
/// `file:line: …` for anything that cannot be rendered.
Scene read_scene(const std::filesystem::path& path);

/// The same from text; `file` names it in errors, and paths to fit.json start from its folder.
Scene parse_scene(const std::string& text, const std::string& file);

}  // namespace gonio
