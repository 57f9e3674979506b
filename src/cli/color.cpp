#include <fmt/format.h>

#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "cli/commands.h"
#include "cli/eye.h"
#include "materials/color_entries.h"
#include "spectrum/astm_e2022.h"
#include "spectrum/metamer.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ColorArguments {
  std::string id, light = "D65", observer = "1931-2", sum = "1nm", metamer_under, out;
  std::vector<std::string> difference;
  bool allow_partial = false;
};

/// The steps of ASTM E2022 weights, by the name of the variant; 0: the sum at 1 nm.
const std::map<std::string, int> kSums{{"1nm", 0}, {"astm-e2022-5", 5}, {"astm-e2022-10", 10}, {"astm-e2022-20", 20}};

struct NamedColor {
  std::string id, light, observer;  ///< full ids
  ColorSum sum;
  ColorValues values;
};

/// By weights at the whole steps within what the direct sum covers, whose share left out stays.
ColorSum weighed_sum(const Factor& data, const Spectrum& light, const Observer& observer, int step,
                     const ColorSum& direct) {
  const double first = std::ceil(direct.lo_nm / step) * step, last = std::floor(direct.hi_nm / step) * step;
  ColorSum sum = color_by_weights(data, astm_e2022_weights(light, observer, first, last, step));
  sum.share_left_out = direct.share_left_out;
  return sum;
}

NamedColor color_by_id(const std::string& id, const ColorArguments& arguments) {
  const Database& database = Database::bundled();
  const Entry& light = database.find(arguments.light);
  const Observer observer = observer_named(arguments.observer, database);
  const Factor data = factor_of(id, database);
  ColorSum sum = color_of(data, light_of(light), observer, arguments.allow_partial);
  if (const int step = kSums.at(arguments.sum); step > 0) sum = weighed_sum(data, light_of(light), observer, step, sum);
  return {data.name, light.id, sensor_named(arguments.observer, database).name, sum, color_values(sum)};
}

Json color_json(const NamedColor& color) {
  const ColorValues& v = color.values;
  return {{"id", color.id},
          {"light", color.light},
          {"observer", color.observer},
          {"range_nm", {color.sum.lo_nm, color.sum.hi_nm}},
          {"share_left_out", color.sum.share_left_out},
          {"XYZ", {v.xyz.x, v.xyz.y, v.xyz.z}},
          {"xyY", {v.xy.x, v.xy.y, v.xyz.y}},
          {"Lab", {v.lab.l, v.lab.a, v.lab.b}},
          {"Luv", {v.luv.l, v.luv.u, v.luv.v}}};
}

std::string color_text(const NamedColor& color) {
  const ColorValues& v = color.values;
  return fmt::format("{} under {}, observer {}, {:g} to {:g} nm ({:.3g} % of the visible power left out)\n", color.id,
                     color.light, color.observer, color.sum.lo_nm, color.sum.hi_nm, 100 * color.sum.share_left_out) +
         fmt::format("  XYZ     {:.4f} {:.4f} {:.4f}\n", v.xyz.x, v.xyz.y, v.xyz.z) +
         fmt::format("  xyY     {:.5f} {:.5f} {:.4f}\n", v.xy.x, v.xy.y, v.xyz.y) +
         fmt::format("  L*a*b*  {:.3f} {:.3f} {:.3f}\n", v.lab.l, v.lab.a, v.lab.b) +
         fmt::format("  L*u*v*  {:.3f} {:.3f} {:.3f}\n", v.luv.l, v.luv.u, v.luv.v);
}

/// What a sensor that is no colorimetric observer answers: a response a channel.
void print_responses(const ColorArguments& arguments, const Sensor& sensor, bool json) {
  const Database& database = Database::bundled();
  const Entry& light = database.find(arguments.light);
  const Factor data = factor_of(arguments.id, database);
  const auto responses = responses_of(data, light_of(light), sensor, arguments.allow_partial);
  Json channels = Json::object();
  std::string text =
      fmt::format("{} under {}, seen by {} (100: the perfect diffuser)\n", data.name, light.id, sensor.name);
  double left_out = 0;
  for (const Response& response : responses) {
    channels[response.channel] = response.value;
    text += fmt::format("  {:<12} {:.4f}\n", response.channel, response.value);
    left_out = std::max(left_out, response.share_left_out);
  }
  const Json out{{"id", data.name},
                 {"light", light.id},
                 {"observer", sensor.name},
                 {"share_left_out", left_out},
                 {"responses", channels}};
  std::cout << (json ? out.dump(2) + "\n" : text);
}

void write_metamer(const Metamer& metamer, const std::string& path) {
  std::string csv = "wavelength_nm,reflectance,metamer\n";
  for (std::size_t i = 0; i < metamer.original.value.size(); ++i)
    csv += fmt::format("{},{},{}\n", metamer.original.wavelength_nm[i], metamer.original.value[i],
                       metamer.reflectance.value[i]);
  write_file(path, csv);
}

void print_metamer(const ColorArguments& arguments, bool json) {
  const Database& database = Database::bundled();
  const Entry &first = database.find(arguments.light), &second = database.find(arguments.metamer_under);
  const Factor data = factor_of(arguments.id, database);
  const Metamer metamer = metamer_of(data, light_of(first), light_of(second),
                                     observer_named(arguments.observer, database), arguments.allow_partial);
  if (!arguments.out.empty()) write_metamer(metamer, arguments.out);
  const auto lab_json = [](const ColorSum& sum) {
    const Lab<double> lab = color_values(sum).lab;
    return Json{lab.l, lab.a, lab.b};
  };
  if (json) {
    const Json out{{"id", data.name},
                   {"lights", {first.id, second.id}},
                   {"delta_E_2000", {metamer.delta_e_first, metamer.delta_e_second}},
                   {"Lab", {lab_json(metamer.first_original), lab_json(metamer.second_original)}},
                   {"Lab_metamer", {lab_json(metamer.first), lab_json(metamer.second)}},
                   {"rms_second_difference_per_nm2", metamer.roughness_added},
                   {"wavelength_nm", metamer.reflectance.wavelength_nm},
                   {"reflectance", metamer.original.value},
                   {"metamer", metamer.reflectance.value}};
    std::cout << out.dump(2) << '\n';
    return;
  }
  std::cout << fmt::format("{}: a smooth metamer under {}: Delta E_2000 {:.2g} there, {:.3f} under {}{}\n", data.name,
                           first.id, metamer.delta_e_first, metamer.delta_e_second, second.id,
                           metamer.delta_e_second > 0 ? "" : " (none exists among smooth reflectances of 0 to 1)");
}

void print_color(const ColorArguments& arguments, bool json) {
  if (const Sensor sensor = sensor_named(arguments.observer); !is_colorimetric(sensor))
    return print_responses(arguments, sensor, json);
  const NamedColor color = color_by_id(arguments.id, arguments);
  std::cout << (json ? color_json(color).dump(2) + "\n" : color_text(color));
}

void print_difference(const ColorArguments& arguments, bool json) {
  const NamedColor p = color_by_id(arguments.difference[0], arguments),
                   q = color_by_id(arguments.difference[1], arguments);
  const ColorDifference difference = color_difference(p.values, q.values);
  if (json) {
    const Json out{{"delta_E_ab", difference.ab},
                   {"delta_E_uv", difference.uv},
                   {"delta_E_2000", difference.e2000},
                   {"colors", {color_json(p), color_json(q)}}};
    std::cout << out.dump(2) << '\n';
    return;
  }
  std::cout << color_text(p) << color_text(q)
            << fmt::format("difference: Delta E_ab {:.3f}, Delta E_uv {:.3f}, Delta E_2000 {:.3f}\n", difference.ab,
                           difference.uv, difference.e2000);
}

}  // namespace

void add_color(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand(
      "color", "Colour of a material under a light: XYZ, xyY, L*a*b*, L*u*v*; optical constants at normal incidence");
  command->footer(
      "Example: gonio color Au --light D65 --observer 1931-2\n         gonio color --difference Au Cu --json\n"
      "         gonio color Au --observer film.csv\n         gonio color brick --metamer-under A --out metamer.csv");
  add_common(*command, common);
  auto arguments = std::make_shared<ColorArguments>();
  command->add_option("id", arguments->id, "Database id or alias of a material or reflectance, or `perfect`");
  command->add_option("--light", arguments->light, "Illuminant")->capture_default_str();
  command
      ->add_option("--observer", arguments->observer,
                   "Observer: an id, or FILE.csv (wavelength_nm and a column a channel: a film, a sensor)")
      ->capture_default_str();
  command
      ->add_option("--sum", arguments->sum,
                   "How: at 1 nm, or by weights for reflectances at 5, 10 or 20 nm (astm-e2022-5, …)")
      ->check(CLI::IsMember(kSums))
      ->capture_default_str();
  command->add_option("--metamer-under", arguments->metamer_under,
                      "Another light: a smooth metamer of the ID under --light, and how it differs under this");
  command->add_option("-o,--out", arguments->out, "The metamer as a CSV");
  command->add_option("--difference", arguments->difference, "Two ids: the differences of their colours")->expected(2);
  command->add_flag("--allow-partial", arguments->allow_partial,
                    "Accept data that leaves out over 1 % of the visible power");
  command->callback([&common, arguments] {
    if (arguments->id.empty() == arguments->difference.empty())
      throw input_error("gonio color: {}; expected an ID or --difference A B",
                        arguments->id.empty() ? "no material" : "both an ID and --difference");
    if (!arguments->metamer_under.empty() && arguments->id.empty())
      throw input_error("--metamer-under: given with --difference; expected an ID");
    if (!arguments->out.empty() && arguments->metamer_under.empty())
      throw input_error("--out: given without --metamer-under; expected both");
    if (arguments->id.empty()) return print_difference(*arguments, common.json);
    if (!arguments->metamer_under.empty()) return print_metamer(*arguments, common.json);
    print_color(*arguments, common.json);
  });
}

}  // namespace gonio::cli
