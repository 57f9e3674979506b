#include "fit/fit.h"

#include <tbb/global_control.h>

#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "catch.h"
#include "fit/fit_json.h"
#include "fit/fitted_material.h"
#include "fit/plots.h"
#include "fit/solver.h"
#include "fit/start.h"
#include "synthetic.h"

using namespace gonio;
using namespace gonio::test;

namespace {

FitRequest request_of(std::string_view name, int starts = 2) {
  FitRequest request;
  request.model = spec_of(name);
  request.starts = starts;
  return request;
}

std::string refusal(const Measurement& scan, const FitRequest& request) {
  try {
    fit(scan, request);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("derivatives are those of the residuals", "[fit]") {
  std::vector<ModelSpec> specs{spec_of("lambert"), spec_of("pseudo-realistic"), spec_of("beckmann-kirchhoff")};
  for (const char* shadowing : {"v-cavity", "smith-separable", "smith-correlated", "smith-1967", "none"})
    specs.push_back(spec_of("torrance-sparrow")), set_shadowing(specs.back(), shadowing);
  for (const char* variant : {"rough-limit", "smooth-limit"})
    specs.push_back(spec_of("beckmann-kirchhoff")), set_variant(specs.back(), variant);
  for (const ModelSpec& spec : specs) {
    for (const Metric metric : {Metric::log, Metric::linear, Metric::cuberoot}) {
      FitRequest request;
      request.model = spec, request.metric = metric, request.free_n = spec.id != ModelId::lambert;
      FitResult result;
      const Prepared ready = prepare(empty_scan(), request, result);
      std::vector<double> x = start_point(ready.problem, 2, 1);
      const Linearised at = linearise(ready.problem, x);
      REQUIRE(at.finite);
      constexpr double kStep = 1e-5;  // error of the difference: step² times a third derivative
      for (std::size_t j = 0; j < x.size(); ++j) {
        std::vector<double> up = x, down = x;
        up[j] += kStep, down[j] -= kStep;
        const Eigen::VectorXd difference =
            (linearise(ready.problem, up).residual - linearise(ready.problem, down).residual) / (2 * kStep);
        const double scale = at.jacobian.col(static_cast<Eigen::Index>(j)).cwiseAbs().maxCoeff();
        INFO(spec.info().name << " " << ready.problem.free[j].name << " " << name_of(metric));
        CHECK((difference - at.jacobian.col(static_cast<Eigen::Index>(j))).cwiseAbs().maxCoeff() <=
              1e-6 * scale + 1e-10);
      }
    }
  }
}

TEST_CASE("points in SIMD lanes are the points one by one", "[fit]") {
  for (const char* name : {"lambert", "pseudo-realistic", "torrance-sparrow", "beckmann-kirchhoff"}) {
    FitRequest request = request_of(name);
    FitResult result;
    const Prepared ready = prepare(empty_scan(7), request, result);
    std::vector<double> x = start_point(ready.problem, 1, 1);
    const std::vector<double> whole = ready.problem.predict(x);
    const Linearised lanes = linearise(ready.problem, x);
    for (std::size_t p = 0; p < whole.size(); ++p) {
      const FitPoint& point = ready.problem.points[p];
      const double residual = ready.problem.compared(whole[p], point) - ready.problem.compared(point.f_per_sr, point);
      CHECK(lanes.residual[Eigen::Index(p)] == Approx(residual).epsilon(1e-10).margin(1e-10));
    }
  }
}

TEST_CASE("an exponent called n is no refractive index", "[fit]") {
  const Measurement scan = synthetic(empty_scan(), spec_of("phong-1975"), std::vector<double>{40, 0.1, 0.5},
                                     perfect_interface<double>(), 0.02);
  FitRequest request = request_of("phong-1975");
  const FitResult result = fit(scan, request);
  CHECK(result.value("n") == Approx(40).epsilon(0.1));
  CHECK_FALSE(result.index().has_value());
  CHECK_FALSE(parse_fit(to_json(result).dump(), "fit.json").n.has_value());
  request.free_n = true;
  CHECK(refusal(scan, request).find("of this name") != std::string::npos);
}

TEST_CASE("a peak that one point an incidence hits is not fitted in silence, a well-sampled one is", "[fit]") {
  const auto warned = [](double slope_rms) {
    const Measurement scan =
        synthetic(empty_scan(), spec_of("torrance-sparrow"), std::vector<double>{slope_rms, 0.05, 0.9},
                  perfect_interface<double>(), 0.02);  // steps of 5°, mirror directions hit
    FitRequest request = request_of("torrance-sparrow", 6);
    request.material = "perfect";
    const FitResult result = fit(scan, request);
    return warns(result, "points an incidence") || warns(result, "cannot be told apart");
  };
  CHECK(warned(0.003));
  CHECK(warned(0.006));
  CHECK_FALSE(warned(0.05));
  CHECK_FALSE(warned(0.3));
}

TEST_CASE("Lambert's fit is the mean of the logarithms, its error the textbook's", "[fit]") {
  const Measurement scan =
      synthetic(empty_scan(), spec_of("lambert"), std::vector<double>{0.5}, perfect_interface<double>(), 0.1);
  FitRequest request = request_of("lambert");
  request.floor_per_sr = 0, request.hold_out = HoldOut::none;
  const FitResult result = fit(scan, request);
  double mean = 0, squares = 0;
  const double count = static_cast<double>(scan.points.size());
  for (const ScanPoint& p : scan.points) mean += std::log(kPi<double> * p.f_per_sr) / count;
  for (const ScanPoint& p : scan.points) squares += square(std::log(kPi<double> * p.f_per_sr) - mean);
  const double error = std::sqrt(squares / (count - 1) / count),
               t95 = 1.9746;  // Student's t for 164 degrees of freedom
  REQUIRE(scan.points.size() == 165);
  CHECK(result.value("kd") == Approx(std::exp(mean)).epsilon(1e-8));
  CHECK(result.parameters[0].standard_error.value() == Approx(error * std::exp(mean)).epsilon(1e-6));
  CHECK(result.parameters[0].hi95 == Approx(std::exp(mean + t95 * error)).epsilon(1e-5));
  CHECK(result.all.rms == Approx(std::sqrt(squares / count)).epsilon(1e-9));
  CHECK(result.all.rms_log10 == Approx(std::sqrt(squares / count) / std::log(10.0)).epsilon(1e-9));
}

TEST_CASE("what the data cannot tell apart is named", "[fit][slow]") {
  const ModelSpec spec = spec_of("beckmann-kirchhoff");
  const Interface<double> perfect = perfect_interface<double>();
  FitRequest request = request_of("beckmann-kirchhoff", 4);
  request.material = "perfect";
  SECTION("large g: only sigma/T, lost in the noise") {
    const FitResult result =
        fit(synthetic(empty_scan(), spec, std::vector<double>{4, 80, 0.1, 0.3}, perfect, 0.05), request);
    CHECK(warns(result, "sigma_um and correlation_um cannot be told apart: only sigma_um/correlation_um = 0.0"));
    CHECK_FALSE(result.find("sigma_um")->identifiable);
    CHECK_FALSE(result.find("correlation_um")->identifiable);
    CHECK_FALSE(result.find("sigma_um")->standard_error.has_value());
    CHECK(result.value("sigma_um") / result.value("correlation_um") == Approx(0.05).epsilon(0.03));
    CHECK(result.find("ks")->identifiable);
  }
  SECTION("large g beyond the box: the valley of constant sigma/T ends at a bound") {
    const FitResult result =
        fit(synthetic(empty_scan(), spec, std::vector<double>{100, 1000, 0.05, 1}, perfect), request);
    CHECK(warns(result, "only sigma_um/correlation_um = 0.0999"));
    CHECK_FALSE(result.find("sigma_um")->identifiable);
    CHECK_FALSE(result.find("correlation_um")->identifiable);
    CHECK(result.value("sigma_um") / result.value("correlation_um") == Approx(0.1).epsilon(1e-3));
  }
  SECTION("large g, exact data: recovered, with a word of caution") {
    const FitResult result = fit(synthetic(empty_scan(), spec, std::vector<double>{2, 20, 0.05, 1}, perfect), request);
    CHECK(result.value("sigma_um") == Approx(2).epsilon(1e-6));
    CHECK(warns(result, "rough limit (median g = "));
  }
  SECTION("the limit of large g: only sigma/T, exactly") {
    request.model.set("variant", "rough-limit");
    const FitResult result =
        fit(synthetic(empty_scan(), request.model.first(), std::vector<double>{1, 10, 0.05, 1}, perfect), request);
    CHECK(warns(result, "only sigma_um/correlation_um = 0.1 is determined"));
    CHECK(result.value("sigma_um") / result.value("correlation_um") == Approx(0.1).epsilon(1e-6));
    CHECK(result.value("ks") == Approx(1).epsilon(1e-6));
  }
  SECTION("small g: only sigma² ks") {
    Measurement scan = empty_scan();
    for (ScanPoint& p : scan.points) p.wavelength_nm = 100000;
    const FitResult result = fit(synthetic(scan, spec, std::vector<double>{0.1, 100, 1e-4, 1}, perfect, 0.05), request);
    CHECK(warns(result, "sigma_um and ks cannot be told apart: only sigma_um^2*ks = 0.0"));
    CHECK(square(result.value("sigma_um")) * result.value("ks") == Approx(0.01).epsilon(0.1));
    CHECK(result.find("correlation_um")->identifiable);
  }
}

TEST_CASE("one incidence is left out and judged", "[fit]") {
  const ModelSpec spec = spec_of("torrance-sparrow");
  const Measurement scan =
      synthetic(empty_scan(), spec, std::vector<double>{0.2, 0.1, 1}, perfect_interface<double>(), 0.05);
  FitRequest request = request_of("torrance-sparrow");
  const FitResult middle = fit(scan, request);
  REQUIRE(middle.held_out.has_value());
  CHECK(middle.held_out->theta_i_deg == 30);
  CHECK(middle.held_out->points == 33);
  CHECK(middle.points_used == 132);
  CHECK(middle.held_out->rms_log10 == Approx(0.05 / std::log(10.0)).epsilon(0.4));  // sd of an rms of 33: 12 %
  request.hold_out = HoldOut::chosen, request.hold_out_deg = 60;
  CHECK(fit(scan, request).held_out->theta_i_deg == 60);
  request.hold_out_deg = 50;
  CHECK(refusal(scan, request).find("expected one of 0, 15, 30, 45, 60") != std::string::npos);
  request.hold_out = HoldOut::none;
  CHECK_FALSE(fit(scan, request).held_out.has_value());
}

TEST_CASE("what cannot be fitted is refused in one line", "[fit]") {
  Measurement scan = synthetic(empty_scan(), spec_of("lambert"), std::vector<double>{0.5}, perfect_interface<double>());
  FitRequest request = request_of("torrance-sparrow");
  request.material = "unobtainium";
  CHECK(refusal(scan, request).find("unobtainium") != std::string::npos);
  request.material = "Au";
  request.free_n = true;
  CHECK(refusal(scan, request).find("expected one of them") != std::string::npos);
  request.free_n = false;
  for (ScanPoint& p : scan.points) p.wavelength_nm = 50000;
  CHECK(refusal(scan, request).find("50000") != std::string::npos);
  for (ScanPoint& p : scan.points) p.wavelength_nm = kNotStated;
  CHECK(refusal(scan, request).find("need a wavelength") != std::string::npos);
  request = request_of("beckmann-kirchhoff");
  CHECK(refusal(scan, request).find("needs the wavelength") != std::string::npos);
  request = request_of("torrance-sparrow");
  request.held = {{"m", 100.0}};
  CHECK(refusal(scan, request).find("outside the box") != std::string::npos);
  request.held.clear();
  scan.points.resize(2);
  scan.incidences_deg.resize(1);
  CHECK(refusal(scan, request).find("2 usable points") != std::string::npos);
}

TEST_CASE("values that a logarithm has no place for are left out and counted", "[fit]") {
  Measurement scan = synthetic(empty_scan(), spec_of("lambert"), std::vector<double>{0.5}, perfect_interface<double>());
  scan.points[0].f_per_sr = 0;
  scan.points[1].f_per_sr = -1;
  const FitResult log = fit(scan, request_of("lambert"));
  CHECK(log.left_out.at("value <= 0 under the log metric") == 2);
  CHECK(log.value("kd") == Approx(0.5).epsilon(1e-9));
  FitRequest linear = request_of("lambert");
  linear.metric = Metric::linear;
  CHECK(fit(scan, linear).left_out.empty());
}

TEST_CASE("the same seed gives the same fit for any number of threads", "[fit]") {
  const Measurement scan = synthetic(empty_scan(), spec_of("torrance-sparrow"), std::vector<double>{0.2, 0.1, 1},
                                     perfect_interface<double>(), 0.05);
  const FitRequest request = request_of("torrance-sparrow", 6);
  std::string first;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const std::string json = to_json(fit(scan, request)).dump();
    if (first.empty()) first = json;
    CHECK(json == first);
  }
}

TEST_CASE("fit.json comes back as the material that was fitted", "[fit]") {
  const ModelSpec spec = spec_of("torrance-sparrow");
  FitRequest request = request_of("torrance-sparrow");
  request.model.set("shadowing", "v-cavity");
  request.material = "Au";
  const FitResult result =
      fit(synthetic(empty_scan(), spec, std::vector<double>{0.2, 0.1, 1}, perfect_interface<double>(), 0.05), request);
  const nlohmann::ordered_json json = to_json(result);
  const FittedMaterial back = parse_fit(json.dump(), "fit.json");
  CHECK(back.values == result.values());
  CHECK(back.model.first().shadowing == Shadowing::v_cavity);
  CHECK(back.material == "Au_Johnson");
  CHECK(back.wavelength({}) == 550);
  CHECK(back.wavelength(600) == 600);  // shared parameters, n and k from the database
  CHECK(evaluate(back.brdfs({}).front(), directions_from_deg(30.0, 30.0, 180.0), back.surface(550), 0.55) ==
        predict(result, 30, std::array{30.0}, 180).front());

  const auto refused = [](const std::string& text) {
    try {
      parse_fit(text, "f.json");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK(refused("{").starts_with("f.json: is no complete JSON"));
  CHECK(refused("[]").starts_with("f.json: gonio_fit is missing"));
  for (const char* key : {"gonio_fit", "model", "parameters", "wavelength_nm", "material"}) {
    nlohmann::ordered_json without = json;
    without.erase(key);
    CHECK(refused(without.dump()).find(key) != std::string::npos);
  }
  nlohmann::ordered_json wrong = json;
  wrong["parameters"]["m"]["value"] = -1;
  CHECK(refused(wrong.dump()).starts_with("f.json: m is -1"));
  FittedMaterial without_material = back;
  without_material.material.reset();
  CHECK_THROWS_AS(without_material.wavelength(600), InputError);
}

TEST_CASE("the bundled measurements: PTFE is nearly Lambertian, MERL's aluminium defeats a Gaussian lobe", "[fit]") {
  const FitResult ptfe =
      fit(read_measurement(data_folder("measurements") / "ptfe-sintered-nist-532nm"), request_of("lambert"));
  CHECK(ptfe.value("kd") == Approx(0.98).margin(0.02));  // Germer: reflectance about 0.99
  CHECK(ptfe.all.rms_log10 < 0.05);
  CHECK_FALSE(warns(ptfe, "does not explain"));

  const FitResult aluminium =
      fit(read_measurement(data_folder("measurements") / "aluminium-merl"), request_of("torrance-sparrow"));
  CHECK(aluminium.material == "Al_Rakic");
  CHECK(aluminium.wavelength_nm.empty());
  CHECK(aluminium.assumed_wavelength_nm.value() == 550);
  CHECK(warns(aluminium, "the wavelength is not stated"));
  CHECK(warns(aluminium, "torrance-sparrow does not explain these data"));
  CHECK(warns(aluminium, "too dark by a factor of"));
  CHECK(warns(aluminium, "residuals are structured"));
}

TEST_CASE("plots show what was measured and fitted, the same bytes every time", "[fit]") {
  const FitResult result = fit(synthetic(empty_scan(), spec_of("torrance-sparrow"), std::vector<double>{0.2, 0.1, 1},
                                         perfect_interface<double>(), 0.05),
                               request_of("torrance-sparrow"));
  REQUIRE(has_in_plane_curves(result));
  const std::string svg = in_plane_svg(result, true);
  CHECK(svg.find("measured 15°") != std::string::npos);
  CHECK(svg.find("measured 30° (left out)") != std::string::npos);
  CHECK(svg.find("</svg>") != std::string::npos);
  CHECK(svg == in_plane_svg(result, true));
  CHECK(scatter_svg(result).find("agreement") != std::string::npos);
}
