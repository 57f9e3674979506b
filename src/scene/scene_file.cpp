#include "scene/scene_file.h"

#include <cmath>

#include "base/error.h"
#include "base/files.h"
#include "materials/database.h"
#include "scene/fitted.h"
#include "scene/yaml_map.h"

namespace gonio {
namespace {

constexpr double kBrightest = 1e12;
constexpr std::size_t kMostObjects = 1000;

/// Runs a step of reading; what it refuses is told with the line of the key it read.
template <class Step>
auto at_line(const YamlMap& map, std::string_view key, Step step) {
  try {
    return step();
  } catch (const InputError& error) {
    throw input_error("{}:{}: {}", map.file(), map.line(key), shown(error.what(), 400));
  }
}

Camera read_camera(YamlMap map) {
  Camera camera;
  camera.position = map.point("position");
  camera.look_at = map.point("look_at");
  camera.fov_deg = map.number_or("fov_deg", 0.1, 170, camera.fov_deg);
  if (map.has("width")) camera.width = map.integer("width", 1, 16384);
  if (map.has("height")) camera.height = map.integer("height", 1, 16384);
  map.finish();
  return camera;
}

Emission read_emission(YamlMap& map) {
  Emission emission{map.number("radiance", 0, kBrightest), map.text_or("illuminant", "constant")};
  at_line(map, "illuminant", [&] { return radiance_at(emission, 560); });
  return emission;
}

/// {radiance, illuminant}, and nothing else.
Emission read_only_emission(YamlMap map) {
  const Emission emission = read_emission(map);
  map.finish();
  return emission;
}

/// "alpha" for "m", "alpha_2" for "m_2"; empty where the parameter is no m.
std::string alpha_for(std::string_view parameter) {
  if (parameter != "m" && !parameter.starts_with("m_")) return "";
  return fmt::format("alpha{}", parameter.substr(1));
}

/// Values in the model's order; alpha = √2·m may stand for m.
std::vector<double> read_values(YamlMap map, const LobeSum& model) {
  std::vector<double> values;
  for (const ParameterInfo& p : model.parameters()) {
    const std::string alpha = alpha_for(p.name);
    const bool by_alpha = !alpha.empty() && map.has(alpha);
    if (by_alpha && map.has(p.name))
      throw map.error(map.at(alpha), fmt::format("{} and {} are both given", p.name, alpha),
                      "exactly one (alpha = sqrt(2) m)");
    if (by_alpha) {
      values.push_back(map.number(alpha, p.lo * std::sqrt(2), p.hi * std::sqrt(2)) / std::sqrt(2));
    } else if (p.fallback) {
      values.push_back(map.number_or(p.name, p.lo, p.hi, *p.fallback));
    } else {
      values.push_back(map.number(p.name, p.lo, p.hi));
    }
  }
  map.finish();
  return values;
}

/// What holds for a model and a fit alike.
void read_energy_choices(YamlMap& map, SceneMaterial& material) {
  if (const std::string name = map.text_or("compensation", ""); !name.empty())
    material.compensation = at_line(map, "compensation", [&] { return compensation_from(name); });
  const std::string rule = map.text_or("energy", "conserve");
  if (rule != "conserve" && rule != "allow-gain")
    throw map.error(map.at("energy"), fmt::format("energy is {}", shown(rule)), "conserve or allow-gain");
  material.may_gain = rule == "allow-gain";
}

/// {fit: path}, from the scene file's folder.
SceneMaterial read_fitted(const std::string& name, YamlMap map, const std::vector<double>& wavelengths_nm) {
  const std::filesystem::path path = std::filesystem::path(map.file()).parent_path() / map.text("fit");
  SceneMaterial material = at_line(map, "fit", [&] {
    std::error_code none;
    if (!std::filesystem::is_regular_file(path, none))
      throw input_error("{}: is no file; expected a fit.json", path.string());
    return scene_material(name, read_fit(path), wavelengths_nm);
  });
  read_energy_choices(map, material);
  map.finish();
  return material;
}

/// shadowing, variant and retro; of a sum with the suffix of the lobe.
void read_choices(YamlMap& map, LobeSum& model) {
  for (std::size_t j = 0; j < model.lobes().size(); ++j) {
    const std::string suffix = model.is_sum() ? fmt::format("_{}", j + 1) : "";
    for (const std::string name : {"shadowing", "variant", "retro"}) {
      const std::string key = name + suffix, value = map.text_or(key, "");
      if (!value.empty()) at_line(map, key, [&] { model.set(key, value); });
    }
  }
}

SceneMaterial read_material(const std::string& name, YamlMap map, const std::vector<double>& wavelengths_nm) {
  if (map.has("fit")) return read_fitted(name, map, wavelengths_nm);
  SceneMaterial material;
  material.name = name;
  const std::string model_name = map.text("model"), id = map.text_or("material", "perfect");
  at_line(map, "model", [&] { material.model = lobe_sum(model_name); });
  read_choices(map, material.model);
  read_energy_choices(map, material);
  if (id != "perfect") at_line(map, "material", [&] { material.material = SurfaceMaterial(id).id(); });
  if (map.has("set")) {
    material.values = read_values(map.map("set"), material.model);
  } else {
    material.values = read_values(YamlMap(YAML::Load("{}"), map.file(), name), material.model);
  }
  map.finish();
  return material;
}

std::size_t material_index(YamlMap& map, const Scene& scene) {
  const std::string name = map.text("material");
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    if (scene.materials[m].name == name) return m;
  std::vector<std::string> known;
  for (const SceneMaterial& material : scene.materials) known.push_back(shown(material.name));
  throw map.error(map.at("material"), fmt::format("no material is called `{}`", shown(name)),
                  fmt::format("one of {}", fmt::join(known, ", ")));
}

std::vector<YamlMap> list_of_maps(YamlMap& map, std::string_view key, std::string_view one) {
  const YAML::Node list = map.at(key);
  if (!list.IsSequence() || list.size() > kMostObjects)
    throw map.error(list, fmt::format("{} is no list", key), fmt::format("a list of at most {}", kMostObjects));
  std::vector<YamlMap> maps;
  for (const auto& item : list) maps.emplace_back(item, map.file(), std::string(one));
  return maps;
}

Room read_room(YamlMap map, const Scene& scene) {
  Room room{map.point("from"), map.point("to"), material_index(map, scene)};
  if (map.has("emission")) room.emission = read_only_emission(map.map("emission"));
  map.finish();
  return room;
}

void read_objects(YamlMap& map, Scene& scene) {
  if (map.has("spheres")) {
    for (YamlMap& one : list_of_maps(map, "spheres", "a sphere")) {
      scene.spheres.push_back(
          {one.point("center"), one.number("radius", kLeastRadius, kFarthest), material_index(one, scene)});
      one.finish();
    }
  }
  if (map.has("ground")) {
    YamlMap one = map.map("ground");
    scene.ground = GroundObject{one.number_or("height", -kFarthest, kFarthest, 0),
                                one.number_or("radius", kLeastRadius, kFarthest, 100), material_index(one, scene)};
    one.finish();
  }
  if (map.has("lights")) {
    for (YamlMap& one : list_of_maps(map, "lights", "a light")) {
      scene.lights.push_back({one.point("center"), one.number("radius", kLeastRadius, kFarthest), read_emission(one)});
      one.finish();
    }
  }
  if (map.has("room")) scene.room = read_room(map.map("room"), scene);
}

/// {from, to, step}
std::vector<double> read_range(YamlMap map) {
  const double from = map.number("from", 100, 1e5), to = map.number("to", from, 1e5),
               step = map.number("step", 1e-3, 1e5);
  map.finish();
  const double steps = std::floor((to - from) / step + 1e-9);
  if (steps >= static_cast<double>(kMaxWavelengths))
    throw map.error(map.at("step"), fmt::format("{} wavelengths", steps + 1),
                    fmt::format("at most {}", kMaxWavelengths));
  std::vector<double> all;
  for (int w = 0; w <= static_cast<int>(steps); ++w) all.push_back(from + step * w);
  return all;
}

std::vector<double> read_wavelengths(YamlMap& map) {
  const YAML::Node node = map.at("wavelengths_nm");
  if (node.IsMap()) return read_range(map.map("wavelengths_nm"));
  if (!node.IsSequence()) return {map.number("wavelengths_nm", 100, 1e5)};
  if (node.size() == 0 || node.size() > kMaxWavelengths)
    throw map.error(node, fmt::format("{} wavelengths", node.size()), fmt::format("1 to {}", kMaxWavelengths));
  std::vector<double> all;
  for (const auto& one : node) {
    all.push_back(map.number_of(one, "wavelengths_nm", all.empty() ? 100 : all.back(), 1e5));
    if (all.size() > 1 && all.back() == all[all.size() - 2])
      throw map.error(one, "a wavelength appears twice", "increasing wavelengths");
  }
  return all;
}

/// Every material must be known at every wavelength.
void check_materials(YamlMap materials, const Scene& scene) {
  for (const SceneMaterial& material : scene.materials) {
    if (material.material == "perfect" || material.fixed_interface) continue;
    const SurfaceMaterial surface(material.material);
    at_line(materials.map(material.name), "material", [&] {
      for (const double nm : scene.wavelengths_nm) surface.at(nm);
    });
  }
}

}  // namespace

Scene parse_scene(const std::string& text, const std::string& file) {
  YamlMap map(parse_yaml(text, file), file, "the scene");
  Scene scene;
  scene.camera = read_camera(map.map("camera"));
  scene.wavelengths_nm = map.has("wavelengths_nm") ? read_wavelengths(map) : visible_wavelengths();
  YamlMap materials = map.map("materials");
  for (const std::string& name : materials.keys())
    scene.materials.push_back(read_material(name, materials.map(name), scene.wavelengths_nm));
  read_objects(map, scene);
  if (map.has("environment")) scene.environment = read_only_emission(map.map("environment"));
  map.finish();
  check_materials(materials, scene);
  if (scene.room) at_line(map, "room", [&] { check_room(scene); });
  at_line(map, "", [&] { check(scene); });
  return scene;
}

Scene read_scene(const std::filesystem::path& path) { return parse_scene(read_file(path), path.string()); }

}  // namespace gonio
