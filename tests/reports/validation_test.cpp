#include "reports/validation.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "base/files.h"
#include "brdf/brdf.h"
#include "catch.h"

using namespace gonio;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("gonio-validation-test-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

/// A scan of a perfect pseudo-realistic surface, without noise.
Measurement synthetic_scan(double m, double kd, double ks) {
  std::string csv = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr,wavelength_nm\n";
  const std::vector<double> values{m, kd, ks};
  const Brdf<double> brdf = make_brdf<double>({ModelId::pseudo_realistic}, values);
  for (const int ti : {10, 30, 50, 70})
    for (int to = 0; to <= 80; to += 10)
      for (const int phi : {0, 90, 180})
        csv += fmt::format("{},0,{},{},{},550\n", ti, to, phi,
                           evaluate(brdf, directions_from_deg(double(ti), double(to), double(phi)), perfect_interface<double>(), 0.55));
  Measurement scan = parse_scan(csv, "synthetic.csv");
  scan.id = "synthetic";
  return scan;
}

ValidationSettings quick(int threads) {
  ValidationSettings settings;
  settings.spp = 2;
  settings.starts = 4;
  settings.threads = threads;
  return settings;
}

}  // namespace

TEST_CASE("A material that breaks (43) is found, its number told, and rendered also at the limit", "[reports]") {
  const Folder out;
  const double m = 0.9, kd = 0.1, ks = 1;
  const MaterialReport report = validate_measurement(synthetic_scan(m, kd, ks), out.path / "synthetic", quick(0));
  CHECK(report.fit().model.first().id == ModelId::pseudo_realistic);
  CHECK(report.fit().value("m") == Approx(m).epsilon(1e-6));
  CHECK_FALSE(report.limits.holds());
  // E of the lobe at grazing lies between its values at m = 0.9 and 1 (1.149 at m = 1 and 89 degrees, PHYSICS).
  CHECK(report.limits.worst_total > 1.2);
  CHECK(report.limits.worst_total < 1.26);
  CHECK(report.scale_to_limit == Approx(1 / report.limits.worst_total).epsilon(1e-6));
  REQUIRE(report.renders.size() == 2);
  for (const auto* file : {"fit.json", "limits.json", "table.csv", "lobe-table.exr", "lobe-table.csv", "sphere.exr", "sphere.png",
                           "sphere-at-the-limit.exr", "sphere-at-the-limit.png"})
    CHECK(fs::file_size(out.path / "synthetic" / file) > 0);

  const std::string page = validation_page({report}, out.path);
  CHECK(page.find(fmt::format("it reflects {:.6f}", report.limits.worst_total)) != std::string::npos);
  CHECK(page.find("src=\"http") == std::string::npos);  // self-contained
  CHECK(page.find("href=\"http") == std::string::npos);
  CHECK(page.find(out.path.string()) == std::string::npos);  // no path
}

TEST_CASE("A validation's files are the same with one thread and two", "[reports]") {
  const Folder out;
  for (const int threads : {1, 2}) {
    const fs::path folder = out.path / std::to_string(threads);
    fs::create_directories(folder);
    const MaterialReport report = validate_measurement(synthetic_scan(0.3, 0.2, 0.5), folder / "synthetic", quick(threads));
    CHECK(report.limits.holds());
    CHECK(report.renders.size() == 1);
    write_file(folder / "report.html", validation_page({report}, folder));
  }
  int compared = 0;
  for (const auto& entry : fs::recursive_directory_iterator(out.path / "1")) {
    if (!entry.is_regular_file()) continue;
    INFO(entry.path().filename());
    CHECK(read_file(entry.path()) == read_file(out.path / "2" / fs::relative(entry.path(), out.path / "1")));
    ++compared;
  }
  CHECK(compared > 12);
}
