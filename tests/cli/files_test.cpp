// Files that cannot be used: each is refused in one line, and nothing is written.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "cli/command.h"

using namespace gonio::test;
using Arguments = std::vector<std::string>;

namespace {

constexpr std::string_view kScanHeader = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr\n";
constexpr std::string_view kEvalHeader = "theta_i_deg,theta_o_deg,phi_deg\n";
const std::string kBinary("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\xff\xfe\x01\n\n\0", 24);

struct BadTable {
  const char* name;
  std::string content;
  const char* words;
};

std::string scan(std::string_view rows) { return std::string(kScanHeader) + std::string(rows); }
std::string directions(std::string_view rows) { return std::string(kEvalHeader) + std::string(rows); }

const std::vector<BadTable>& bad_scans() {
  static const std::vector<BadTable> all = {
      {"missing-column.csv", "theta_i_deg,phi_i_deg,theta_r_deg,brdf_per_sr\n0,0,10,0.3\n", "phi_r_deg"},
      {"nan.csv", scan("0,0,10,0,0.3\n0,0,20,0,nan\n"), ":3:"},
      {"inf.csv", scan("0,0,10,0,0.3\n0,0,20,0,inf\n"), ":3:"},
      {"angle-above.csv", scan("0,0,10,0,0.3\n95,0,20,0,0.3\n"), ":3:"},
      {"angle-below.csv", scan("0,0,-10,0,0.3\n"), ":2:"},
      {"text.csv", scan("0,0,10,0,0.3\n0,0,20,0,bright\n"), ":3:"},
      {"cut-row.csv", scan("0,0,10,0,0.3\n0,0,20\n"), ":3:"},
      {"long-row.csv", scan("0,0,10,0,0.3,7\n"), ":2:"},
      {"twice.csv", "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr,brdf_per_sr\n0,0,10,0,0.3,0.3\n",
       "brdf_per_sr"},
      {"only-90.csv", scan("0,0,90,0,0.3\n90,0,10,0,0.3\n"), "row"},
      {"header-only.csv", scan(""), "row"},
      {"empty.csv", "", "empty.csv"},
      {"binary.csv", kBinary, "binary.csv"},
  };
  return all;
}

const std::vector<BadTable>& bad_directions() {
  static const std::vector<BadTable> all = {
      {"missing-column.csv", "theta_i_deg,theta_o_deg\n0,10\n", "phi_deg"},
      {"nan.csv", directions("0,10,0\n0,nan,0\n"), ":3:"},
      {"azimuth-nan.csv", directions("0,10,nan\n"), ":2:"},
      {"angle-above.csv", directions("0,10,0\n0,95,0\n"), ":3:"},
      {"grazing.csv", directions("0,10,0\n90,10,0\n"), ":3:"},
      {"angle-below.csv", directions("-5,10,0\n"), ":2:"},
      {"text.csv", directions("0,ten,0\n"), ":2:"},
      {"cut-row.csv", directions("0,10,0\n0,20\n"), ":3:"},
      {"wavelength.csv", "theta_i_deg,theta_o_deg,phi_deg,wavelength_nm\n0,10,0,550\n0,10,0,99999\n", "nm"},
      {"empty.csv", "", "empty"},
      {"binary.csv", kBinary, "binary.csv"},
  };
  return all;
}

}  // namespace

TEST_CASE("a scan that cannot be read is refused by fit", "[cli]") {
  const Scratch scratch;
  for (const BadTable& bad : bad_scans()) {
    const std::string path = scratch.file(bad.name, bad.content);
    check_refused(scratch, {"fit", path, "--model", "lambert", "--out", scratch.path("out")}, bad.words);
  }
  check_refused(scratch, {"fit", scratch.path("absent.csv"), "--model", "lambert", "--out", scratch.path("out")},
                "absent.csv");
  check_refused(scratch, {"fit", scratch.path(), "--model", "lambert", "--out", scratch.path("out")}, "scan.csv");
}

TEST_CASE("a scan that cannot be read is refused by validate", "[cli]") {
  const Scratch scratch;
  for (const BadTable& bad : bad_scans()) {
    const std::string path = scratch.file(bad.name, bad.content);
    check_refused(scratch, {"validate", path, "--out", scratch.path("out")}, bad.words);
  }
}

TEST_CASE("a good scan beside the bad ones is accepted", "[cli]") {
  const Scratch scratch;
  std::string rows;
  for (int theta = 0; theta < 80; theta += 10) rows += fmt::format("0,0,{},0,0.25\n30,0,{},180,0.25\n", theta, theta);
  const std::string path = scratch.file("good.csv", scan(rows));
  const Outcome fit =
      run_gonio({"fit", path, "--model", "lambert", "--starts", "2", "--out", scratch.path("out"), "--json"});
  INFO(fit.err);
  REQUIRE(fit.status == 0);
  CHECK(nlohmann::json::accept(fit.out));
  const Outcome eval = run_gonio({"eval", scratch.path("out/fit.json"), "--input", "-"}, directions("30,40,90\n"));
  INFO(eval.err);
  REQUIRE(eval.status == 0);
  const std::string last = eval.out.substr(eval.out.rfind(',') + 1);
  CHECK(std::stod(last) == Approx(0.25).epsilon(1e-6));
}

TEST_CASE("a measurement.yaml that cannot be used is refused", "[cli]") {
  const Scratch scratch;
  scratch.file("sample/scan.csv", scan("0,0,10,0,0.3\n0,0,20,0,0.3\n30,0,20,0,0.3\n"));
  const Arguments fit{"fit", scratch.path("sample"), "--model", "lambert", "--out", scratch.path("out")};
  const std::vector<BadTable> bad_yamls = {
      {"", "name: [unclosed\n", "measurement.yaml"},
      {"", "- a\n- list\n", "measurement.yaml"},
      {"", "name: a\nquantity: loudness\n", "loudness"},
      {"", "name: a\nquantity: brdf\nwavelength_nm: -5\n", "wavelength_nm"},
      {"", "name: a\nquantity: brdf\nwavelength_nm: green\n", "green"},
      {"", "name: a\nquantity: brdf\nwavelength_nm: 550\nmaterial: unobtainium\n", "unobtainium"},
      {"", kBinary, "measurement.yaml"},
  };
  for (const BadTable& bad : bad_yamls) {
    scratch.file("sample/measurement.yaml", bad.content);
    INFO(bad.content);
    check_refused(scratch, fit, bad.words);
  }
  scratch.file("sample/measurement.yaml", "name: a\nquantity: brdf\nwavelength_nm: 99999\nmaterial: Au\n");
  check_refused(scratch, {"fit", scratch.path("sample"), "--model", "torrance-sparrow", "--out", scratch.path("out")},
                "nm");
}

TEST_CASE("directions that cannot be evaluated are refused, also after good rows", "[cli]") {
  const Scratch scratch;
  const Arguments model{"eval", "torrance-sparrow", "--set", "m=0.2", "--material", "Au"};
  for (const BadTable& bad : bad_directions()) {
    const std::string path = scratch.file(bad.name, bad.content);
    Arguments arguments = model;
    arguments.insert(arguments.end(), {"--input", path});
    if (std::string_view(bad.name) != "wavelength.csv") arguments.insert(arguments.end(), {"--at", "550"});
    check_refused(scratch, arguments, bad.words);
  }
  check_refused(scratch, {"eval", "lambert", "--input", scratch.path("absent.csv")}, "absent.csv");
  check_refused(scratch,
                {"eval", "torrance-sparrow", "--set", "m=0.2", "--material", "Au", "--at", "99999", "--input", "-"},
                "nm", directions("0,10,0\n"));
}

TEST_CASE("a fit.json that is none is refused", "[cli]") {
  const Scratch scratch;
  const std::vector<BadTable> bad_fits = {
      {"empty.json", "", "empty.json"},
      {"cut.json", R"({"gonio_fit":1,"model":"lambert","parameters":{"kd":{"val)", "cut.json"},
      {"binary.json", kBinary, "binary.json"},
      {"list.json", "[1,2,3]", "list.json"},
      {"other.json", R"({"name":"not a fit"})", "gonio_fit"},
      {"version.json", R"({"gonio_fit":99,"model":"lambert","parameters":{"kd":{"value":0.5}}})", "gonio_fit"},
      {"model.json", R"({"gonio_fit":1,"model":"phong","parameters":{}})", "phong"},
      {"value.json", R"({"gonio_fit":1,"model":"lambert","parameters":{"kd":{"value":"bright"}}})", "value.json"},
  };
  for (const BadTable& bad : bad_fits) {
    const std::string path = scratch.file(bad.name, bad.content);
    check_refused(scratch, {"eval", path, "--input", "-"}, bad.words, directions("0,10,0\n"));
    check_refused(scratch, {"table", "limits", path}, bad.words);
  }
  check_refused(scratch, {"eval", scratch.path("absent.json"), "--input", "-"}, "absent.json", directions("0,10,0\n"));
}

TEST_CASE("a scene that cannot be read is refused", "[cli]") {
  const Scratch scratch;
  const std::vector<BadTable> bad_scenes = {
      {"empty.yaml", "", "empty.yaml"},
      {"text.yaml", "a scene in prose\n", "text.yaml"},
      {"syntax.yaml", "camera: [1, 2\n", "syntax.yaml"},
      {"unknown-key.yaml", content_of(GONIO_SOURCE_DIR "/scenes/sphere-on-ground.yaml") + "\ncamcorder: 1\n",
       "camcorder"},
      {"cut.yaml", content_of(GONIO_SOURCE_DIR "/scenes/sphere-on-ground.yaml").substr(0, 400), "cut.yaml"},
      {"binary.yaml", kBinary, "binary.yaml"},
  };
  for (const BadTable& bad : bad_scenes) {
    const std::string path = scratch.file(bad.name, bad.content);
    check_refused(scratch, {"render", path, "--out", scratch.path("image.exr")}, bad.words);
  }
  check_refused(scratch, {"render", scratch.path("absent.yaml"), "--out", scratch.path("image.exr")}, "absent.yaml");
}

TEST_CASE("an output that cannot be written is refused before or after the work, with nothing left", "[cli]") {
  const Scratch scratch;
  const std::string plain = scratch.file("plain.txt", "a file, no folder\n");
  const std::string good = scratch.file("good.csv", scan("0,0,10,0,0.3\n0,0,20,0,0.3\n30,0,20,0,0.3\n"));
  check_refused(scratch, {"fit", good, "--model", "lambert", "--starts", "1", "--out", plain}, "plain.txt");
  check_refused(scratch, {"fit", good, "--model", "lambert", "--starts", "1", "--out", plain + "/out"}, "plain.txt");
  check_refused(scratch, {"validate", good, "--out", plain}, "plain.txt");
  check_refused(scratch, {"table", "torrance-sparrow", "--out", plain + "/t.exr"}, "plain.txt");
  check_refused(scratch, {"table", "torrance-sparrow", "--out", scratch.path("absent/t.exr")}, "absent");
  for (const auto& scene : std::filesystem::directory_iterator(GONIO_SOURCE_DIR "/scenes")) {
    if (scene.path().extension() != ".yaml") continue;
    const Arguments render{"render", scene.path().string(), "--spp", "1", "--width", "8", "--height", "6", "--out"};
    Arguments into_file = render, into_absent = render;
    into_file.push_back(plain + "/image.exr");
    into_absent.push_back(scratch.path("absent/image.exr"));
    check_refused(scratch, into_file, "plain.txt");
    check_refused(scratch, into_absent, "absent");
  }
}

TEST_CASE("a standard output that cannot be written is no success", "[cli]") {
  const std::vector<Arguments> all = {
      {"models"}, {"materials", "list", "--json"}, {"fresnel", "--n", "1.5"}, {"eval", "lambert", "--input", "-"}};
  for (const Arguments& arguments : all) {
    const Outcome full = run_gonio(arguments, directions("0,10,0\n"), "/dev/full");
    INFO(arguments.front() << ": " << full.err);
    CHECK(full.status == 2);
    CHECK(std::count(full.err.begin(), full.err.end(), '\n') == 1);
  }
}
