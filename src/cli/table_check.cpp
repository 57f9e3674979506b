// gonio table check: what a table of E loses against the quadrature it stands for, on every material of the database.
#include "energy/table_check.h"

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/progress.h"
#include "energy/energy_file.h"
#include "materials/surfaces.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckArguments {
  std::string file;
  std::size_t denser = 4, random = 100000;
};

Json place_json(const TableError& at, const std::vector<NamedSurface>& surfaces) {
  const NamedSurface& worst = surfaces[at.surface];
  return {{"error", at.error},
          {"theta_deg", at.theta_deg},
          {"alpha", at.alpha},
          {"material", worst.id},
          {"wavelength_nm", worst.wavelength_nm}};
}

void run(const CheckArguments& a, Common& common) {
  const EnergyTable table = read_energy_table(a.file);
  check_is_current(table);
  std::vector<NamedSurface> held;
  std::vector<Interface<double>> interfaces;
  const Lobe<double> lobe = table.family().lobe(0.5);
  std::vector<NamedSurface> all = database_surfaces();
  all.push_back({"perfect", 0, perfect_interface<double>()});
  for (const NamedSurface& one : all)
    if (node_error(lobe, one.interface, reflectance_at_nodes(lobe, one.interface)) <= kMostNodeError)
      held.push_back(one), interfaces.push_back(one.interface);
  Progress progress("table check");
  const TableCheck check =
      check_table(table, interfaces, a.denser, a.random, [&](double done) { progress.show(done); });
  const double worst = std::max(check.dense.error, check.random.error);
  common.exit_code = worst <= EnergyTable::kError ? 0 : 1;
  if (common.json) {
    std::cout << Json{{"family", table.family().name},
                      {"surfaces", held.size()},
                      {"surfaces_integrated_instead", all.size() - held.size()},
                      {"dense", place_json(check.dense, held)},
                      {"random", place_json(check.random, held)},
                      {"margin", check.margin()},
                      {"bound", EnergyTable::kError}}
                     .dump(2)
              << '\n';
    return;
  }
  fmt::print("{}: {} surfaces of the database ({} more are integrated instead)\n", table.family().name, held.size(),
             all.size() - held.size());
  for (const auto& [what, at] : {std::pair("denser grid", check.dense), std::pair("random", check.random)})
    fmt::print("  {:<12} {:.2e} at {:.4f} degrees, alpha {:.4g}, {} at {:g} nm\n", what, at.error, at.theta_deg,
               at.alpha, held[at.surface].id, held[at.surface].wavelength_nm);
  fmt::print("  margin {:+.1e}; bound {:g}: {}\n", check.margin(), EnergyTable::kError,
             common.exit_code == 0 ? "holds" : "does not hold");
}

}  // namespace

void add_table_check(CLI::App& table, Common& common) {
  auto* command = table.add_subcommand(
      "check", "What a table loses, on a denser grid and at random places, on every solid and liquid");
  command->footer(
      "Example: gonio table check out/tables/ggx-v-cavity.exr --random 2000 --denser 2\nExit 1: the bound does not "
      "hold.");
  add_common(*command, common);
  auto a = std::make_shared<CheckArguments>();
  command->add_option("table", a->file, "A table (.exr)")->required();
  command->add_option("--denser", a->denser, "Times denser each way")->check(CLI::Range(1, 16))->capture_default_str();
  command->add_option("--random", a->random, "Random places")->check(CLI::Range(1, 100000000))->capture_default_str();
  command->callback([&common, a] { run(*a, common); });
}

}  // namespace gonio::cli
