#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/commands.h"
#include "materials/color_entries.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ColorArguments {
  std::string id, light = "D65", observer = "1931-2";
  std::vector<std::string> difference;
  bool allow_partial = false;
};

struct NamedColor {
  std::string id, light, observer;  ///< full ids
  ColorSum sum;
  ColorValues values;
};

NamedColor color_by_id(const std::string& id, const ColorArguments& arguments) {
  const Database& database = Database::bundled();
  const Entry &light = database.find(arguments.light), &observer = database.find(arguments.observer);
  const Factor data = factor_of(id, database);
  const ColorSum sum = color_of(data, light_of(light), observer_of(observer), arguments.allow_partial);
  return {data.name, light.id, observer.id, sum, color_values(sum)};
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

void print_color(const ColorArguments& arguments, bool json) {
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
      "Example: gonio color Au --light D65 --observer 1931-2\n         gonio color --difference Au Cu --json");
  add_common(*command, common);
  auto arguments = std::make_shared<ColorArguments>();
  command->add_option("id", arguments->id, "Database id or alias of a material or reflectance, or `perfect`");
  command->add_option("--light", arguments->light, "Illuminant")->capture_default_str();
  command->add_option("--observer", arguments->observer, "Observer")->capture_default_str();
  command->add_option("--difference", arguments->difference, "Two ids: the differences of their colours")->expected(2);
  command->add_flag("--allow-partial", arguments->allow_partial,
                    "Accept data that leaves out over 1 % of the visible power");
  command->callback([&common, arguments] {
    if (arguments->id.empty() == arguments->difference.empty())
      throw input_error("gonio color: {}; expected an ID or --difference A B",
                        arguments->id.empty() ? "no material" : "both an ID and --difference");
    arguments->id.empty() ? print_difference(*arguments, common.json) : print_color(*arguments, common.json);
  });
}

}  // namespace gonio::cli
