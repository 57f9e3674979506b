#include <iostream>
#include <memory>

#include "assess/brdf_speed_charts.h"
#include "assess/fit_speed.h"
#include "assess/interpolation_charts.h"
#include "assess/table_speed.h"
#include "assess/wavelength_charts.h"
#include "base/error.h"
#include "cli/commands.h"

namespace gonio::cli {
namespace {

struct AssessArguments {
  std::string what, out;
  bool thorough = false;
};

void assess_speed(const AssessArguments& arguments) {
  const std::string out = arguments.out.empty() ? "out/assess/" + arguments.what : arguments.out;
  if (arguments.what == "interpolation") {
    write_interpolation_speed(out);
  } else if (arguments.what == "wavelengths") {
    search_wavelengths(out, arguments.thorough, [](const std::string& line) { std::cerr << line << '\n'; });
  } else if (arguments.what == "brdf") {
    write_brdf_speed(out, [](const std::string& line) { std::cerr << line << '\n'; });
  } else if (arguments.what == "fit") {
    write_fit_speed(out, [](const std::string& line) { std::cerr << line << '\n'; });
  } else if (arguments.what == "tables") {
    write_table_speed(out, [](const std::string& line) { std::cerr << line << '\n'; });
  } else {
    throw input_error("gonio assess speed: no chart {}; expected brdf, fit, interpolation, tables or wavelengths",
                      arguments.what);
  }
  std::cout << out << '\n';
}

}  // namespace

void add_assess(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand("assess", "Charts of accuracy against cost, made from the code");
  command->require_subcommand(1);
  command->footer("Example: gonio assess speed interpolation --out out/interpolation");
  auto* speed = command->add_subcommand(
      "speed",
      "interpolation: what each variant loses on the database (every second point left out) and costs a lookup; "
      "wavelengths: nodes against worst Delta E_2000 for scenes of many products; brdf: every model and variant, ns an "
      "evaluation "
      "against its error in 50 digits and on a lit sphere; fit: what a fit costs and how near the truth it comes, "
      "beside "
      "Ceres; tables: size and time of tables of directional reflectance against their error, beside quadrature, "
      "sampling and renderers' tables");
  speed->footer(
      "Example: gonio assess speed brdf --out out/brdf-speed\n         gonio assess speed wavelengths "
      "--thorough --out out/wavelengths");
  add_common(*speed, common);
  auto arguments = std::make_shared<AssessArguments>();
  speed->add_option("what", arguments->what, "brdf, fit, interpolation, tables or wavelengths")->required();
  speed->add_option("-o,--out", arguments->out, "Folder for CSV tables, SVG plots and README.md (out/assess/WHAT)");
  speed->add_flag("--thorough", arguments->thorough, "Wavelengths: the long search too (a quarter of an hour)");
  speed->callback([arguments] { assess_speed(*arguments); });
  add_assess_stability(*command, common);
}

}  // namespace gonio::cli
