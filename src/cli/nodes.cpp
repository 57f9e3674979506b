// gonio table nodes: one table of a lobe for every material, and E from it.
#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "brdf/directions.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "energy/node_file.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kError = 1e-4;  // of the default grid: tests/energy/node_table_test.cpp

struct NodesArguments {
  std::string model, out, angles = "0,30,60,80,89";
  std::vector<std::string> settings;
  SurfaceArguments surface;
  std::optional<double> at_nm;
};

/// name=value; InputError for another name.
std::string setting(const NodesArguments& a, const std::string& name) {
  std::string value;
  for (const std::string& given : a.settings) {
    if (!given.starts_with(name + "=")) throw input_error("--set {}: unknown here; expected {}=…", given, name);
    value = given.substr(name.size() + 1);
  }
  return value;
}

void make(const NodesArguments& a) {
  ModelSpec spec;
  spec.id = model(a.model).id;
  if (const std::string shadowing = setting(a, "shadowing"); !shadowing.empty()) set_shadowing(spec, shadowing);
  if (a.out.empty()) throw input_error("{}: nowhere to write its table; expected --out N.exr", a.model);
  if (a.surface.given()) throw input_error("--material, --n: a table is of every material; expected none");
  write_node_table(NodeTable(spec), a.out);
}

void look_up(const NodesArguments& a, const Common& common) {
  const NodeTable table = read_node_table(a.model);
  const std::string text = setting(a, "m");
  if (text.empty()) throw input_error("{}: m is not given; expected --set m=0.2", a.model);
  const double m = number_in(text, "m");
  if (!(m >= NodeTable::kNarrowest && m <= table.widest()))
    throw input_error("m={}: outside the table; expected {} to {}", m, NodeTable::kNarrowest, table.widest());
  const Surface surface(a.surface);
  if (surface.needs_wavelength() && !a.at_nm)
    throw input_error("{}: needs a wavelength; expected --at NM", surface.name());
  const Interface<double> at = surface.at(a.at_nm.value_or(0));
  Json rows = Json::array();
  for (const double theta : number_list(a.angles, "--angles", 0, 90))
    rows.push_back({{"theta_deg", theta}, {"E", table.reflectance(cos_deg(theta), m, at)}, {"error", kError}});
  if (common.json) {
    std::cout << Json{{"model", table.spec().info().name}, {"m", m}, {"material", surface.name()}, {"E", rows}}.dump(2)
              << '\n';
    return;
  }
  fmt::print("{}, m = {:g}, on {}\n{:>10} {:>12}   (within {:g})\n", table.spec().info().name, m, surface.name(),
             "theta_deg", "E (ks = 1)", kError);
  for (const Json& row : rows)
    fmt::print("{:>10g} {:>12.6f}\n", row["theta_deg"].get<double>(), row["E"].get<double>());
}

}  // namespace

void add_table_nodes(CLI::App& table, Common& common) {
  auto* command = table.add_subcommand("nodes", "One table of a lobe for every material, and E from it");
  command->footer(
      "Example: gonio table nodes torrance-sparrow --set shadowing=v-cavity --out N.exr\n"
      "         gonio table nodes N.exr --set m=0.2 --material Au --at 550 --angles 0,45,80\n"
      "Lobes of Gaussian slopes, m 0.01 to 2. A table is a few hundred kilobytes: eight angles of the facets and their "
      "weights at each\n"
      "place, so that E is the sum of eight reflectances. It is made in a second and holds within 1e-4.");
  add_common(*command, common);
  auto a = std::make_shared<NodesArguments>();
  command->add_option("model", a->model, "Model to tabulate, or a table (.exr) to look up")->required();
  command->add_option("--set", a->settings, "shadowing=NAME of a model; m=VALUE in a table")->allow_extra_args(false);
  a->surface.add_to(*command);
  command->add_option("--at", a->at_nm, "Wavelength in nm");
  command->add_option("--angles", a->angles, "Angles in degrees, 0 to 90")->capture_default_str();
  command->add_option("-o,--out", a->out, "OpenEXR file to write (a CSV of E beside it)");
  command->callback([&common, a] {
    if (a->model.ends_with(".exr"))
      look_up(*a, common);
    else
      make(*a);
  });
}

}  // namespace gonio::cli
