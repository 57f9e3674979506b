// Sums of lobes, and kd and ks of each wavelength, as the command takes them.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "cli/command.h"

using namespace gonio;
using namespace gonio::test;
using nlohmann::json;

namespace {

using Arguments = std::vector<std::string>;

Arguments with(Arguments all, const Arguments& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

const std::string kRows =
    "theta_i_deg,theta_o_deg,phi_deg,phi_i_deg\n30,30,180,0\n30,40,170,20\n70,60,180,45\n10,50,20,0\n0,0,0,0\n";

json answer(const Arguments& arguments, const std::string& rows = kRows) {
  const Outcome outcome = run_gonio(with(arguments, {"--json"}), rows);
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  return json::parse(outcome.out);
}

/// One of the numbers of each row.
std::vector<double> column(const json& eval, const char* name) {
  std::vector<double> all;
  for (const json& row : eval["rows"]) all.push_back(row[name].get<double>());
  return all;
}

const Arguments kGold{"--material", "Au", "--at", "550"};

/// The sum and its parts; kd is with the first.
struct SumOfTwo {
  Arguments sum, first, second;
};
const SumOfTwo kGgxPhong{
    {"eval", "ggx+phong-1975", "--set", "alpha_x_1=0.2", "--set", "alpha_y_1=0.3", "--set", "n_2=20", "--set", "kd=0.1",
     "--set", "ks_1=0.4", "--set", "ks_2=0.3"},
    {"eval", "ggx", "--set", "alpha_x=0.2", "--set", "alpha_y=0.3", "--set", "kd=0.1", "--set", "ks=0.4"},
    {"eval", "phong-1975", "--set", "n=20", "--set", "ks=0.3"}};
const SumOfTwo kFaceted{
    {"eval", "torrance-sparrow+he-1991", "--set", "alpha_1=0.3", "--set", "shadowing_1=v-cavity", "--set",
     "sigma0_um_2=0.05", "--set", "correlation_um_2=2", "--set", "kd=0.2", "--set", "ks_1=0.5", "--set", "ks_2=0.4"},
    {"eval", "torrance-sparrow", "--set", "alpha=0.3", "--set", "shadowing=v-cavity", "--set", "kd=0.2", "--set",
     "ks=0.5"},
    {"eval", "he-1991", "--set", "sigma0_um=0.05", "--set", "correlation_um=2", "--set", "ks=0.4"}};

void check_adds(const SumOfTwo& one, const Arguments& more, const char* name, double bar) {
  const auto sum = column(answer(with(one.sum, more)), name), first = column(answer(with(one.first, more)), name);
  const auto second = column(answer(with(one.second, more)), name);
  for (std::size_t r = 0; r < sum.size(); ++r) CHECK(sum[r] == Approx(first[r] + second[r]).epsilon(bar));
}

/// A fit.json of a model with these parameters (JSON values) at these wavelengths.
std::string fit_json(const std::string& model, const std::vector<std::pair<std::string, std::string>>& parameters,
                     const std::string& wavelengths, const std::string& more = "") {
  std::string text = R"({"gonio_fit":1,"model":")" + model + R"(","material":null,"wavelength_nm":)" + wavelengths;
  text += more + R"(,"parameters":{)";
  for (std::size_t p = 0; p < parameters.size(); ++p)
    text += std::string(p > 0 ? "," : "") + '"' + parameters[p].first + R"(":{"value":)" + parameters[p].second + '}';
  return text + "}}";
}
const std::vector<std::pair<std::string, std::string>> kSpectral{
    {"m", "0.2"}, {"kd", "[0.1,0.3,0.2]"}, {"ks", "[0.5,0.4,0.8]"}};

}  // namespace

TEST_CASE("gonio eval of a sum is the sum of its lobes, in every precision", "[cli][sums]") {
  for (const std::string precision : {"float", "double", "reference"}) {
    const Arguments more = with(kGold, {"--precision", precision});
    check_adds(kGgxPhong, more, "f_r_per_sr", 1e-15);
    check_adds(kFaceted, more, "f_r_per_sr", 1e-15);
    check_adds({kFaceted.sum, kFaceted.second, kFaceted.first}, with(more, {"--polarisation", "30"}), "f_r_per_sr",
               1e-15);
  }
  const json sum = answer(with(kFaceted.sum, kGold)), coherent = answer(with(kFaceted.second, kGold));
  CHECK(column(sum, "coherent_energy") == column(coherent, "coherent_energy"));
  CHECK(sum["model"] == "torrance-sparrow+he-1991");
}

TEST_CASE("gonio eval of a sum of three", "[cli][sums]") {
  const Arguments lobes{"--set",   "n_1=5", "--set",    "n_2=50", "--set",
                        "n_3=500", "--set", "ks_1=0.1", "--set",  "ks_2=0.2"};
  const auto sum = column(answer(with({"eval", "phong-1975+phong-1975+phong-1975"}, lobes)), "f_r_per_sr");
  std::vector<double> added(sum.size(), 0.0);
  for (const auto& [n, ks] : {std::pair{"n=5", "ks=0.1"}, {"n=50", "ks=0.2"}, {"n=500", "ks=1"}}) {
    const auto one = column(answer({"eval", "phong-1975", "--set", n, "--set", ks}), "f_r_per_sr");
    for (std::size_t r = 0; r < sum.size(); ++r) added[r] += one[r];
  }
  for (std::size_t r = 0; r < sum.size(); ++r) CHECK(sum[r] == Approx(added[r]).epsilon(1e-15));
}

TEST_CASE("gonio eval --mueller of a sum: the matrices before they are divided by m11 add", "[cli][sums]") {
  for (const std::string precision : {"float", "double", "reference"}) {
    const Arguments more = with(kGold, {"--mueller", "--precision", precision});
    const json sum = answer(with(kFaceted.sum, more)), first = answer(with(kFaceted.first, more));
    const json second = answer(with(kFaceted.second, more));
    for (std::size_t r = 0; r < sum["rows"].size(); ++r)
      for (const char* name : {"m12", "m22", "m33", "m34", "m43", "m44"}) {
        const auto whole = [&](const json& all) {
          return all["rows"][r]["m11"].get<double>() * all["rows"][r][name].get<double>();
        };
        CHECK(whole(sum) == Approx(whole(first) + whole(second)).epsilon(1e-12).margin(1e-15));
      }
  }
  const Scratch scratch;
  check_refused(scratch, with(with(kGgxPhong.sum, kGold), {"--mueller"}), "phong-1975: does not state", kRows);
}

TEST_CASE("what a sum's settings may be", "[cli][sums]") {
  const Scratch scratch;
  const Arguments base{"eval", "ggx+torrance-sparrow", "--set", "alpha_1=0.2", "--set", "m_2=0.1"};
  CHECK(run_gonio(with(base, {"--set", "retro_2=yes", "--set", "variant_1=exact"}), kRows).status == 0);
  for (const auto& [setting, words] : {std::pair{"alpha_x_1=0.2", "given beside alpha_x_1"},
                                       {"alpha_2=0.2", "m_2 and alpha_2"},
                                       {"ks=0.5", "unknown parameter"},
                                       {"m_3=0.5", "unknown parameter"},
                                       {"retro=yes", "of which lobe"},
                                       {"shadowing_3=v-cavity", "of which lobe"}})
    check_refused(scratch, with(base, {"--set", setting}), words, kRows);
  check_refused(scratch, with(base, {"--variant", "ggx"}), "variant_1", kRows);
  check_refused(scratch, {"eval", "ggx+", "--set", "alpha_1=0.2"}, "expected", kRows);
  check_refused(scratch, {"eval", "ggx+lambert", "--set", "alpha_1=0.2"}, "is no lobe", kRows);
  check_refused(scratch, {"eval", "ggx+ggx+ggx+ggx"}, "1 to 3", kRows);
  check_refused(scratch, with({"eval", "rough-dielectric+ggx"}, {"--set", "alpha_1=0.2", "--set", "alpha_2=0.2"}),
                "0 <= angle < 90", "theta_i_deg,theta_o_deg,phi_deg\n30,120,180\n");
}

TEST_CASE("a fit of several wavelengths: kd and ks are linear between them and refused beyond", "[cli][sums]") {
  const Scratch scratch;
  const std::string fit = scratch.file("fit.json", fit_json("torrance-sparrow", kSpectral, "[450,550,650]"));
  const auto by_hand = [](double kd, double ks) {
    return column(answer({"eval", "torrance-sparrow", "--set", "m=0.2", "--set", "kd=" + std::to_string(kd), "--set",
                          "ks=" + std::to_string(ks)}),
                  "f_r_per_sr");
  };
  for (const auto& [nm, kd, ks] :
       {std::tuple{"450", 0.1, 0.5}, {"500", 0.2, 0.45}, {"550", 0.3, 0.4}, {"650", 0.2, 0.8}}) {
    const auto seen = column(answer({"eval", fit, "--at", nm}), "f_r_per_sr"), truth = by_hand(kd, ks);
    for (std::size_t r = 0; r < seen.size(); ++r) CHECK(seen[r] == Approx(truth[r]).epsilon(1e-14));
  }
  const json rows =
      answer({"eval", fit}, "theta_i_deg,theta_o_deg,phi_deg,wavelength_nm\n30,30,180,450\n30,30,180,600\n");
  CHECK(column(rows, "f_r_per_sr")[0] == Approx(by_hand(0.1, 0.5)[0]).epsilon(1e-14));
  CHECK(column(rows, "f_r_per_sr")[1] == Approx(by_hand(0.25, 0.6)[0]).epsilon(1e-14));
  check_refused(scratch, {"eval", fit}, "--at", kRows);
  check_refused(scratch, {"eval", fit, "--at", "700"}, "outside the fitted wavelengths", kRows);
}

TEST_CASE("a fit of a sum says what its lobes say", "[cli][sums]") {
  const Scratch scratch;
  const std::string fit =
      scratch.file("fit.json", fit_json("ggx+phong-1975",
                                        {{"alpha_x_1", "0.2"},
                                         {"alpha_y_1", "0.3"},
                                         {"n_2", "20"},
                                         {"kd", "0.1"},
                                         {"ks_1", "0.4"},
                                         {"ks_2", "[0.2,0.4]"}},
                                        "[500,600]", R"(,"options":{"shadowing_1":"smith-correlated"})"));
  const auto seen = column(answer({"eval", fit, "--at", "550"}), "f_r_per_sr");
  const auto truth = column(answer(kGgxPhong.sum), "f_r_per_sr");
  for (std::size_t r = 0; r < seen.size(); ++r) CHECK(seen[r] == Approx(truth[r]).epsilon(1e-14));
}

TEST_CASE("a fit.json that cannot be is refused", "[cli][sums]") {
  const Scratch scratch;
  struct Broken {
    std::string text, words;
  };
  const std::vector<std::pair<std::string, std::string>> plain{{"m", "0.2"}, {"kd", "0.1"}, {"ks", "1"}};
  const std::vector<std::pair<std::string, std::string>> two{
      {"m_1", "0.2"}, {"m_2", "0.3"}, {"kd", "0.1"}, {"ks_1", "1"}, {"ks_2", "1"}};
  const std::string pair = "torrance-sparrow+torrance-sparrow";
  std::vector<Broken> all{
      {fit_json("torrance-sparrow", kSpectral, "[450,550]"), "3 values"},
      {fit_json("torrance-sparrow", kSpectral, "[]"), "3 values"},
      {fit_json("torrance-sparrow", {{"m", "0.2"}, {"kd", "[]"}, {"ks", "1"}}, "[450,550]"), "kd is empty"},
      {fit_json("torrance-sparrow", {{"m", "0.2"}, {"kd", "[0.1,\"x\"]"}, {"ks", "1"}}, "[450,550]"),
       "kd is no number"},
      {fit_json("torrance-sparrow", {{"m", "0.2"}, {"kd", "[0.1,-1]"}, {"ks", "1"}}, "[450,550]"), "kd is -1"},
      {fit_json("torrance-sparrow", kSpectral, "[650,550,450]"), "does not rise"},
      {fit_json("torrance-sparrow", plain, "[550]", R"(,"options":{"colour":"red"})"), "colour"},
      {fit_json(pair, two, "[550]", R"(,"options":{"shadowing_3":"v-cavity"})"), "of which lobe"},
      {fit_json(pair, two, "[550]", R"(,"options":{"shadowing":"v-cavity"})"), "of which lobe"},
      {fit_json(pair, plain, "[550]"), "m_1 is missing"},
      {fit_json("torrance-sparrow+", plain, "[550]"), "expected"},
      {fit_json("torrance-sparrow+mirror", plain, "[550]"), "is no lobe"},
  };
  for (std::size_t b = 0; b < all.size(); ++b) {
    const std::string file = scratch.file("broken" + std::to_string(b) + ".json", all[b].text);
    INFO(all[b].text);
    check_refused(scratch, {"eval", file}, all[b].words, kRows);
  }
}

TEST_CASE("gonio table limits of a sum: E is that of its lobes with their own ks", "[cli][sums]") {
  const Arguments angles{"--angles", "0,30,60", "--material", "Au", "--at", "550", "--json"};
  const auto limits = [&](const Arguments& model) {
    const Outcome outcome = run_gonio(with(with({"table", "limits"}, model), angles));
    INFO(outcome.err);
    REQUIRE(outcome.status <= 1);
    return json::parse(outcome.out);
  };
  const json sum = limits({"ggx+ggx", "--set", "alpha_1=0.2", "--set", "alpha_2=0.5", "--set", "ks_1=0.3", "--set",
                           "ks_2=0.4", "--set", "kd=0.1"});
  const json narrow = limits({"ggx", "--set", "alpha=0.2"}), wide = limits({"ggx", "--set", "alpha=0.5"});
  for (std::size_t r = 0; r < 3; ++r) {
    const double by_hand = 0.3 * narrow["E"][r]["E"].get<double>() + 0.4 * wide["E"][r]["E"].get<double>();
    CHECK(sum["E"][r]["E"].get<double>() == Approx(by_hand).margin(1e-9));
    CHECK(sum["E"][r]["total"].get<double>() == Approx(0.1 + by_hand).margin(1e-9));
  }
  // The factor on both ks is at least what the two limits alone allow; scaled by it, (43) is met with equality.
  const double most = sum["ks_max"];
  CHECK(most >= 1 / (0.3 / narrow["ks_max"].get<double>() + 0.4 / wide["ks_max"].get<double>()) - 1e-6);
  const json scaled = limits({"ggx+ggx", "--set", "alpha_1=0.2", "--set", "alpha_2=0.5", "--set",
                              "ks_1=" + std::to_string(0.3 * most), "--set", "ks_2=" + std::to_string(0.4 * most)});
  CHECK(scaled["worst"]["total"].get<double>() == Approx(1).margin(1e-5));
  const json open =
      limits({"ggx+phong-1975", "--set", "alpha_1=0.2", "--set", "n_2=20", "--set", "ks_1=0.1", "--set", "ks_2=0.1"});
  CHECK(open["conserving_to_deg"] == 75);
  const Scratch scratch;
  check_refused(scratch, {"table", "limits", "ggx+ggx", "--set", "alpha_1=0.2", "--set", "alpha_2=0.5", "--ks", "1"},
                "--ks");
}

TEST_CASE("gonio table limits of a spectral fit: each wavelength has its own (43)", "[cli][sums]") {
  const Scratch scratch;
  const auto run = [&](const std::string& kd, const std::string& ks) {
    const std::string file = scratch.file(
        "fit.json", fit_json("torrance-sparrow", {{"m", "0.05"}, {"kd", kd}, {"ks", ks}}, "[450,550,650]"));
    return run_gonio({"table", "limits", file, "--json"});
  };
  const Outcome kept = run("[0.1,0.6,0.3]", "[0.85,0.35,0.6]"), broken = run("[0.1,0.6,0.3]", "[0.85,0.45,0.6]");
  CHECK(kept.status == 0);
  CHECK(broken.status == 1);
  CHECK(json::parse(broken.out)["worst"]["wavelength_nm"] == 550);
  CHECK(json::parse(kept.out)["ks_max"].get<double>() == Approx(1).margin(1e-5));
  CHECK(json::parse(kept.out)["kd_max"].get<double>() == Approx(0.15).margin(1e-3));
  const std::string file = scratch.file("fit.json", fit_json("torrance-sparrow", kSpectral, "[450,550,650]"));
  check_refused(scratch, {"table", "limits", file, "--ks", "1"}, "--ks");
}

TEST_CASE("gonio export: sums and spectra become tables", "[cli][sums][export]") {
  const Scratch scratch;
  const std::string spectral = scratch.file(
      "fit.json",
      fit_json("ggx", {{"alpha_x", "0.3"}, {"alpha_y", "0.3"}, {"kd", "[0.1,0.3,0.2]"}, {"ks", "[0.5,0.4,0.8]"}},
               "[450,550,650]"));
  const Arguments sum{"ggx+ggx", "--set",    "alpha_1=0.3", "--set",   "alpha_2=0.6",
                      "--set",   "ks_1=0.3", "--set",       "ks_2=0.4"};
  for (const Arguments& model : {Arguments{spectral}, sum})
    for (const std::string target : {"rgl", "mitsuba", "pbrt"}) {
      const Outcome outcome =
          run_gonio(with(with({"export"}, model), {"--to", target, "-o", scratch.path("out." + target), "--json"}));
      INFO(outcome.err);
      REQUIRE(outcome.status == 0);
      const json made = json::parse(outcome.out);
      CHECK(made["kind"] == (target == "rgl" ? "rgl" : "measured"));
      CHECK(made["rms_log10"] < 0.02);
      CHECK(made["wavelength_nm"].size() == (model.size() == 1 ? 3 : 1));
    }
  // At one wavelength a spectral fit is one lobe like another.
  const Outcome one =
      run_gonio({"export", spectral, "--at", "500", "--to", "mitsuba", "-o", scratch.path("one.xml"), "--json"});
  REQUIRE(one.status == 0);
  CHECK(json::parse(one.out)["kind"] == "blendbsdf");
}
