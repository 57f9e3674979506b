// Sums of lobes, kd and ks of each wavelength, the likelihood and apertures: truth known in closed form or by brute force.
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "catch.h"
#include "fit/fit_json.h"
#include "fit/fitted_material.h"
#include "fit/solver.h"
#include "materials/database.h"
#include "synthetic.h"

using namespace gonio;
using namespace gonio::test;

namespace {

/// The scan with the values of a sum, kd and ks times `scale` at each row's wavelength, times exp(noise·N(0, 1)).
template <class ScaleOf>
Measurement filled_by(Measurement scan, const LobeSum& model, const std::vector<double>& values,
                      const Interface<double>& surface, ScaleOf&& scale_of, double noise = 0) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (ScanPoint& p : scan.points) {
    std::vector<double> there = values;
    for (std::size_t i = 0; i < there.size(); ++i)
      if (model.is_diffuse(i) || model.is_scale(i)) there[i] *= scale_of(model.is_diffuse(i), p.wavelength_nm);
    const std::vector<Brdf<double>> lobes = make_brdfs(model, there);
    p.f_per_sr = evaluate<double>(lobes, directions_from_deg(p.theta_i_deg, p.theta_o_deg, p.phi_deg()), surface,
                                  p.wavelength_nm * 1e-3) *
                 std::exp(noise * normal(random));
  }
  return scan;
}
Measurement filled_by(Measurement scan, const LobeSum& model, const std::vector<double>& values,
                      const Interface<double>& surface) {
  return filled_by(std::move(scan), model, values, surface, [](bool, double) { return 1.0; });
}

/// The scan at several wavelengths, one after the other.
Measurement at_wavelengths(const Measurement& scan, const std::vector<double>& wavelengths_nm) {
  Measurement all = scan;
  all.points.clear();
  for (const double nm : wavelengths_nm)
    for (ScanPoint p : scan.points) p.wavelength_nm = nm, all.points.push_back(p);
  return all;
}

FitRequest request_for(const LobeSum& model, std::string material = "perfect") {
  FitRequest request;
  request.model = model, request.material = std::move(material), request.hold_out = HoldOut::none;
  return request;
}

double worst_error(const std::vector<double>& found, const std::vector<double>& truth) {
  double worst = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) worst = std::max(worst, std::abs(found[i] / truth[i] - 1));
  return worst;
}

}  // namespace

TEST_CASE("a sum's parameters are its lobes' with suffixes, then kd and the ks", "[fit][sums]") {
  const LobeSum sum = lobe_sum("torrance-sparrow+ggx");
  std::vector<std::string> names;
  for (const ParameterInfo& p : sum.parameters()) names.emplace_back(p.name);
  CHECK(names == std::vector<std::string>{"m_1", "alpha_x_2", "alpha_y_2", "kd", "ks_1", "ks_2"});
  CHECK(sum.values_of(0, std::vector<double>{1, 2, 3, 4, 5, 6}) == std::vector<double>{1, 4, 5});
  CHECK(sum.values_of(1, std::vector<double>{1, 2, 3, 4, 5, 6}) == std::vector<double>{2, 3, 0, 6});
  CHECK(lobe_sum("ggx").parameters().front().name == "alpha_x");
  for (const char* wrong : {"", "ggx+", "ggx+lambert", "mirror+ggx", "ggx+ggx+ggx+ggx", "ggx+nothing"})
    CHECK_THROWS_AS(lobe_sum(wrong), InputError);
  LobeSum retro = sum;
  CHECK(retro.set("retro_2", "yes"));
  CHECK_FALSE(retro.set("m_1", "0.2"));
  CHECK_THROWS_AS(retro.set("retro", "yes"), InputError);
  CHECK_THROWS_AS(retro.set("retro_3", "yes"), InputError);
}

TEST_CASE("data of a sum give its parameters back", "[fit][sums]") {
  struct Case {
    std::string names;
    std::vector<std::size_t> retro;
    std::vector<double> truth;
  };
  const std::vector<Case> cases{
      {"torrance-sparrow+torrance-sparrow", {}, {0.06, 0.35, 0.2, 0.3, 0.5}},
      {"torrance-sparrow+phong-1975", {1}, {0.15, 60, 0.3, 0.4, 0.6}},
      {"ggx+beckmann-kirchhoff", {}, {0.1, 0.25, 0.8, 3.0, 0.1, 0.5, 0.4}},
      {"torrance-sparrow+ggx+phong-1975", {2}, {0.05, 0.4, 0.2, 80, 0.1, 0.3, 0.6, 0.5}},
  };
  const Interface<double> gold = SurfaceMaterial("Au").at(550);
  for (const Case& c : cases)
    for (const Metric metric : {Metric::log, Metric::cuberoot}) {
      LobeSum model = lobe_sum(c.names);
      for (const std::size_t lobe : c.retro) model.set(fmt::format("retro_{}", lobe + 1), "yes");
      FitRequest request = request_for(model, "Au");
      request.metric = metric, request.starts = 32;
      Measurement scan = empty_scan(2);  // and out of the plane, which tells alpha_x from alpha_y
      for (ScanPoint p : empty_scan(8).points) p.phi_o_deg += 70, scan.points.push_back(p);
      const FitResult result = fit(filled_by(scan, model, c.truth, gold), request);
      INFO(c.names << " " << name_of(metric) << " rms " << result.all.rms);
      CHECK(result.converged);
      CHECK(worst_error(result.values(), c.truth) < 1e-6);
    }
}

TEST_CASE("lobes of one kind come narrow first, whatever the start", "[fit][sums]") {
  const LobeSum model = lobe_sum("torrance-sparrow+torrance-sparrow");
  const Measurement scan = filled_by(empty_scan(2), model, {0.35, 0.06, 0.2, 0.5, 0.3}, SurfaceMaterial("Au").at(550));
  const FitResult result = fit(scan, request_for(model, "Au"));
  CHECK(worst_error(result.values(), {0.06, 0.35, 0.2, 0.3, 0.5}) < 1e-6);
}

TEST_CASE("the Jacobian of a sum, n of all lobes included, is that of differences", "[fit][sums]") {
  const LobeSum model = lobe_sum("torrance-sparrow+ggx");
  for (const Metric metric : {Metric::log, Metric::linear, Metric::cuberoot}) {
    FitRequest request = request_for(model);
    request.material.reset(), request.free_n = true, request.metric = metric;
    FitResult result;
    const Measurement scan = filled_by(empty_scan(), model, {0.2, 0.1, 0.3, 0.1, 0.5, 0.4}, {1.5, 0, false});
    const Prepared ready = prepare(scan, request, result);
    std::vector<double> x;
    for (const double value : {0.25, 0.12, 0.2, 0.15, 0.4, 0.5, 1.7}) x.push_back(std::log(value));
    const Linearised at = linearise(ready.problem, x);
    for (std::size_t j = 0; j < x.size(); ++j) {
      constexpr double kStep = 1e-5;
      std::vector<double> up = x, down = x;
      up[j] += kStep, down[j] -= kStep;
      const Eigen::VectorXd slope =
          (linearise(ready.problem, up).residual - linearise(ready.problem, down).residual) / (2 * kStep);
      const auto column = at.jacobian.col(Eigen::Index(j));
      INFO(ready.problem.free[j].name);
      CHECK((slope - column).norm() < 1e-7 * column.norm());
    }
    const std::vector<double> predicted = ready.problem.predict(x);
    for (std::size_t p = 0; p < predicted.size(); ++p) {
      const FitPoint& point = ready.problem.points[p];
      const double residual =
          ready.problem.compared(predicted[p], point) - ready.problem.compared(point.f_per_sr, point);
      CHECK(residual == Approx(at.residual[Eigen::Index(p)]).margin(1e-12));
    }
  }
}

TEST_CASE("a sum that is not needed says which lobe is nothing", "[fit][sums]") {
  const FitResult result = fit(synthetic(empty_scan(), spec_of("torrance-sparrow"), std::vector<double>{0.2, 0.1, 0.5},
                                         SurfaceMaterial("Au").at(550)),
                               request_for(lobe_sum("torrance-sparrow+torrance-sparrow"), "Au"));
  CHECK(result.all.rms < 1e-6);
  // One width is the truth; the other lobe is nothing, or the two are one.
  const bool split = std::abs(result.value("m_1") - result.value("m_2")) < 1e-3;
  CHECK((split || warns(result, "is not determined") || warns(result, "cannot be told apart") ||
         warns(result, "only in combination")));
  CHECK_THROWS_AS(fit(empty_scan(), request_for(lobe_sum("sgd-2012+sgd-2012"), "Au")), InputError);
}

TEST_CASE("fit.json of a sum comes back with its choices", "[fit][sums]") {
  LobeSum model = lobe_sum("torrance-sparrow+ggx");
  model.set("retro_2", "yes"), model.set("shadowing_1", "v-cavity");
  const FitResult result = fit(
      filled_by(empty_scan(), model, {0.2, 0.1, 0.3, 0.1, 0.5, 0.4}, perfect_interface<double>()), request_for(model));
  const nlohmann::ordered_json json = to_json(result);
  CHECK(json["model"] == "torrance-sparrow+ggx");
  CHECK(json["options"]["retro_2"] == "yes");
  const FittedMaterial back = parse_fit(json.dump(), "fit.json");
  CHECK(back.values == result.values());
  CHECK(back.model.lobes()[1].retro);
  CHECK(back.model.first().shadowing == Shadowing::v_cavity);
  const std::vector<Brdf<double>> lobes = back.brdfs(550);
  CHECK(evaluate<double>(lobes, directions_from_deg(30.0, 20.0, 180.0), back.surface(550), 0.55) ==
        predict(result, 30, std::array{20.0}, 180).front());
  nlohmann::ordered_json wrong = json;
  wrong["options"]["retro_4"] = "yes";
  CHECK_THROWS_AS(parse_fit(wrong.dump(), "fit.json"), InputError);
}

TEST_CASE("kd and ks of each wavelength beside a shape that all share", "[fit][spectral]") {
  const std::vector<double> nm{450, 550, 600, 700};
  const auto scale = [](bool diffuse, double at_nm) { return diffuse ? at_nm / 600 : 600 / at_nm; };
  const LobeSum model = lobe_sum("torrance-sparrow");
  FitRequest request = request_for(model);
  request.spectral = {"kd", "ks"};
  const Measurement scan =
      filled_by(at_wavelengths(empty_scan(), nm), model, {0.2, 0.3, 0.5}, perfect_interface<double>(), scale);
  const FitResult result = fit(scan, request);
  CHECK(result.value("m") == Approx(0.2).epsilon(1e-8));
  for (std::size_t i = 0; i < nm.size(); ++i) {
    CHECK(result.by_wavelength("kd")[i] == Approx(0.3 * nm[i] / 600).epsilon(1e-8));
    CHECK(result.by_wavelength("ks")[i] == Approx(0.5 * 600 / nm[i]).epsilon(1e-8));
  }
  CHECK_FALSE(warns(result, "shared by"));

  const nlohmann::ordered_json json = to_json(result);
  CHECK(json["parameters"]["kd"]["value"].size() == 4);
  CHECK(json["parameters"]["kd"]["interval95"][2].size() == 2);
  CHECK(json["parameters"]["m"]["value"].is_number());
  const FittedMaterial back = parse_fit(json.dump(), "fit.json");
  CHECK(back.values_at(575)[1] == Approx(0.3 * 575 / 600).epsilon(1e-8));  // linear between
  CHECK(back.values_at(450)[2] == Approx(0.5 * 600 / 450).epsilon(1e-8));
  CHECK_THROWS_AS(back.wavelength(449), InputError);
  CHECK_THROWS_AS(back.wavelength({}), InputError);
  nlohmann::ordered_json short_of_one = json;
  short_of_one["parameters"]["kd"]["value"].erase(0);
  CHECK_THROWS_AS(parse_fit(short_of_one.dump(), "fit.json"), InputError);
  nlohmann::ordered_json shapes = json;
  shapes["parameters"]["m"]["value"] = {0.1, 0.2, 0.3, 0.4};
  CHECK_THROWS_AS(parse_fit(shapes.dump(), "fit.json"), InputError);
  nlohmann::ordered_json one = json;
  one["wavelength_nm"] = {550};
  for (const char* name : {"kd", "ks"}) one["parameters"][name]["value"] = {0.25};
  CHECK(parse_fit(one.dump(), "fit.json").values_at(550) == std::vector<double>{result.value("m"), 0.25, 0.25});

  // A wavelength without a lobe: its ks is 0, the others stand.
  const auto dark = [](bool diffuse, double at_nm) { return diffuse || at_nm != 600 ? 1.0 : 0.0; };
  const FitResult black = fit(
      filled_by(at_wavelengths(empty_scan(), nm), model, {0.2, 0.3, 0.5}, perfect_interface<double>(), dark), request);
  CHECK(black.by_wavelength("ks")[2] == 0);
  CHECK(black.by_wavelength("ks")[1] == Approx(0.5).epsilon(1e-8));
  CHECK(warns(black, "ks@600nm is at its bound, 0"));

  request.spectral = {"m"};
  CHECK_THROWS_AS(fit(scan, request), InputError);
  request.spectral = {"kd"};
  CHECK_THROWS_AS(fit(at_wavelength(scan, 550), request), InputError);
}

TEST_CASE("the likelihood of one constant is its weighted mean", "[fit][likelihood]") {
  Measurement scan = empty_scan();
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  double weights = 0, sum = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    ScanPoint& p = scan.points[i];
    p.f_std_per_sr = i % 2 ? 0.001 : 0.02;
    p.f_per_sr = 0.2 + p.f_std_per_sr * normal(random);
    weights += 1 / square(p.f_std_per_sr), sum += p.f_per_sr / square(p.f_std_per_sr);
  }
  FitRequest request = request_for(lobe_sum("lambert"));
  request.metric = Metric::likelihood;
  const FitResult result = fit(scan, request);
  CHECK(result.value("kd") == Approx(kPi<double> * sum / weights).epsilon(1e-10));
  // Its error is that of the weighted mean, times the root of the reduced chi² where that is more than 1.
  const double error = kPi<double> / std::sqrt(weights) * std::sqrt(std::max(1.0, *result.chi2_reduced));
  CHECK(*result.find("kd")->standard_error == Approx(error).epsilon(1e-6));
  CHECK(*result.chi2_reduced == Approx(1).margin(4 * std::sqrt(2.0 / double(scan.points.size()))));

  request.relative_sd = 0.1;  // a share of each value in place of what is stated
  CHECK(fit(scan, request).relative_sd == 0.1);
  request.weighting = Weighting::cosine;
  CHECK_THROWS_AS(fit(scan, request), InputError);
}

TEST_CASE("nodes of an aperture average polynomials as the discs do", "[fit][aperture]") {
  CHECK(aperture_nodes({}).empty());
  CHECK_THROWS_AS(aperture_nodes({41, 0}), InputError);
  CHECK_THROWS_AS(aperture_nodes({-1, 0}), InputError);
  const double radius = std::tan(1.5 * kPi<double> / 180);
  double all = 0, square_mean = 0, fourth = 0, mixed = 0;
  for (const ApertureNode& node : aperture_nodes({3, 0})) {
    const auto [x, y] = node.detector;
    all += node.weight, square_mean += node.weight * x * x, fourth += node.weight * square(x * x + y * y);
    mixed += node.weight * x * x * x * y;
    CHECK(node.source == std::array<double, 2>{});
  }
  CHECK(all == Approx(1).epsilon(1e-14));
  CHECK(square_mean == Approx(square(radius) / 4).epsilon(1e-12));
  CHECK(fourth == Approx(square(square(radius)) / 3).epsilon(1e-12));
  CHECK(mixed == Approx(0).margin(1e-18));
}

TEST_CASE("through an aperture at the normal, in retro and at grazing", "[fit][aperture]") {
  const std::vector<ApertureNode> nodes = aperture_nodes({6, 2});
  const std::vector<Brdf<double>> lobes{
      make_brdf<double>(spec_of("torrance-sparrow"), std::vector<double>{0.3, 0.1, 0.5})};
  // Exactly the normal (no plane of the zenith), i = o, the mirror, and half the discs below the horizon.
  for (const auto& [theta_i, theta_o, phi] : {std::array{0.0, 0.0, 0.0}, std::array{40.0, 40.0, 0.0},
                                              std::array{60.0, 60.0, 180.0}, std::array{89.9, 89.9, 180.0}}) {
    const Directions<double> w = directions_from_deg(theta_i, theta_o, phi);
    const double mean = seen(lobes, w, perfect_interface<double>(), 0.55, nodes);
    CHECK(std::isfinite(mean));
    CHECK(mean > 0);
    double below = 0;
    for (const ApertureNode& node : nodes) {
      double weight = 0;
      const Directions<double> there = through(node, w, weight);
      CHECK(weight >= 0);
      CHECK(std::isfinite(there.tan2_h));
      below += weight == 0;
    }
    CHECK((below > 0) == (theta_o > 85));
  }
  // A small aperture sees what its centre does.
  const Directions<double> w = directions_from_deg(30.0, 20.0, 170.0);
  const double centre = evaluate<double>(lobes, w, perfect_interface<double>(), 0.55);
  CHECK(seen(lobes, w, perfect_interface<double>(), 0.55, aperture_nodes({0.01, 0.01})) ==
        Approx(centre).epsilon(1e-6));
}

TEST_CASE("an aperture is taken out of the width of a narrow peak", "[fit][aperture]") {
  // f over a disc by brute force: 20 rings of 40, far more than the fit's nodes.
  const auto seen_by_disc = [](Measurement scan, const ModelSpec& spec, const std::vector<double>& values,
                               double full_deg) {
    const Brdf<double> brdf = make_brdf<double>(spec, values);
    std::vector<ApertureNode> nodes;
    const double radius = std::tan(0.5 * full_deg * kPi<double> / 180);
    for (int ring = 0; ring < 20; ++ring)
      for (int turn = 0; turn < 40; ++turn) {
        const double r = radius * std::sqrt((ring + 0.5) / 20), angle = 2 * kPi<double> * (turn + 0.5) / 40;
        nodes.push_back({1, {}, {r * std::cos(angle), r * std::sin(angle)}});
      }
    for (ScanPoint& p : scan.points) {
      double sum = 0, weights = 0;
      for (const ApertureNode& node : nodes) {
        double weight = 0;
        const auto w = through(node, directions_from_deg(p.theta_i_deg, p.theta_o_deg, p.phi_deg()), weight);
        sum += weight * evaluate(brdf, w, perfect_interface<double>(), 0.55), weights += weight;
      }
      p.f_per_sr = sum / weights;
    }
    return scan;
  };
  const ModelSpec spec = spec_of("torrance-sparrow");
  const Measurement scan = seen_by_disc(empty_scan(0.5), spec, {0.03, 0.1, 0.5}, 6);
  FitRequest request = request_for(spec);
  request.metric = Metric::cuberoot;
  CHECK(std::abs(fit(scan, request).value("m") / 0.03 - 1) > 0.05);  // taken for the surface's, it is too wide
  request.aperture.detector_deg = 6;
  const FitResult opened = fit(scan, request);
  INFO(opened.value("m") << " " << opened.value("ks"));
  CHECK(opened.value("m") == Approx(0.03).epsilon(2e-3));
  CHECK(opened.value("ks") == Approx(0.5).epsilon(2e-3));
  CHECK(to_json(opened)["aperture"]["detector_deg"] == 6);
  // A constant is the same through any aperture, at grazing too.
  FitRequest diffuse = request_for(lobe_sum("lambert"));
  diffuse.aperture = {10, 5};
  Measurement flat = empty_scan();
  for (ScanPoint& p : flat.points) p.f_per_sr = 0.2;
  CHECK(fit(flat, diffuse).value("kd") == Approx(0.2 * kPi<double>).epsilon(1e-12));
}

TEST_CASE("where no deviation is stated, repeats give it", "[fit][likelihood]") {
  Measurement scan = empty_scan();
  const std::vector<ScanPoint> once = scan.points;
  scan.points.insert(scan.points.end(), once.begin(), once.end());
  FitRequest request = request_for(spec_of("torrance-sparrow"));
  request.metric = Metric::likelihood;
  const FitResult result = fit(synthetic(scan, spec_of("torrance-sparrow"), std::vector<double>{0.2, 0.1, 0.5},
                                         perfect_interface<double>(), 0.03),
                               request);
  CHECK(result.relative_sd == Approx(0.03).epsilon(0.25));
  CHECK(warns(result, "pairs of repeats"));
  CHECK(*result.chi2_reduced == Approx(1).margin(0.4));
  CHECK(result.value("m") == Approx(0.2).epsilon(0.01));
  CHECK_THROWS_AS(fit(empty_scan(), request), InputError);  // equal values say nothing of their error
}

TEST_CASE("n and k of a metal come back where ks is known", "[fit][surface]") {
  const Interface<double> copper = SurfaceMaterial("Cu").at(550);
  const std::vector<double> truth{0.25, 0.02, 1};
  Measurement scan = empty_scan(2);
  const Measurement seen = synthetic(scan, spec_of("torrance-sparrow"), truth, copper);
  FitRequest request = request_for(spec_of("torrance-sparrow"));
  request.material.reset(), request.free_n = request.free_k = true, request.held = {{"ks", 1.0}};
  const FitResult result = fit(seen, request);
  INFO(result.index().value_or(0) << " + i " << result.absorption().value_or(0));
  CHECK(*result.index() == Approx(copper.n).epsilon(1e-4));
  CHECK(*result.absorption() == Approx(copper.k).epsilon(1e-4));
  const FittedMaterial back = parse_fit(to_json(result).dump(), "fit.json");
  CHECK(back.surface(550).k == *result.absorption());
  request.free_n = false;
  CHECK_THROWS_AS(fit(seen, request), InputError);
  request.free_n = true, request.model = lobe_sum("sgd-2012"), request.held.clear();  // has a k of its own
  CHECK_THROWS_AS(fit(seen, request), InputError);
}
