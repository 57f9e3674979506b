// gonio batch: every measurement with every model, kept where nothing changed, failures listed.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "cli/command.h"

using namespace gonio::test;
using Json = nlohmann::json;

namespace {

/// A diffuse scan of this reflectance with a smooth error of one percent.
std::string diffuse_scan(double kd) {
  std::string csv = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr\n";
  for (int i = 0; i <= 60; i += 15)
    for (int o = 0; o <= 75; o += 15)
      for (const int phi : {0, 180})
        csv +=
            fmt::format("{},0,{},{},{:.6f}\n", i, o, phi, kd / 3.14159265 * (1 + 0.01 * ((i + 2 * o + phi) % 7 - 3)));
  return csv;
}

Json rows_of(const Outcome& outcome) { return Json::parse(outcome.out); }

}  // namespace

TEST_CASE("a batch fits all, keeps what is finished and lists what fails", "[cli][batch]") {
  const Scratch scratch;
  scratch.file("scans/a.csv", diffuse_scan(0.5));
  scratch.file("scans/b.csv", "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr\n0,0,10,0,bright\n");
  scratch.file("scans/c, 50%/scan.csv", diffuse_scan(0.3));
  scratch.file("scans/c, 50%/measurement.yaml", "name: grey\n");
  const std::vector<std::string> call = {
      "batch", scratch.path("scans"), "--model", "lambert", "oren-nayar", "--starts", "2",
      "--out", scratch.path("out"),   "--json"};
  const Outcome first = run_gonio(call);
  INFO(first.err);
  CHECK(first.status == 1);
  const Json rows = rows_of(first);
  REQUIRE(rows.size() == 6);
  CHECK(rows[0].at("status") == "fitted");
  CHECK(rows[0].at("parameters").at("kd").at("value").get<double>() == Approx(0.5).epsilon(0.02));
  CHECK(rows[2].at("measurement") == "b");
  CHECK(rows[2].at("status") == "failed");
  CHECK_THAT(rows[2].at("reason").get<std::string>(), Catch::Matchers::Contains("b.csv:2"));
  CHECK(rows[4].at("status") == "fitted");
  CHECK(Json::parse(content_of(scratch.path("out/c, 50%/lambert/fit.json"))).at("gonio_fit") == 1);
  CHECK(content_of(scratch.path("out/b/lambert/fit.json")).empty());

  const std::string summary = content_of(scratch.path("out/summary.csv")),
                    page = content_of(scratch.path("out/index.html"));
  CHECK(std::count(summary.begin(), summary.end(), '\n') == 7);
  CHECK(summary.starts_with("measurement,model,status,rms_log10,held_out_rms_log10,points,fitted_model,kd,kd_lo95,kd_hi95"));
  CHECK_THAT(page, Catch::Matchers::Contains("a/lambert/in-plane-log.svg") && Catch::Matchers::Contains("b.csv:2") &&
                       Catch::Matchers::Contains("c,%2050%25/lambert/fit.json"));

  // Nothing changed: kept, in the same words. One scan changed: only its fits are made again.
  const Json again = rows_of(run_gonio(call));
  CHECK(again[0].at("status") == "kept");
  CHECK(again[0].at("parameters") == rows[0].at("parameters"));
  scratch.file("scans/a.csv", diffuse_scan(0.4));
  const Json changed = rows_of(run_gonio(call));
  CHECK(changed[0].at("status") == "fitted");
  CHECK(changed[0].at("parameters").at("kd").at("value").get<double>() == Approx(0.4).epsilon(0.02));
  CHECK(changed[4].at("status") == "kept");
  std::vector<std::string> other = call;
  other.insert(other.end(), {"--metric", "linear"});
  CHECK(rows_of(run_gonio(other))[4].at("status") == "fitted");

  // Columns: every row of the summary has as many cells as its head, outside quotes.
  std::size_t from = 0, columns = 0;
  while (from < summary.size()) {
    const std::size_t end = summary.find('\n', from);
    bool quoted = false;
    std::size_t cells = 1;
    for (std::size_t i = from; i < end; ++i) {
      if (summary[i] == '"') quoted = !quoted;
      if (summary[i] == ',' && !quoted) ++cells;
    }
    if (columns == 0) columns = cells;
    CHECK(cells == columns);
    from = end + 1;
  }
}

TEST_CASE("a batch reads the files of others and takes the options of fit", "[cli][batch]") {
  const Scratch scratch;
  scratch.file("own/scan.csv", diffuse_scan(0.5));
  scratch.file("own/measurement.yaml", "name: grey\n");
  std::filesystem::create_directories(scratch.path("scans"));
  REQUIRE(run_gonio({"measurements", "convert", scratch.path("own"), "-o", scratch.path("scans/grey.astm")}).status ==
          0);
  const Outcome outcome = run_gonio({"batch", scratch.path("scans"), "--model", "torrance-sparrow", "--set", "ks=0",
                                     "--set", "m=0.2", "--out", scratch.path("out"), "--json"});
  INFO(outcome.err);
  CHECK(outcome.status == 0);
  const Json rows = rows_of(outcome);
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].at("measurement") == "grey");
  CHECK(rows[0].at("parameters").at("kd").at("value").get<double>() == Approx(0.5).epsilon(0.02));
}

TEST_CASE("a batch that succeeds exits 0; misuse is refused", "[cli][batch]") {
  const Scratch scratch;
  scratch.file("scans/a.csv", diffuse_scan(0.5));
  CHECK(run_gonio({"batch", scratch.path("scans/a.csv"), "--model", "lambert", "--out", scratch.path("fine")}).status ==
        0);
  check_refused(scratch, {"batch", scratch.path("absent"), "--model", "lambert", "--out", scratch.path("out")},
                "absent");
  check_refused(scratch, {"batch", scratch.path("scans"), "--model", "phong", "--out", scratch.path("out")},
                "unknown model");
  scratch.file("other/a.csv", diffuse_scan(0.5));
  check_refused(
      scratch,
      {"batch", scratch.path("scans"), scratch.path("other"), "--model", "lambert", "--out", scratch.path("out")},
      "two measurements have this name");
  scratch.file("bare/notes.txt", "none");
  check_refused(scratch, {"batch", scratch.path("bare"), "--model", "lambert", "--out", scratch.path("out")},
                "no measurement");
}
