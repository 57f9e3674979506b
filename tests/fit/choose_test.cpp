// Model choice: no more model than the data need, and never less; and what a robust loss is for.
#include "fit/choose.h"

#include <random>

#include "base/files.h"
#include "catch.h"
#include "synthetic.h"

using namespace gonio;
using namespace gonio::test;

namespace {

std::vector<ModelSpec> specs_of(const std::vector<std::pair<const char*, bool>>& names) {
  std::vector<ModelSpec> specs;
  for (const auto& [name, retro] : names) specs.push_back(spec_of(name)), specs.back().retro = retro;
  return specs;
}

const Candidate& candidate(const ModelChoice& choice, const char* name) {
  for (const Candidate& c : choice.candidates)
    if (!c.result.model.is_sum() && c.result.model.name() == name && !c.result.model.first().retro) return c;
  throw std::runtime_error(name);
}

FitRequest quick() {
  FitRequest request;
  request.starts = 6;
  return request;
}

}  // namespace

TEST_CASE("the simplest model that left-out scans cannot tell from the best is chosen", "[fit][choose]") {
  const std::vector<ModelSpec> specs = specs_of({{"lambert", false},
                                                 {"torrance-sparrow", false},
                                                 {"ggx", false},
                                                 {"oren-nayar", false},
                                                 {"lafortune-1997", false}});
  FitRequest request = quick();
  request.material = "perfect";
  SECTION("a lobe where there is one") {
    const Measurement scan = synthetic(empty_scan(), spec_of("torrance-sparrow"), std::vector<double>{0.2, 0.1, 0.8},
                                       perfect_interface<double>(), 0.05);
    const ModelChoice choice = choose_model(scan, request, specs);
    CHECK(choice.candidates[choice.chosen].result.model.name() == "torrance-sparrow");
    CHECK(candidate(choice, "lambert").told_apart);
    CHECK(candidate(choice, "ggx").told_apart);
    CHECK(choice.sentence.find("torrance-sparrow") != std::string::npos);
  }
  SECTION("none where there is none, although richer models fit the noise better") {
    const Measurement scan =
        synthetic(empty_scan(), spec_of("lambert"), std::vector<double>{0.5}, perfect_interface<double>(), 0.05);
    const ModelChoice choice = choose_model(scan, request, specs);
    CHECK(choice.candidates[choice.chosen].result.model.name() == "lambert");
    CHECK(candidate(choice, "lafortune-1997").result.all.rms < candidate(choice, "lambert").result.all.rms);
    CHECK(candidate(choice, "lambert").bic < candidate(choice, "lafortune-1997").bic);
  }
}

TEST_CASE("measured materials: what is chosen predicts left-out scans better than Lambert and Ward's lobe",
          "[fit][choose][slow]") {
  const std::vector<ModelSpec> specs = specs_of({{"lambert", false},
                                                 {"phong-1975", true},
                                                 {"whitted-1980", true},
                                                 {"blinn-1977-spheroid", true},
                                                 {"ggx", false},
                                                 {"ward-1992", false},
                                                 {"cook-torrance-1981-two-widths", false},
                                                 {"ashikhmin-shirley-2000", false}});
  for (const char* name :
       {"aluminium-merl", "starlink-chassis-532nm", "ptfe-sintered-nist-532nm", "retro-tape-yellow",
        "retro-tape-yellow-dense"}) {
    const Measurement scan = read_measurement(data_folder("measurements") / name);
    const ModelChoice choice = choose_model(scan, quick(), specs);
    const Candidate &chosen = choice.candidates[choice.chosen], &ward = candidate(choice, "ward-1992");
    INFO(name << ": " << choice.sentence << "; ward-1992 " << ward.held_out_log10);
    const Excess excess = excess_over(choice, ward, chosen);
    CHECK(excess.mean > excess.error);
  }
}

TEST_CASE("robust losses pass over wrong points that pull a plain fit away", "[fit][robust]") {
  Measurement scan = synthetic(empty_scan(), spec_of("torrance-sparrow"), std::vector<double>{0.2, 0.1, 0.8},
                               perfect_interface<double>(), 0.02);
  std::mt19937_64 random(4);
  for (ScanPoint& p : scan.points)
    if (random() % 20 == 0) p.f_per_sr *= 20;  // a twentieth is far too bright
  FitRequest request = quick();
  request.model = spec_of("torrance-sparrow");
  request.material = "perfect", request.hold_out = HoldOut::none;
  const auto error = [&](Loss loss) {
    request.loss = loss;
    const FitResult result = fit(scan, request);
    return std::abs(result.value("kd") / 0.1 - 1);
  };
  const double plain = error(Loss::none), huber = error(Loss::huber), cauchy = error(Loss::cauchy);
  INFO("kd off by " << plain << ", " << huber << ", " << cauchy);
  CHECK(plain > 0.02);
  CHECK(huber < 0.01);
  CHECK(cauchy < 0.01);
}
