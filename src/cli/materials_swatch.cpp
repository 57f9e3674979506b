#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/eye.h"
#include "cli/picture.h"
#include "fit/gnuplot.h"
#include "materials/color_entries.h"
#include "spectrum/adaptation.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kGamutMargin = 5e-4;  // of linear sRGB: less than half a step of 8 bits near white
constexpr int kCellWidth = 120, kCellHeight = 60, kGap = 6, kTop = 30, kFoot = 24;

struct SwatchArguments {
  std::vector<std::string> ids, lights{"D65"};
  std::string observer = "1931-2", adaptation = "bradford", out;
  bool allow_partial = false;
};

struct Swatch {
  std::string id, light;
  ColorSum sum;
  Rgb<double> linear;  ///< not clipped
  bool out_of_gamut;
  int red, green, blue;
};

int eight_bits(double linear) {
  return static_cast<int>(std::lround(255 * srgb_encoded(std::clamp(linear, 0.0, 1.0))));
}

Swatch swatch_of(const std::string& id, const Entry& light, const Observer& observer,
                 const SwatchArguments& arguments) {
  const Factor data = factor_of(id);
  Swatch swatch{data.name, light.id, color_of(data, light_of(light), observer, arguments.allow_partial), {}, false, 0,
                0,         0};
  const auto unit = [](const Xyz<double>& c) { return Xyz<double>{c.x / 100, c.y / 100, c.z / 100}; };
  Xyz<double> seen = unit(swatch.sum.xyz);
  if (arguments.adaptation == "bradford") seen = bradford_adapted(seen, unit(swatch.sum.white), srgb_white<double>());
  swatch.linear = linear_srgb(seen);
  const auto [r, g, b] = swatch.linear;
  swatch.out_of_gamut = std::min({r, g, b}) < -kGamutMargin || std::max({r, g, b}) > 1 + kGamutMargin;
  swatch.red = eight_bits(r), swatch.green = eight_bits(g), swatch.blue = eight_bits(b);
  return swatch;
}

/// A sheet: one row a material, one column a light, in blocks side by side; in pixels, y upwards for gnuplot.
class Sheet {
 public:
  Sheet(std::size_t materials, std::size_t lights, std::size_t longest_name)
      : label_(20 + 7 * static_cast<int>(longest_name)),
        block_(label_ + static_cast<int>(lights) * (kCellWidth + kGap) + kGap) {
    // About as high as wide.
    const double count = static_cast<double>(materials);
    rows_ = static_cast<int>(std::min(count, std::ceil(std::sqrt(count * block_ / (kCellHeight + kGap)))));
    blocks_ = static_cast<int>(std::ceil(count / rows_));
  }

  int width() const { return blocks_ * block_; }
  int height() const { return kTop + rows_ * (kCellHeight + kGap) + kFoot; }

  void name_light(std::size_t column, const std::string& name) {
    for (int b = 0; b < blocks_; ++b)
      text(b * block_ + label_ + static_cast<int>(column) * (kCellWidth + kGap), height() - kTop / 2, name);
  }
  void name_material(std::size_t row, const std::string& name) {
    text(left(row) + 8, bottom(row) + kCellHeight / 2, name);
  }
  void add(std::size_t row, std::size_t column, const Swatch& swatch) {
    const int x = left(row) + label_ + static_cast<int>(column) * (kCellWidth + kGap), y = bottom(row);
    script_ += fmt::format(
        "set object rect from {},{} to {},{} fc rgb '#{:02x}{:02x}{:02x}' fs solid 1.0 border lc rgb '#808080'\n", x, y,
        x + kCellWidth, y + kCellHeight, swatch.red, swatch.green, swatch.blue);
    if (swatch.out_of_gamut) mark(x + kCellWidth - 5, y + kCellHeight - 5, swatch.sum.xyz.y > 40 ? "black" : "white");
  }
  std::string script(const std::string& foot) {
    text(8, kFoot / 2, foot);
    return fmt::format(
        "unset border\nunset tics\nunset key\nset margins 0,0,0,0\nset xrange [0:{}]\nset yrange [0:{}]\n{}plot NaN\n",
        width(), height(), script_);
  }

 private:
  int left(std::size_t row) const { return static_cast<int>(row) / rows_ * block_; }
  int bottom(std::size_t row) const {
    return height() - kTop - (static_cast<int>(row) % rows_ + 1) * (kCellHeight + kGap) + kGap;
  }
  void text(int x, int y, const std::string& words) {
    script_ += fmt::format("set label '{}' at {},{} left font ',10'\n", gnuplot_text(words), x, y);
  }
  void mark(int x, int y, const char* colour) {
    script_ += fmt::format(
        "set object polygon from {0},{1} to {2},{1} to {0},{3} to {0},{1} fc rgb '{4}' fs solid 1.0 border lc rgb "
        "'#808080'\n",
        x, y, x - 16, y - 16, colour);
  }

  int label_, block_, rows_, blocks_;
  std::string script_;
};

Json json_of(const Swatch& s) {
  return {{"id", s.id},
          {"light", s.light},
          {"XYZ", {s.sum.xyz.x, s.sum.xyz.y, s.sum.xyz.z}},
          {"linear_sRGB", {s.linear.r, s.linear.g, s.linear.b}},
          {"sRGB_8bit", {s.red, s.green, s.blue}},
          {"out_of_gamut", s.out_of_gamut}};
}

void draw(const SwatchArguments& arguments, bool json) {
  const Database& database = Database::bundled();
  const Observer observer = observer_named(arguments.observer, database);
  std::size_t longest = 0;
  for (const std::string& id : arguments.ids) longest = std::max(longest, factor_of(id).name.size());
  Sheet sheet(arguments.ids.size(), arguments.lights.size(), longest);
  Json cells = Json::array();
  int outside = 0;
  for (std::size_t l = 0; l < arguments.lights.size(); ++l) {
    const Entry& light = database.find(arguments.lights[l]);
    sheet.name_light(l, light.id);
    for (std::size_t m = 0; m < arguments.ids.size(); ++m) {
      const Swatch swatch = swatch_of(arguments.ids[m], light, observer, arguments);
      if (l == 0) sheet.name_material(m, swatch.id);
      sheet.add(m, l, swatch);
      cells.push_back(json_of(swatch));
      outside += swatch.out_of_gamut;
    }
  }
  const std::string foot =
      fmt::format("observer {}, {}{}", sensor_named(arguments.observer, database).name,
                  arguments.adaptation == "bradford" ? "adapted to the light (Bradford)" : "not adapted: white is D65",
                  outside > 0 ? "; corner: outside sRGB, clipped" : "");
  const std::string out = arguments.out.empty() ? database.full_id(arguments.ids[0]) + "-swatch.png" : arguments.out;
  write_picture(out, sheet.script(foot), std::max(sheet.width(), 420), sheet.height());
  if (json)
    std::cout << Json{{"out", out},
                      {"observer", arguments.observer},
                      {"adaptation", arguments.adaptation},
                      {"swatches", cells}}
                     .dump(2)
              << '\n';
  else
    std::cout << fmt::format("wrote {}: {} swatches, {} outside sRGB\n", out, cells.size(), outside);
}

}  // namespace

void add_materials_swatch(CLI::App& materials, Common& common) {
  auto* command = materials.add_subcommand(
      "swatch", "What entries look like at normal incidence: sRGB, one row a material, one column a light");
  command->footer(
      "The perfect diffuser is white. Colours outside sRGB are clipped and marked in a corner.\n"
      "Example: gonio materials swatch Au Ag Cu --light D65 A FL11 --out metals.png");
  add_common(*command, common);
  auto arguments = std::make_shared<SwatchArguments>();
  command->add_option("ids", arguments->ids, "Ids or aliases of materials, reflectances, transmittances, or `perfect`")
      ->required();
  command->add_option("--light", arguments->lights, "Illuminants")->capture_default_str();
  command->add_option("--observer", arguments->observer, "Observer: an id, or FILE.csv with xbar, ybar, zbar")
      ->capture_default_str();
  command
      ->add_option("--adaptation", arguments->adaptation,
                   "bradford: as an eye adapted to the light sees it; none: white is D65, other lights tint")
      ->check(CLI::IsMember({"bradford", "none"}))
      ->capture_default_str();
  command->add_flag("--allow-partial", arguments->allow_partial,
                    "Accept data that leaves out over 1 % of the visible power");
  command->add_option("-o,--out", arguments->out, "FILE.png or FILE.svg (default: the first full id, -swatch.png)");
  command->callback([&common, arguments] { draw(*arguments, common.json); });
}

}  // namespace gonio::cli
