#include <iostream>
#include <memory>

#include "assess/fit_stability.h"
#include "assess/kramers_kronig_charts.h"
#include "assess/table_stability.h"
#include "base/error.h"
#include "cli/commands.h"

namespace gonio::cli {

void add_assess_stability(CLI::App& assess, Common& common) {
  auto* command = assess.add_subcommand(
      "stability",
      "brdf: where reflection models fail, published forms beside ours, worst points, energy, validity; "
      "kramers-kronig: n, k from reflectance on cut bands, against metals whose n, k are known, and how wide an "
      "interval is honest; fit: what is recovered of known surfaces, which starts end where, scans that mislead; "
      "tables: errors of the tables of directional reflectance over width and incidence, and beyond what they hold");
  command->footer("Example: gonio assess stability brdf --out out/brdf-stability");
  add_common(*command, common);
  struct Arguments {
    std::string what, out;
  };
  auto arguments = std::make_shared<Arguments>();
  command->add_option("what", arguments->what, "brdf, fit, kramers-kronig or tables")->required();
  command->add_option("-o,--out", arguments->out, "Folder for CSV tables, SVG plots and README.md (out/assess/WHAT)");
  command->callback([arguments] {
    const auto progress = [](const std::string& line) { std::cerr << line << '\n'; };
    const std::string out = arguments->out.empty() ? "out/assess/" + arguments->what : arguments->out;
    if (arguments->what == "brdf")
      write_brdf_stability(out);
    else if (arguments->what == "fit")
      write_fit_stability(out, progress);
    else if (arguments->what == "kramers-kronig")
      write_kramers_kronig_charts(out);
    else if (arguments->what == "tables")
      write_table_stability(out, progress);
    else
      throw input_error("gonio assess stability: no map {}; expected brdf, fit, kramers-kronig or tables",
                        arguments->what);
    std::cout << out << '\n';
  });
}

}  // namespace gonio::cli
