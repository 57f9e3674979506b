// The scene file: every bundled scene is read; every kind of mistake is refused with its line.
#include "scene/scene_file.h"

#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "catch.h"
#include "scene/fitted.h"

using namespace gonio;

namespace {

const std::string kGood = R"(# a scene
camera: {position: [0, -6, 2], look_at: [0, 0, 1], fov_deg: 30, width: 64, height: 48}
materials:
  gold:
    model: torrance-sparrow
    material: Au
    set: {alpha: 0.2, kd: 0.1}
    shadowing: v-cavity
  paper: {model: lambert, set: {kd: 0.4}}
spheres:
  - {center: [0, 0, 1], radius: 1, material: gold}
ground: {radius: 20, material: paper}
lights:
  - {center: [-4, -3, 6.5], radius: 2, radiance: 9, illuminant: D65}
environment: {radiance: 0.35}
wavelengths_nm: {from: 400, to: 700, step: 10}
)";

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = kGood;
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& text) {
  try {
    parse_scene(text, "s.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a scene file says what is rendered", "[scene]") {
  const Scene scene = parse_scene(kGood, "s.yaml");
  CHECK(scene.camera.width == 64);
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials[0].material == "Au_Johnson");
  CHECK(scene.materials[0].model.first().shadowing == Shadowing::v_cavity);
  CHECK(scene.materials[0].values[0] == Approx(0.2 / std::sqrt(2)));
  CHECK(scene.materials[0].values[1] == 0.1);
  CHECK(scene.materials[0].values[2] == 1);
  CHECK(scene.spheres.at(0).material == 0);
  CHECK(scene.ground->material == 1);
  CHECK(scene.ground->height == 0);
  CHECK(scene.lights.at(0).emission.illuminant == "D65");
  CHECK(scene.wavelengths_nm.size() == 31);
  CHECK(parse_scene(replaced("{from: 400, to: 700, step: 10}", "532"), "s").wavelengths_nm == std::vector<double>{532});
  CHECK(parse_scene(replaced("{from: 400, to: 700, step: 10}", "[400, 532.5]"), "s").wavelengths_nm ==
        std::vector<double>{400, 532.5});
}

TEST_CASE("a material says what becomes of its energy", "[scene]") {
  const Scene plain = parse_scene(kGood, "s.yaml");
  CHECK(plain.materials[0].compensation == CompensationKind::none);
  CHECK_FALSE(plain.materials[0].may_gain);
  const Scene chosen = parse_scene(
      replaced("    shadowing: v-cavity\n", "    compensation: kulla-conty-2017\n    energy: allow-gain\n"), "s.yaml");
  CHECK(chosen.materials[0].compensation == CompensationKind::kulla_conty_2017);
  CHECK(chosen.materials[0].may_gain);
  CHECK_FALSE(chosen.materials[1].may_gain);
  CHECK(refusal(replaced("    shadowing: v-cavity\n", "    compensation: turquin\n")) ==
        "s.yaml:8: turquin: unknown compensation; expected none or kulla-conty-2017");
  CHECK(refusal(replaced("    shadowing: v-cavity\n", "    energy: more\n")) ==
        "s.yaml:8: energy is more; expected conserve or allow-gain");
}

TEST_CASE("a scene file's material may be a sum of lobes", "[scene]") {
  const auto sum = [](const std::string& set, const std::string& more = "") {
    return replaced("{model: lambert, set: {kd: 0.4}}", "{model: torrance-sparrow+ggx, set: {" + set +
                                                            "}, shadowing_1: v-cavity, retro_2: yes" + more + "}");
  };
  const std::string values = "alpha_1: 0.2, alpha_x_2: 0.3, alpha_y_2: 0.4, ks_2: 0.5, kd: 0.1";
  const Scene scene = parse_scene(sum(values), "s.yaml");
  const SceneMaterial& paper = scene.materials.at(1);
  CHECK(paper.model.name() == "torrance-sparrow+ggx");
  CHECK(paper.model.lobes()[0].shadowing == Shadowing::v_cavity);
  CHECK(paper.model.lobes()[1].retro);
  REQUIRE(paper.values.size() == 6);
  CHECK(paper.values[0] == Approx(0.2 / std::sqrt(2)));
  CHECK(std::vector(paper.values.begin() + 1, paper.values.end()) == std::vector{0.3, 0.4, 0.1, 1.0, 0.5});
  CHECK(refusal(sum(values + ", m_1: 0.2")).find("m_1 and alpha_1") != std::string::npos);
  CHECK(refusal(sum(values + ", ks: 0.2")).find("`ks`") != std::string::npos);
  CHECK(refusal(sum(values, ", shadowing: v-cavity")).find("shadowing") != std::string::npos);
  CHECK(refusal(sum(values, ", variant_3: exact")).find("variant_3") != std::string::npos);
}

TEST_CASE("a mistake in a scene is refused with its line", "[scene]") {
  struct Mistake {
    const char *from, *to, *line, *about;
  };
  const Mistake mistakes[] = {
      {"radius: 1,", "radius: 1, shine: 2,", "s.yaml:11:", "unknown key `shine`"},
      {"environment:", "surroundings:", "s.yaml:15:", "unknown key `surroundings`"},
      {"fov_deg: 30", "fov_deg: 0", "s.yaml:2:", "fov_deg"},
      {"fov_deg: 30", "fov_deg: nan", "s.yaml:2:", "fov_deg"},
      {"width: 64", "width: 64.5", "s.yaml:2:", "whole number"},
      {"width: 64", "width: 64, width: 65", "s.yaml:2:", "twice"},
      {"[0, -6, 2]", "[0, -6]", "s.yaml:2:", "point"},
      {"[0, -6, 2]", "[0, 0, 1.5]", "s.yaml:", "inside a sphere"},
      {"radius: 1,", "radius: -1,", "s.yaml:11:", "radius"},
      {"material: gold}", "material: brass}", "s.yaml:11:", "brass"},
      {"material: Au", "material: Unobtainium", "s.yaml:6:", "Unobtainium"},
      {"torrance-sparrow", "torrance", "s.yaml:5:", "torrance"},
      {"v-cavity", "w-cavity", "s.yaml:8:", "w-cavity"},
      {"{alpha: 0.2, kd: 0.1}", "{alpha: 0.2, m: 0.1}", "s.yaml:7:", "m and alpha"},
      {"{alpha: 0.2, kd: 0.1}", "{kd: 0.1}", "s.yaml:7:", "`m`"},
      {"{alpha: 0.2, kd: 0.1}", "{m: 0.2, shine: 1}", "s.yaml:7:", "shine"},
      {"{alpha: 0.2, kd: 0.1}", "{m: 100}", "s.yaml:7:", "m of"},
      {"{kd: 0.4}", "{kd: grey}", "s.yaml:9:", "grey"},
      {"illuminant: D65", "illuminant: Au_Johnson", "s.yaml:14:", "illuminant"},
      {"radiance: 9", "radiance: -9", "s.yaml:14:", "radiance"},
      {"[-4, -3, 6.5]", "[0, 0, 3]", "s.yaml:", "overlaps"},
      {"step: 10", "step: 1", "s.yaml:16:", "wavelengths"},
      {"from: 400, to: 700", "from: 700, to: 400", "s.yaml:16:", "to"},
      {"{from: 400, to: 700, step: 10}", "20000", "s.yaml:", "nm"},
      {"{from: 400, to: 700, step: 10}", "[500, 400]", "s.yaml:16:", "400"},
      {"{model: lambert, set: {kd: 0.4}}", "{fit: nowhere.json}", "s.yaml:9:", "nowhere.json"},
      {"camera:", "- camera:", "s.yaml:", "mapping"},
  };
  for (const Mistake& mistake : mistakes) {
    const std::string message = refusal(replaced(mistake.from, mistake.to));
    INFO(mistake.to << " -> " << message);
    CHECK(message.starts_with(mistake.line));
    CHECK(message.find(mistake.about) != std::string::npos);
    CHECK(message.find("expected") != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
  }
  for (const char* text : {"", "42", "[1, 2]", "\x01\x02\xff", "camera: {", "camera: {position: [0,0,0]}"})
    CHECK(refusal(text) != "accepted");
}

TEST_CASE("a room takes the place of ground and environment", "[scene]") {
  const std::string good = R"(camera: {position: [0, -2, 2], look_at: [0, 0, 1]}
materials:
  white: {model: lambert, set: {kd: 0.9}}
spheres:
  - {center: [0.7, 0, 0.3], radius: 0.3, material: white}
lights:
  - {center: [0, 0, 3], radius: 0.5, radiance: 9}
room:
  from: [-3, -3, 0]
  to: [1, 3, 4]
  material: white
  emission: {radiance: 2, illuminant: D65}
)";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  const Scene scene = parse_scene(good, "s.yaml");  // the sphere touches two walls
  REQUIRE(scene.room);
  CHECK(scene.room->lower == Vector(-3, -3, 0));
  CHECK(scene.room->upper == Vector(1, 3, 4));
  CHECK(scene.room->emission.radiance == 2);
  CHECK(scene.room->emission.illuminant == "D65");
  CHECK(parse_scene(with("  emission: {radiance: 2, illuminant: D65}\n", ""), "s").room->emission.radiance == 0);
  CHECK_NOTHROW(parse_scene(good + "environment: {radiance: 0}\n", "s"));

  struct Mistake {
    const char *from, *to, *line, *about;
  };
  const Mistake mistakes[] = {
      {"  from: [-3, -3, 0]\n", "", "s.yaml:9:", "no `from`"},
      {"[-3, -3, 0]", "[-3, -3]", "s.yaml:9:", "point"},
      {"[-3, -3, 0]", "[-3, -30000, 0]", "s.yaml:9:", "-30000"},
      {"[-3, -3, 0]", "[-3, 3, 0]", "s.yaml:9:", "from 3 to 3 in y"},
      {"[-3, -3, 0]", "[-3, 4, 0]", "s.yaml:9:", "from 4 to 3 in y"},
      {"[-3, -3, 0]", "[-3, -3, 3.99999]", "s.yaml:9:", "in z"},
      {"[-3, -3, 0]", "[0.5, -3, 0]", "s.yaml:9:", "camera is not inside"},
      {"[0, -2, 2]", "[0, -3, 2]", "s.yaml:9:", "camera is not inside"},
      {"[-3, -3, 0]", "[-3, -3, 0.01]", "s.yaml:9:", "sphere is not wholly inside"},
      {"[0, 0, 3]", "[0, 0, 3.6]", "s.yaml:9:", "light is not wholly inside"},
      {"  material: white\n", "  material: red\n", "s.yaml:11:", "`red`"},
      {"  material: white\n", "", "s.yaml:9:", "no `material`"},
      {"radiance: 2,", "radiance: -2,", "s.yaml:12:", "radiance"},
      {"radiance: 2,", "", "s.yaml:12:", "no `radiance`"},
      {"D65", "Au_Johnson", "s.yaml:12:", "illuminant"},
      {"D65", "D65, shine: 1", "s.yaml:12:", "shine"},
      {"  material: white\n", "  material: white\n  floor: white\n", "s.yaml:12:", "floor"},
      {"room:", "ground: {material: white}\nroom:", "s.yaml:10:", "a ground"},
      {"room:", "environment: {radiance: 1}\nroom:", "s.yaml:10:", "environment"},
  };
  for (const Mistake& mistake : mistakes) {
    const std::string message = refusal(with(mistake.from, mistake.to));
    INFO(mistake.to << " -> " << message);
    CHECK(message.starts_with(mistake.line));
    CHECK(message.find(mistake.about) != std::string::npos);
    CHECK(message.find("expected") != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
  }
}

TEST_CASE("every bundled scene can be read and says what it validates", "[scene]") {
  int scenes = 0;
  for (const auto& file : std::filesystem::directory_iterator(GONIO_SOURCE_DIR "/scenes")) {
    if (file.path().extension() != ".yaml") continue;
    INFO(file.path());
    CHECK_NOTHROW(read_scene(file.path()));
    CHECK(read_file(file.path()).starts_with("# Validates: "));
    ++scenes;
  }
  CHECK(scenes >= 7);
}

TEST_CASE("a fitted material renders where its fit speaks, and nowhere else", "[scene]") {
  FittedMaterial fitted;
  fitted.model = ModelSpec{ModelId::torrance_sparrow};
  fitted.values = {0.2, 0.1, 0.9};
  fitted.wavelength_nm = {532};
  CHECK(scene_material("a", fitted, {532}).material == "perfect");
  CHECK_THROWS_AS(scene_material("a", fitted, {532, 550}), InputError);
  fitted.material = "Al_Rakic";
  CHECK(scene_material("a", fitted, {450, 650}).material == "Al_Rakic");
  fitted.material.reset();
  fitted.n = 1.5;
  fitted.wavelength_nm.clear();
  CHECK(scene_material("a", fitted, {450}).fixed_interface->n == 1.5);
}

TEST_CASE("a fit with kd and ks of each wavelength is rendered with those of the scene's", "[scene]") {
  FittedMaterial fitted;
  fitted.model = ModelSpec{ModelId::torrance_sparrow};
  fitted.values = {0.2, 0.1, 0.9};
  fitted.wavelength_nm = {500, 600};
  fitted.by_wavelength = {{}, {0.1, 0.3}, {0.9, 0.5}};
  fitted.material = "Al_Rakic";
  const SceneMaterial material = scene_material("a", fitted, {500, 525, 600});
  REQUIRE(material.by_wavelength.size() == 3);
  for (std::size_t w = 0; w < 3; ++w) CHECK(material.by_wavelength[w][0] == 0.2);
  CHECK(material.by_wavelength[1][1] == Approx(0.15));
  CHECK(material.by_wavelength[1][2] == Approx(0.8));
  CHECK(material.by_wavelength[2][2] == Approx(0.5));
  CHECK_THROWS_AS(scene_material("a", fitted, {450, 550}), InputError);
}
