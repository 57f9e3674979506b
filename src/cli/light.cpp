#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/eye.h"
#include "materials/color_entries.h"
#include "spectrum/color_temperature.h"
#include "spectrum/photometry.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct LightArguments {
  std::string id, observer = "1931-2";
  std::optional<double> watts, lumens;
};

struct LightValues {
  std::string id, observer;
  double lo_nm, hi_nm;
  Xyz<double> white;
  Chromaticity<double> xy, uniform;
  ColorTemperature temperature;
  LuminousEfficacy efficacy;
  std::optional<double> watts;
  Xyz<double> absolute{};  ///< lm, with watts
};

Spectrum efficiency(const Database& database, const char* id) {
  const Entry& entry = database.find(id);
  return {entry.wavelength_nm, entry.columns[0]};
}

LightValues values_of(const LightArguments& arguments) {
  const Database& database = Database::bundled();
  const Entry& entry = database.find(arguments.id);
  const Spectrum light = light_of(entry);
  const Observer observer = observer_named(arguments.observer, database);
  const Factor diffuser{0, 1e9, [](double) { return 1.0; }, entry.id};
  LightValues v;
  v.id = entry.id, v.observer = sensor_named(arguments.observer, database).name;
  v.lo_nm = light.lo_nm(), v.hi_nm = light.hi_nm();
  v.white = color_of(diffuser, light, observer, true).white;
  v.xy = chromaticity(v.white), v.uniform = uniform_chromaticity(v.white);
  v.temperature = color_temperature(v.white, observer);
  v.efficacy = luminous_efficacy(light, efficiency(database, "V"), efficiency(database, "V-prime"));
  v.watts = arguments.watts;
  if (arguments.lumens) v.watts = *arguments.lumens / v.efficacy.photopic_lm_per_w;
  if (v.watts) {
    const Xyz<double> table = absolute_xyz(light, observer);
    const double scale = *v.watts / radiant(light);
    v.absolute = {table.x * scale, table.y * scale, table.z * scale};
  }
  return v;
}

Json light_json(const LightValues& v) {
  Json json{{"id", v.id},
            {"observer", v.observer},
            {"range_nm", {v.lo_nm, v.hi_nm}},
            {"XYZ", {v.white.x, v.white.y, v.white.z}},
            {"xy", {v.xy.x, v.xy.y}},
            {"uv_prime", {v.uniform.x, v.uniform.y}},
            {"color_temperature_K", v.temperature.kelvin},
            {"Duv", v.temperature.duv},
            {"color_temperature_meaningful", v.temperature.meaningful},
            {"photopic_lm_per_W", v.efficacy.photopic_lm_per_w},
            {"scotopic_lm_per_W", v.efficacy.scotopic_lm_per_w},
            {"scotopic_over_photopic", v.efficacy.scotopic_lm_per_w / v.efficacy.photopic_lm_per_w}};
  if (v.watts)
    json.update({{"radiant_W", *v.watts},
                 {"photopic_lm", *v.watts * v.efficacy.photopic_lm_per_w},
                 {"scotopic_lm", *v.watts * v.efficacy.scotopic_lm_per_w},
                 {"XYZ_absolute_lm", {v.absolute.x, v.absolute.y, v.absolute.z}}});
  return json;
}

std::string light_text(const LightValues& v) {
  const char* doubt = v.temperature.meaningful ? "" : " (too far from any black body to mean much)";
  std::string text = fmt::format("{}, {:g} to {:g} nm, observer {}\n", v.id, v.lo_nm, v.hi_nm, v.observer) +
                     fmt::format("  x, y          {:.5f} {:.5f}   (u', v' {:.5f} {:.5f})\n", v.xy.x, v.xy.y,
                                 v.uniform.x, v.uniform.y) +
                     fmt::format("  temperature   {:.0f} K correlated, Duv {:+.5f}{}\n", v.temperature.kelvin,
                                 v.temperature.duv, doubt) +
                     fmt::format("  efficacy      {:.2f} lm/W of its own range; scotopic {:.2f} lm/W ({:.3f} times)\n",
                                 v.efficacy.photopic_lm_per_w, v.efficacy.scotopic_lm_per_w,
                                 v.efficacy.scotopic_lm_per_w / v.efficacy.photopic_lm_per_w);
  if (v.watts)
    text += fmt::format("  flux          {:.6g} W, {:.6g} lm, scotopic {:.6g} lm; XYZ {:.6g} {:.6g} {:.6g} lm\n",
                        *v.watts, *v.watts * v.efficacy.photopic_lm_per_w, *v.watts * v.efficacy.scotopic_lm_per_w,
                        v.absolute.x, v.absolute.y, v.absolute.z);
  return text;
}

}  // namespace

void add_light(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand(
      "light", "A light by itself: chromaticity, correlated colour temperature, lumens a watt by day and by night");
  command->footer("Example: gonio light FL11 --lumens 3000\n         gonio light D65 --observer 1964-10 --json");
  add_common(*command, common);
  auto arguments = std::make_shared<LightArguments>();
  command->add_option("id", arguments->id, "Database id or alias of an illuminant")->required();
  command->add_option("--observer", arguments->observer, "Observer: an id, or FILE.csv with xbar, ybar, zbar")
      ->capture_default_str();
  auto* watts =
      command->add_option("--watts", arguments->watts, "Radiant flux within the light's table: also lumens, XYZ in lm");
  command->add_option("--lumens", arguments->lumens, "Luminous flux: also watts, XYZ in lm")->excludes(watts);
  command->callback([&common, arguments] {
    for (const auto& [name, value] : {std::pair{"--watts", arguments->watts}, std::pair{"--lumens", arguments->lumens}})
      if (value && !(*value > 0 && *value < 1e30))
        throw input_error("{} {}: out of range; expected more than 0", name, *value);
    const LightValues values = values_of(*arguments);
    std::cout << (common.json ? light_json(values).dump(2) + "\n" : light_text(values));
  });
}

}  // namespace gonio::cli
