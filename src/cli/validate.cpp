#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <set>

#include "base/error.h"
#include "base/files.h"
#include "cli/commands.h"
#include "fit/formats/formats.h"
#include "reports/validation.h"

namespace gonio::cli {
namespace {

namespace fs = std::filesystem;

struct ValidateArguments {
  std::vector<std::string> measurements;
  std::string out = "out";
  int spp = 512;
};

std::vector<std::string> bundled_measurements() {
  std::vector<std::string> folders;
  for (const auto& entry : fs::directory_iterator(data_folder("measurements")))
    if (fs::exists(entry.path() / "scan.csv")) folders.push_back(entry.path().string());
  std::sort(folders.begin(), folders.end());
  return folders;
}

void run_validate(const ValidateArguments& arguments, const Common& common) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Measurement> measurements;
  std::set<std::string> ids;
  for (const std::string& path : arguments.measurements.empty() ? bundled_measurements() : arguments.measurements) {
    measurements.push_back(read_any(path));
    for (const std::string& convention : measurements.back().conventions)
      std::cerr << fmt::format("{}: read as {}\n", path, convention);
    if (!ids.insert(measurements.back().id).second)
      throw input_error("{}: two measurements have this name; expected one folder each", measurements.back().id);
  }
  ValidationSettings settings;
  settings.spp = arguments.spp;
  settings.seed = common.seed;
  settings.threads = common.threads;
  settings.progress = [&](const std::string& line) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::cerr << fmt::format("[{:6.1f} s] {}\n", seconds, line);
  };
  const fs::path out = arguments.out;
  make_folder(out);
  WholeFile refused_before_the_work(out / "report.html");
  std::vector<MaterialReport> reports;
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Measurement& measurement : measurements) {
    reports.push_back(validate_measurement(measurement, out / measurement.id, settings));
    json.push_back(to_json(reports.back()));
  }
  write_file(out / "report.html", validation_page(reports, out));
  settings.progress("report: " + (out / "report.html").string());
  if (common.json) std::cout << json.dump(2) << '\n';
}

}  // namespace

void add_validate(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand("validate", "The main job: fit -> limits -> table -> renders -> report.html");
  command->footer("Example: gonio validate                                     the bundled measurements\n"
                  "         gonio validate my-scan/ --out out/my-scan          a folder with scan.csv and measurement.yaml, or a CSV");
  add_common(*command, common);
  auto arguments = std::make_shared<ValidateArguments>();
  command->add_option("measurements", arguments->measurements, "Folders (scan.csv + measurement.yaml), CSV or foreign files; none: the bundled ones");
  command->add_option("-o,--out", arguments->out, "Folder for the report and its files")->capture_default_str();
  command->add_option("--spp", arguments->spp, "Paths a pixel of the renders")->capture_default_str()->check(CLI::Range(1, 1000000));
  command->callback([&common, arguments] { run_validate(*arguments, common); });
}

}  // namespace gonio::cli
