#pragma once
// cli: the `gonio` command. One file a subcommand; each reads arguments, calls the library, writes.
#include <CLI/CLI.hpp>
#include <cstdint>

namespace gonio::cli {

/// What every subcommand takes. A subcommand stores its outcome in exit_code (0 done, 1 the thing asked for does not hold).
struct Common {
  bool json = false;
  int threads = 0;  ///< 0 = all cores
  std::uint64_t seed = 1;
  int exit_code = 0;
};

/// Adds --json, --threads, --seed to a subcommand.
void add_common(CLI::App& command, Common& common);

void add_materials(CLI::App& app, Common& common);
void add_materials_import(CLI::App& materials, Common& common);
void add_materials_kk(CLI::App& materials, Common& common);
void add_materials_value(CLI::App& materials, Common& common);
void add_materials_plot(CLI::App& materials, Common& common);
void add_materials_swatch(CLI::App& materials, Common& common);
void add_fresnel(CLI::App& app, Common& common);
void add_surface(CLI::App& app, Common& common);
void add_color(CLI::App& app, Common& common);
void add_light(CLI::App& app, Common& common);
void add_models(CLI::App& app, Common& common);
void add_eval(CLI::App& app, Common& common);
void add_fit(CLI::App& app, Common& common);
void add_export(CLI::App& app, Common& common);
void add_batch(CLI::App& app, Common& common);
void add_table(CLI::App& app, Common& common);
void add_table_instrument(CLI::App& table, Common& common);
void add_table_scatter(CLI::App& table, Common& common);
void add_table_lookup(CLI::App& table, Common& common);
void add_table_check(CLI::App& table, Common& common);
void add_render(CLI::App& app, Common& common);
void add_assess(CLI::App& app, Common& common);
void add_measurements(CLI::App& app, Common& common);
void add_validate(CLI::App& app, Common& common);
void add_report(CLI::App& app, Common& common);
void add_assess_stability(CLI::App& assess, Common& common);

}  // namespace gonio::cli
