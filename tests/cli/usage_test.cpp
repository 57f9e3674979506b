// Arguments of every subcommand: help with an example, and one clear line for each kind of misuse.
#include "catch.h"
#include "cli/command.h"

using namespace gonio::test;
using Arguments = std::vector<std::string>;

TEST_CASE("every subcommand has help with an example", "[cli]") {
  const auto name = GENERATE(as<std::string>(), "materials list", "materials show", "fresnel", "color", "models",
                             "eval", "fit", "batch", "table", "table limits", "render", "validate",
                             "measurements info", "measurements convert", "measurements plot", "measurements compare");
  Arguments arguments;
  for (std::size_t at = 0; at < name.size();
       at = name.find(' ', at) == name.npos ? name.size() : name.find(' ', at) + 1)
    arguments.push_back(name.substr(at, name.find(' ', at) - at));
  arguments.push_back("--help");
  INFO(name);
  const Outcome help = run_gonio(arguments);
  CHECK(help.status == 0);
  CHECK(help.err == "");
  CHECK_THAT(help.out, Catch::Matchers::Contains("Example") && Catch::Matchers::Contains("gonio " + arguments.front()));
  CHECK_THAT(help.out, Catch::Matchers::Contains("--json") && Catch::Matchers::Contains("--threads") &&
                           Catch::Matchers::Contains("--seed"));
}

TEST_CASE("misuse is one line and exit 2", "[cli]") {
  const Scratch scratch;
  check_refused(scratch, {}, "subcommand");
  check_refused(scratch, {"polish"}, "polish");
  check_refused(scratch, {"models", "--colour"}, "--colour");
  check_refused(scratch, {"models", "--threads", "many"}, "many");
  check_refused(scratch, {"fit"}, "required");
  check_refused(scratch, {"eval", "lambert", "--set"}, "--set");
}

TEST_CASE("unknown names are refused with the known or near ones", "[cli]") {
  const Scratch scratch;
  check_refused(scratch, {"models", "phong"}, "torrance-sparrow");
  check_refused(scratch, {"eval", "phong", "--input", "-"}, "torrance-sparrow");
  check_refused(scratch, {"materials", "show", "Au_Jonson"}, "Au_Johnson");
  check_refused(scratch, {"fresnel", "unobtainium", "--at", "550"}, "unobtainium");
  check_refused(scratch, {"color", "unobtainium", "--light", "D65", "--observer", "1931-2"}, "unobtainium");
  check_refused(scratch, {"color", "Au", "--light", "D66", "--observer", "1931-2"}, "D66");
  check_refused(scratch, {"color", "Au", "--light", "D65", "--observer", "1932-2"}, "1932-2");
  check_refused(scratch, {"color", "Au", "--light", "Cu", "--observer", "1931-2"}, "illuminant");
  check_refused(scratch, {"table", "limits", "phong", "--set", "m=0.2"}, "torrance-sparrow");
}

TEST_CASE("parameters of a model: unknown, twice, outside the box, no number, no roughness or two", "[cli]") {
  struct Case {
    Arguments settings;
    const char* words;
  };
  const std::vector<Case> cases = {
      {{}, "m"},
      {{"--set", "ks=0.5"}, "m"},
      {{"--set", "m=0.2", "--set", "alpha=0.3"}, "alpha"},
      {{"--set", "m=0.2", "--set", "gloss=1"}, "gloss"},
      {{"--set", "m=0.2", "--set", "m=0.3"}, "m"},
      {{"--set", "m=0"}, "m"},
      {{"--set", "m=-0.2"}, "m"},
      {{"--set", "m=1e9"}, "m"},
      {{"--set", "m=nan"}, "nan"},
      {{"--set", "m=inf"}, "inf"},
      {{"--set", "m=smooth"}, "smooth"},
      {{"--set", "m=0.2x"}, "0.2x"},
      {{"--set", "m"}, "="},
      {{"--set", "m=0.2", "--set", "kd=-1"}, "kd"},
      {{"--set", "m=0.2", "--set", "shadowing=deep"}, "deep"},
  };
  const Scratch scratch;
  for (const Case& c : cases) {
    Arguments eval{"eval", "torrance-sparrow", "--material", "Au", "--at", "550", "--input", "-"};
    eval.insert(eval.end(), c.settings.begin(), c.settings.end());
    check_refused(scratch, eval, c.words, "theta_i_deg,theta_o_deg,phi_deg\n30,30,180\n");
    Arguments limits{"table", "limits", "torrance-sparrow", "--material", "Au", "--at", "550"};
    limits.insert(limits.end(), c.settings.begin(), c.settings.end());
    check_refused(scratch, limits, c.words);
  }
  check_refused(scratch, {"eval", "beckmann-kirchhoff", "--set", "correlation_um=5", "--at", "550", "--input", "-"},
                "sigma_um");
  check_refused(scratch,
                {"eval", "beckmann-kirchhoff", "--set", "sigma_um=1", "--set", "correlation_um=5", "--input", "-"},
                "wavelength", "theta_i_deg,theta_o_deg,phi_deg\n30,30,180\n");
}

TEST_CASE("angles and wavelengths on the command line", "[cli]") {
  const Scratch scratch;
  for (const char* angles : {"-1", "90.5", "nan", "0,30,x", "", "30,"})
    check_refused(scratch, {"fresnel", "Au", "--at", "550", "--angles", angles}, "--angles");
  check_refused(scratch, {"fresnel", "Au", "--at", "99999"}, "nm");
  check_refused(scratch, {"fresnel", "Au", "--at", "0"}, "nm");
  check_refused(scratch, {"fresnel", "Au", "--at", "nan"}, "");
  check_refused(scratch, {"fresnel", "Au"}, "--at");
  check_refused(scratch, {"fresnel", "Au", "--at", "550", "--n", "1.5"}, "--n");
  check_refused(scratch, {"fresnel", "--n", "-1.5"}, "--n");
  check_refused(scratch, {"fresnel", "--n", "nan"}, "--n");
  check_refused(scratch, {"fresnel", "--n", "1.5", "--k", "-1"}, "--k");
  check_refused(scratch, {"materials", "show", "Au", "--at", "99999"}, "nm");
  check_refused(scratch, {"table", "limits", "torrance-sparrow", "--set", "m=0.2", "--material", "Au", "--at", "99999"},
                "nm");
  check_refused(
      scratch,
      {"table", "limits", "torrance-sparrow", "--set", "m=0.2", "--material", "Au", "--at", "550", "--angles", "95"},
      "95");
}
