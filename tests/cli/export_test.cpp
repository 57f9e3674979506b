// gonio export: what is written, what it says of its accuracy, and what is refused.
#include <cmath>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "cli/command.h"
#include "fit/formats/renderer_lobes.h"
#include "fit/formats/rgl.h"

using namespace gonio;
using namespace gonio::test;
using nlohmann::json;

namespace {

json exported(const Scratch& scratch, std::vector<std::string> arguments, const std::string& target,
              const std::string& name) {
  arguments.insert(arguments.begin(), "export");
  for (const std::string& more :
       {std::string("--to"), target, std::string("-o"), scratch.path(name), std::string("--json")})
    arguments.push_back(more);
  const Outcome outcome = run_gonio(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  return json::parse(outcome.out);
}

bool has(const std::string& text, std::string_view words) { return text.find(words) != text.npos; }

const std::vector<std::string> kGgx{"ggx", "--set", "alpha_x=0.2", "--set", "alpha_y=0.3", "--material",
                                    "Au",  "--at",  "500",         "--at",  "600"};
std::vector<std::string> with(std::vector<std::string> all, const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

TEST_CASE("gonio export --to mitsuba: a rough conductor, and a blend where there is a diffuse part", "[cli][export]") {
  const Scratch scratch;
  const json plain = exported(scratch, kGgx, "mitsuba", "a.xml");
  CHECK(plain["kind"] == "roughconductor");
  CHECK(plain["table"].is_null());
  CHECK(plain["rms_log10"] > 0.0);  // correlated here, separable there
  CHECK(plain["rms_log10"] < 0.01);
  const std::string text = content_of(scratch.path("a.xml"));
  for (const char* words : {"<!-- gonio ggx", "rms of log10 f", "Delta E 2000", "\"ggx\"",
                            "name=\"alpha_u\" value=\"0.2\"", "name=\"eta\" value=\"500:", "name=\"k\""})
    CHECK(has(text, words));
  CHECK(exported(scratch, with(kGgx, {"--set", "kd=0.1", "--set", "ks=0.6"}), "mitsuba", "b.xml")["kind"] ==
        "blendbsdf");
  CHECK(has(content_of(scratch.path("b.xml")), "name=\"weight\" value=\"0.1\""));
  const json lambert = exported(scratch, {"lambert", "--set", "kd=0.4"}, "mitsuba", "c.xml");
  CHECK(lambert["kind"] == "diffuse");
  CHECK(lambert["rms_log10"] == 0.0);
  CHECK(scratch.listing().size() == 3);
}

TEST_CASE("gonio export --to pbrt: GGX as it is there to rounding", "[cli][export]") {
  const Scratch scratch;
  const json plain = exported(scratch, kGgx, "pbrt", "a.pbrt");
  CHECK(plain["kind"] == "conductor");
  CHECK(plain["rms_log10"] < 1e-13);
  CHECK(plain["delta_e_2000"]["largest"] < 1e-9);
  CHECK(has(content_of(scratch.path("a.pbrt")), "\"bool remaproughness\" false"));
  const json mix = exported(scratch, with(kGgx, {"--set", "kd=0.1", "--set", "ks=0.6"}), "pbrt", "b.pbrt");
  CHECK(mix["kind"] == "mix");
  CHECK(mix["rms_log10"] < 1e-13);
  CHECK(has(content_of(scratch.path("b.pbrt")), "\"float amount\" 0.6"));
}

TEST_CASE("gonio export: other models as a table beside the scene text", "[cli][export]") {
  const Scratch scratch;
  const json made =
      exported(scratch, {"torrance-sparrow", "--set", "m=0.3", "--set", "kd=0.1", "--set", "ks=0.8", "--n", "1.5"},
               "pbrt", "a.pbrt");
  CHECK(made["kind"] == "measured");
  CHECK(has(content_of(scratch.path("a.pbrt")), "Material \"measured\" \"string filename\" \"a.bsdf\""));
  CHECK(made["rms_log10"] < 0.02);
  CHECK(made["delta_e_2000"]["mean"] < 0.2);
  const RglTable table = parse_rgl(content_of(scratch.path("a.bsdf")), "a.bsdf");
  CHECK(table.description.starts_with("gonio torrance-sparrow"));
  const json rgl =
      exported(scratch, {"torrance-sparrow", "--set", "m=0.3", "--set", "kd=0.1", "--set", "ks=0.8", "--n", "1.5"},
               "rgl", "b.bsdf");
  CHECK(content_of(scratch.path("b.bsdf")) == content_of(scratch.path("a.bsdf")));
  CHECK(rgl["rms_log10"] == made["rms_log10"]);
}

TEST_CASE("gonio export: a fit brings its model and material", "[cli][export]") {
  const Scratch scratch;
  const std::string fit = scratch.file(
      "fit.json",
      R"({"gonio_fit":1,"model":"ggx","options":{"shadowing":"smith-correlated"},"material":"Au","wavelength_nm":[550],
    "parameters":{"alpha_x":{"value":0.2},"alpha_y":{"value":0.2},"kd":{"value":0.05},"ks":{"value":0.9}}})");
  const json made = exported(scratch, {fit}, "mitsuba", "a.xml");
  CHECK(made["kind"] == "blendbsdf");
  CHECK(made["wavelength_nm"].size() == 18);  // 380 to 720 by 20: n and k come from the database
}

TEST_CASE("gonio export refuses with one line what the other side cannot hold", "[cli][export]") {
  const Scratch scratch;
  const auto refused = [&](std::vector<std::string> arguments, const std::string& target, const char* name,
                           std::string_view words) {
    arguments.insert(arguments.begin(), "export");
    for (const std::string& more : {std::string("--to"), target, std::string("-o"), scratch.path(name)})
      arguments.push_back(more);
    check_refused(scratch, arguments, words);
  };
  refused({"mirror"}, "rgl", "a.bsdf", "delta");
  refused({"he-1991", "--set", "sigma0_um=0.02", "--set", "correlation_um=2", "--at", "550"}, "mitsuba", "a.xml",
          "delta");
  refused({"rough-dielectric", "--set", "alpha=0.2", "--n", "1.5"}, "pbrt", "a.pbrt", "transmits");
  refused({"lambert", "--set", "kd=0"}, "rgl", "a.bsdf", "reflects nothing");
  refused(kGgx, "mitsuba", "a.bsdf", "another ending");
  refused({"ggx", "--set", "alpha_x=0.2", "--set", "alpha_y=0.3", "--material", "Au", "--at", "1"}, "mitsuba", "a.xml",
          "expected");
  refused(kGgx, "povray", "a.pov", "expected");
}

TEST_CASE("what other renderers evaluate: Walter's rational masking stays within 0.35 % of Smith's", "[cli][export]") {
  const auto direction = [](double theta, double phi) {
    return UnitVector<double>{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  };
  const Interface<double> mirror = perfect_interface<double>();
  for (double theta = 0.05; theta < 1.55; theta += 0.1) {
    // At o = i, f = D·G1²/(4cos²); G1 = 1/(1 + Λ), Λ = (e^-a²/(a√π) - erfc a)/2.
    const UnitVector<double> i = direction(theta, 0.4);
    constexpr double kAlpha = 0.5;
    const double tan = std::tan(theta), a = 1 / (kAlpha * tan),
                 lambda = 0.5 * (std::exp(-a * a) / (a * std::sqrt(M_PI)) - std::erfc(a));
    const double d = std::exp(-tan * tan / (kAlpha * kAlpha)) / (M_PI * kAlpha * kAlpha * std::pow(i.z, 4));
    const double expected = d / square(1 + lambda) / (4 * i.z * i.z);
    CHECK(renderer_lobe(RendererLobe::mitsuba_beckmann, i, i, kAlpha, kAlpha, mirror) ==
          Approx(expected).epsilon(0.0075));
  }
}
