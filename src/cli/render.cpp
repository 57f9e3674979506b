#include "render/render.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "cli/commands.h"
#include "cli/progress.h"
#include "image/exr.h"
#include "image/png.h"
#include "scene/scene_file.h"

namespace gonio::cli {
namespace {

struct Arguments {
  std::string scene, out, strategy = "mis", energy = "conserve";
  int spp = 64, width = 0, height = 0, max_depth = 8;
  double exposure = 1, at_nm = 0;
};

/// I.exr → I.png beside it.
std::filesystem::path png_beside(const std::filesystem::path& exr) {
  if (exr.extension() != ".exr") throw input_error("--out {}: is no .exr name; expected I.exr", exr.string());
  std::filesystem::path png = exr;
  return png.replace_extension(".png");
}

/// Root mean square of the standard errors over the image's mean radiance.
double relative_noise(const RenderResult& result) {
  double error2 = 0, signal = 0;
  for (std::size_t v = 0; v < result.variance.size(); ++v) {
    error2 += result.variance[v];
    signal += result.image.radiance[v];
  }
  const auto count = static_cast<double>(result.variance.size());
  return signal > 0 ? std::sqrt(error2 / count) / (signal / count) : 0;
}

void run(const Arguments& arguments, const Common& common) {
  Scene scene = read_scene(arguments.scene);
  if (arguments.width > 0) scene.camera.width = arguments.width;
  if (arguments.height > 0) scene.camera.height = arguments.height;
  if (arguments.at_nm > 0) scene.wavelengths_nm = {arguments.at_nm};
  const std::filesystem::path exr = arguments.out, png = png_beside(exr);
  for (const auto& path : {exr, png}) WholeFile refused_before_the_work(path);

  Progress progress("render");
  RenderSettings settings;
  settings.spp = arguments.spp;
  settings.max_depth = arguments.max_depth;
  settings.seed = common.seed;
  settings.threads = common.threads;
  settings.variance = common.json;
  settings.strategy = strategy_from(arguments.strategy);
  settings.progress = [&](double done) { progress.show(done); };
  if (arguments.energy == "allow-gain") settings.energy = EnergyRule::allow_gain;
  if (arguments.energy == "unchecked") settings.energy = EnergyRule::unchecked;
  const RenderResult result = render(scene, settings);
  for (const std::string& gain : result.gains) fmt::print(stderr, "render: {}\n", gain);
  if (result.dropped_paths > 0)
    fmt::print(stderr, "render: {} paths overflowed and count as black\n", result.dropped_paths);
  write_spectral_exr(exr, result.image);
  write_png(png, result.image, arguments.exposure);
  if (common.json) {
    const nlohmann::ordered_json json{{"exr", exr.string()},
                                      {"png", png.string()},
                                      {"width", scene.camera.width},
                                      {"height", scene.camera.height},
                                      {"wavelength_nm", scene.wavelengths_nm},
                                      {"spp", arguments.spp},
                                      {"seed", common.seed},
                                      {"dropped_paths", result.dropped_paths},
                                      {"gains", result.gains},
                                      {"relative_noise_rms", relative_noise(result)}};
    fmt::print("{}\n", json.dump(2));
  }
}

}  // namespace

void add_render(CLI::App& app, Common& common) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("render",
                                         "Renders a scene file: spectral path tracing, light and BRDF sampling "
                                         "combined. Writes I.exr (spectral OpenEXR with "
                                         "R, G, B for ordinary viewers) and I.png.\nExample: gonio render "
                                         "scenes/sphere-on-ground.yaml --out gold.exr --spp 256");
  command
      ->add_option("scene", arguments->scene,
                   "Scene file (YAML; see scenes/): spheres, lights, and a ground and environment or a room")
      ->required();
  command->add_option("-o,--out", arguments->out, "Image to write, I.exr; I.png appears beside it")->required();
  command->add_option("--spp", arguments->spp, "Paths a pixel")->capture_default_str()->check(CLI::Range(1, 100000000));
  command->add_option("--width", arguments->width, "Width in pixels, in place of the scene's")
      ->check(CLI::Range(1, 16384));
  command->add_option("--height", arguments->height, "Height in pixels, in place of the scene's")
      ->check(CLI::Range(1, 16384));
  command->add_option("--at", arguments->at_nm, "Render this one wavelength (nm), grey")->check(CLI::Range(100.0, 1e5));
  command
      ->add_option("--max-depth", arguments->max_depth,
                   "Most reflections of a path; between white walls take 1000, Russian roulette ends most sooner")
      ->capture_default_str()
      ->check(CLI::Range(0, 10000));
  command->add_option("--strategy", arguments->strategy, "mis, light or brdf: how lights are found")
      ->capture_default_str();
  command
      ->add_option(
          "--energy", arguments->energy,
          "conserve: a material that reflects more than it receives is refused; allow-gain: it is rendered, and said; "
          "unchecked: not looked at")
      ->capture_default_str()
      ->check(CLI::IsMember({"conserve", "allow-gain", "unchecked"}));
  command->add_option("--exposure", arguments->exposure, "Factor before the PNG's 8 bits; 1: radiance 1 is white")
      ->capture_default_str()
      ->check(CLI::Range(1e-12, 1e12));
  add_common(*command, common);
  command->callback([arguments, &common] { run(*arguments, common); });
}

}  // namespace gonio::cli
