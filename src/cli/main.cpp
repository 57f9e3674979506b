#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <new>

#include "base/error.h"
#include "cli/commands.h"

namespace gonio::cli {

void add_common(CLI::App& command, Common& common) {
  command.add_flag("--json", common.json, "Machine-readable output, unrounded");
  command.add_option("--threads", common.threads, "Number of threads (0: all cores); results do not depend on it")
      ->check(CLI::Range(0, 1024));
  command.add_option("--seed", common.seed, "Seed of everything random");
}

namespace {

/// One line on stderr, whatever the message holds.
void complain(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  std::cerr << text << '\n';
}

int run(int argc, char** argv) {
  Common common;
  CLI::App app{"gonio validates materials against measurements: fits reflection models to goniophotometric scans, checks "
               "energy conservation, renders the result.\nExample: gonio validate measurements/aluminium-merl --out out"};
  app.name("gonio");
  app.set_version_flag("--version", "gonio 0.1.0");
  app.require_subcommand(1);
  add_materials(app, common);
  add_fresnel(app, common);
  add_surface(app, common);
  add_color(app, common);
  add_light(app, common);
  add_models(app, common);
  add_eval(app, common);
  add_measurements(app, common);
  add_fit(app, common);
  add_export(app, common);
  add_batch(app, common);
  add_table(app, common);
  add_render(app, common);
  add_assess(app, common);
  add_validate(app, common);
  add_report(app, common);

  std::unique_ptr<tbb::global_control> limit;
  app.parse_complete_callback([&] {
    if (common.threads > 0)
      limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(common.threads));
  });
  const auto commands = app.get_subcommands([](CLI::App*) { return true; });
  if (argc > 1 && argv[1][0] != '-' &&
      std::none_of(commands.begin(), commands.end(), [&](const CLI::App* known) { return known->check_name(argv[1]); }))
    throw input_error("gonio {}: unknown subcommand; expected one of those in `gonio --help`", argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);  // --help, --version
  } catch (const CLI::ParseError& error) {
    complain(fmt::format("gonio: {}; expected arguments as in `gonio --help`", error.what()));
    return 2;
  }
  return common.exit_code;
}

}  // namespace
}  // namespace gonio::cli

int main(int argc, char** argv) {
  try {
    const int exit_code = gonio::cli::run(argc, argv);
    // What could not be written (a full disk, a closed pipe) is no success.
    if (!std::cout.flush() || std::fflush(stdout) != 0)
      throw gonio::input_error("gonio: standard output cannot be written; expected a writable one");
    return exit_code;
  } catch (const gonio::InputError& error) {
    gonio::cli::complain(error.what());
  } catch (const std::bad_alloc&) {
    gonio::cli::complain("gonio: not enough memory; expected a smaller problem");
  } catch (const std::exception& error) {
    gonio::cli::complain(fmt::format("gonio: {}; expected valid input", error.what()));
  }
  return 2;
}
