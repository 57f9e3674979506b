#include "fit/fit.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>

#include "base/error.h"
#include "base/files.h"
#include "cli/arguments.h"
#include "cli/choice_report.h"
#include "cli/commands.h"
#include "cli/diagnosed.h"
#include "cli/fit_options.h"
#include "fit/choose.h"
#include "fit/formats/formats.h"
#include "fit/plots.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct FitArguments {
  std::string measurement, out;
  std::vector<std::string> models;
  FitOptions options;
  bool by_wavelength = false;
  std::optional<double> tolerance;  ///< ΔE_2000
};

/// Progress on stderr: a line rewritten on a terminal, else one line every few seconds; nothing below a second.
class Progress {
 public:
  explicit Progress(std::string what) : what_(std::move(what)) {}
  ~Progress() {
    if (shown_ && terminal_) std::cerr << "\r\033[K";
  }
  void operator()(int done, int count) { operator()("", done, count, "starts"); }
  void operator()(const std::string& part, int done, int count, const char* of = "models") {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < (terminal_ ? std::chrono::seconds(1) : std::chrono::seconds(5)) && !(shown_ && terminal_)) return;
    shown_ = true;
    last_ = now;
    std::cerr << fmt::format("{}{}{}{}: {} of {} {}{}", terminal_ ? "\r\033[K" : "", what_, part.empty() ? "" : ", ",
                             part, done, count, of, terminal_ ? "" : "\n")
              << std::flush;
  }

 private:
  std::string what_;
  bool terminal_ = ::isatty(STDERR_FILENO) == 1, shown_ = false;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void print_card(const FitResult& result, const Json& json) {
  std::cout << fmt::format("{} of {} ({})\n", result.model.described(),
                           result.name.empty() ? result.measurement_id : result.name,
                           result.material       ? *result.material
                           : result.absorption() ? "n, k fitted"
                           : result.index()      ? "n fitted"
                                                 : "material not stated: F = 1");
  for (const FittedParameter& p : result.parameters) {
    const std::string error =
        p.standard_error ? fmt::format(" +- {:.2g}  (95 %: {:.6g} to {:.6g})", *p.standard_error, p.lo95, p.hi95)
        : p.held         ? " (held)"
        : p.interval95_kind == "profile"
            ? fmt::format("  (95 %: {:.6g}{} to {:.6g}{})", p.lo95, p.lo_open ? ", the box's end," : "", p.hi95,
                          p.hi_open ? ", the box's end" : "")
            : "";
    std::cout << fmt::format("  {:<15} {:.7g}{}{}{}{}\n", p.name, p.value, p.unit == "1" ? "" : " " + p.unit, error,
                             p.at_bound ? "  at its bound" : "", p.identifiable ? "" : "  not identifiable");
  }
  std::cout << fmt::format(
      "  rms {:.4g} ({} metric, weighting {}), rms_log10 {:.4g}, {} points, {} of {} starts converged\n",
      result.all.rms, name_of(result.metric), name_of(result.weighting), result.all.rms_log10, result.points_used,
      result.starts_converged, result.starts);
  if (result.held_out)
    std::cout << fmt::format("  left out: incidence {:g} degrees, {} points, rms_log10 {:.4g}\n",
                             result.held_out->theta_i_deg, result.held_out->points, result.held_out->rms_log10);
  if (json.at("polarisation").contains("sentence"))
    std::cout << "  " << json["polarisation"]["sentence"].get<std::string>() << '\n';
  for (const std::string& warning : result.warnings) std::cout << "  warning: " << warning << '\n';
  if (result.next_measurement) std::cout << "  next: " << sentence(*result.next_measurement) << '\n';
}

/// One row a model, the best first in no particular order of trust: the reader judges by the held-out error.
void print_summary(const std::vector<FitResult>& results) {
  std::cout << fmt::format("\n{:<20} {:>12} {:>12} {:>12}\n", "model", "rms_log10", "held out", "converged");
  for (const FitResult& r : results)
    std::cout << fmt::format("{:<20} {:>12.4g} {:>12} {:>12}\n", r.model.name(), r.all.rms_log10,
                             r.held_out ? fmt::format("{:.4g}", r.held_out->rms_log10) : "none",
                             r.converged ? "yes" : "no");
}

void write_result(const FitResult& result, const Json& json, const std::filesystem::path& folder) {
  make_folder(folder);
  write_plots(result, folder);
  write_file(folder / "fit.json", json.dump(2) + "\n");
}

/// --model auto: the chosen fit in OUT as if its model had been named, beside choice.csv.
void run_choice(const Measurement& scan, const FitArguments& arguments, Common& common) {
  Progress progress("auto");
  const ChosenFit chosen =
      chosen_fit(scan, arguments.options, common.seed, arguments.tolerance,
                 [&](const std::string& what, int done, int count) { progress(what, done, count); });
  const std::filesystem::path out = arguments.out;
  write_result(chosen.result, chosen.json, out);
  write_file(out / "choice.csv", choice_csv(chosen.choice, chosen.seen));
  if (!chosen.result.converged) common.exit_code = 1;
  if (common.json) {
    std::cout << chosen.json.dump(2) << '\n';
  } else {
    print_choice(chosen.choice, chosen.seen);
    print_card(chosen.result, chosen.json);
  }
}

/// --by-wavelength: a fit of its own for each, in OUT/<nm>nm, and one table of their parameters.
void run_by_wavelength(const Measurement& scan, const FitArguments& arguments, Common& common) {
  const std::vector<double> wavelengths = scan.wavelengths();
  if (wavelengths.size() < 2 || arguments.models.size() != 1 || arguments.models[0] == "auto")
    throw input_error("--by-wavelength: {} wavelengths and {} models; expected 2 or more wavelengths and one model",
                      wavelengths.size(), arguments.models.size());
  const FitRequest request = request_for(arguments.options, arguments.models[0], common.seed, scan.aperture_deg);
  const std::filesystem::path out = arguments.out;
  Json json = Json::array();
  std::string csv;
  for (const double nm : wavelengths) {
    const Measurement one = at_wavelength(scan, nm);
    FitResult result = fit(one, request);
    json.push_back(diagnosed(one, arguments.options, result));
    write_result(result, json.back(), out / fmt::format("{:g}nm", nm));
    if (!common.json) print_card(result, json.back());
    if (!result.converged) common.exit_code = 1;
    if (csv.empty()) {
      csv = "wavelength_nm";
      for (const FittedParameter& p : result.parameters) csv += fmt::format(",{0},{0}_lo95,{0}_hi95", p.name);
      csv += ",rms_log10\n";
    }
    csv += fmt::format("{:g}", nm);
    for (const FittedParameter& p : result.parameters) csv += fmt::format(",{},{},{}", p.value, p.lo95, p.hi95);
    csv += fmt::format(",{}\n", result.all.rms_log10);
  }
  write_file(out / "fits.json", json.dump(2) + "\n");
  write_file(out / "by_wavelength.csv", csv);
  if (common.json) std::cout << json.dump(2) << '\n';
}

void run_fit(const FitArguments& arguments, Common& common) {
  const Measurement scan = cleaned(read_any(arguments.measurement), arguments.options);
  for (const std::string& convention : scan.conventions) std::cerr << "read as: " << convention << '\n';
  for (const std::string& note : scan.notes) std::cerr << "note: " << note << '\n';
  const bool automatic = std::find(arguments.models.begin(), arguments.models.end(), "auto") != arguments.models.end();
  if (arguments.tolerance && !automatic) throw input_error("--tolerance: is for --model auto; expected it with that");
  if (arguments.by_wavelength) return run_by_wavelength(scan, arguments, common);
  if (automatic) {
    if (arguments.models.size() > 1) throw input_error("--model auto: with other models; expected it alone");
    return run_choice(scan, arguments, common);
  }
  std::vector<FitRequest> requests;
  for (const std::string& name : arguments.models)
    requests.push_back(request_for(arguments.options, name, common.seed, scan.aperture_deg));
  std::vector<FitResult> results;
  for (FitRequest& request : requests) {
    Progress progress(request.model.name());
    request.progress = [&progress](int done, int count) { progress(done, count); };
    results.push_back(fit(scan, request));
  }
  const std::filesystem::path out = arguments.out;
  Json json = Json::array();
  for (FitResult& result : results) {
    json.push_back(diagnosed(scan, arguments.options, result));
    write_result(result, json.back(), results.size() == 1 ? out : out / result.model.name());
    if (!common.json) print_card(result, json.back());
    if (!result.converged) common.exit_code = 1;
  }
  if (results.size() > 1) write_file(out / "fits.json", json.dump(2) + "\n");
  if (common.json)
    std::cout << (results.size() == 1 ? json[0] : json).dump(2) << '\n';
  else if (results.size() > 1)
    print_summary(results);
}

}  // namespace

void add_fit(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand("fit", "Fit reflection models to a goniophotometric scan");
  command->footer(
      "Example: gonio fit measurements/aluminium-merl --model torrance-sparrow --out out\n"
      "         gonio fit measurements/retro-tape-yellow --model ggx+phong-1975 --set retro_2=yes --out out   (a sum of lobes)\n"
      "Writes OUT/fit.json and plots of measured against fitted values (several models: a folder each, and "
      "fits.json).\n"
      "Metrics: log compares ln(f + f0), linear f*cos_o, cuberoot (f*cos_o)^(1/3),\n"
      "likelihood (f - y)/s. Exit 1: a fit did not converge.");
  add_common(*command, common);
  auto a = std::make_shared<FitArguments>();
  command
      ->add_option("measurement", a->measurement,
                   "Folder (scan.csv + measurement.yaml), CSV or foreign file (see `gonio measurements`)")
      ->required();
  command
      ->add_option(
          "--model", a->models,
          "One or more models, see `gonio models`, or sums of up to three, a+b; auto: the simplest that these data cannot tell from the best")
      ->required();
  add_fit_options(*command, a->options);
  command
      ->add_option(
          "--tolerance", a->tolerance,
          "auto: a still simpler model will do whose lit sphere differs from the best one's by no more Delta E 2000")
      ->check(CLI::Range(0.01, 100.0));
  command->add_flag("--by-wavelength", a->by_wavelength,
                    "Every wavelength with parameters of its own: a folder each, and by_wavelength.csv");
  command->add_option("-o,--out", a->out, "Folder to write")->required();
  command->callback([&common, a] { run_fit(*a, common); });
}

}  // namespace gonio::cli
