// Noise-free data must give back the parameters they were made with, from nearly every start; noisy data must give
// intervals that hold the truth as often as they say.
#include <tbb/parallel_for.h>

#include <Eigen/SVD>
#include <atomic>

#include "catch.h"
#include "fit/solver.h"
#include "fit/start.h"
#include "materials/database.h"
#include "synthetic.h"

using namespace gonio;
using namespace gonio::test;

namespace {

/// A point in the middle 80 % of every box, on the logarithmic scale.
std::vector<double> truth_of(const ModelInfo& info, std::mt19937_64& random) {
  std::uniform_real_distribution<double> middle(0.1, 0.9);
  std::vector<double> values;
  for (const ParameterInfo& p : info.parameters)
    values.push_back(p.fit_lo * std::pow(p.fit_hi / p.fit_lo, middle(random)));
  return values;
}

bool identifiable(const FitProblem& problem, const std::vector<double>& x) {
  Eigen::MatrixXd jacobian = linearise(problem, x).jacobian;
  for (Eigen::Index j = 0; j < jacobian.cols(); ++j) jacobian.col(j).normalize();
  const Eigen::VectorXd singular = Eigen::BDCSVD<Eigen::MatrixXd>(jacobian).singularValues();
  return singular.minCoeff() > 1e-6 * singular.maxCoeff();
}

double worst_error(const std::vector<double>& found, const std::vector<double>& truth) {
  double worst = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) worst = std::max(worst, std::abs(found[i] / truth[i] - 1));
  return worst;
}

struct Recovery {
  int starts = 0, recovered = 0, fits = 0, fits_recovered = 0;
};

Recovery recover(const ModelSpec& spec, Metric metric, int truths, int starts, const std::string& material) {
  const Interface<double> surface = SurfaceMaterial(material).at(550);
  std::mt19937_64 random(20240607);
  Recovery count;
  for (int t = 0; t < truths; ++t) {
    const std::vector<double> truth = truth_of(spec.info(), random);
    const Measurement scan = synthetic(empty_scan(), spec, truth, surface);
    FitRequest request;
    request.model = spec, request.metric = metric, request.starts = starts, request.material = material;
    FitResult result;
    const Prepared ready = prepare(scan, request, result);
    std::vector<double> x;
    for (const double value : truth) x.push_back(std::log(value));
    if (!identifiable(ready.problem, x)) continue;
    std::atomic<int> recovered = 0;
    const LaneFit all(ready.problem, every_point(ready.problem));
    tbb::parallel_for(0, starts, [&](int start) {
      const Solution found = all.solve(improve_start(all, start_point(ready.problem, start, 1)), kSearch);
      if (worst_error(ready.problem.values_at(found.x), truth) < 1e-6) ++recovered;
    });
    count.starts += starts, count.recovered += recovered;
    const FitResult best = fit(scan, request);
    ++count.fits, count.fits_recovered += best.converged && worst_error(best.values(), truth) < 1e-6;
  }
  return count;
}

}  // namespace

TEST_CASE("noise-free data give back their parameters from nearly every start", "[fit][recovery][slow]") {
  struct Case {
    const char* model;
    Metric metric;
    int truths;
    const char* material;
  };
  // False alarms: none, everything is seeded. Over larger sweeps every single start recovered.
  for (const Case& c :
       {Case{"lambert", Metric::log, 2, "perfect"}, Case{"pseudo-realistic", Metric::log, 6, "Au"},
        Case{"torrance-sparrow", Metric::log, 6, "BK7"}, Case{"torrance-sparrow", Metric::cuberoot, 4, "Al"},
        Case{"beckmann-kirchhoff", Metric::log, 3, "Cr"}}) {
    const Recovery count = recover(spec_of(c.model), c.metric, c.truths, 16, c.material);
    INFO(c.model << " " << name_of(c.metric) << ": " << count.recovered << " of " << count.starts << " starts");
    CHECK(count.fits >= c.truths / 2);
    CHECK(count.recovered >= 0.9 * count.starts);
    CHECK(count.fits_recovered == count.fits);
  }
}

TEST_CASE("every shadowing is recovered, and n where it is free", "[fit][recovery]") {
  const Interface<double> surface{1.7, 0.0};
  for (const char* shadowing : {"v-cavity", "smith-separable", "smith-correlated", "smith-1967", "none"}) {
    ModelSpec spec = spec_of("torrance-sparrow");
    set_shadowing(spec, shadowing);
    const std::vector<double> truth{0.25, 0.1, 0.8};
    FitRequest request;
    request.model = spec, request.free_n = true, request.starts = 4;
    const FitResult result = fit(synthetic(empty_scan(), spec, truth, surface), request);
    INFO(shadowing);
    CHECK(result.converged);
    CHECK(worst_error(result.values(), truth) < 1e-6);
    CHECK(result.index().value() == Approx(1.7).epsilon(1e-6));
    CHECK_FALSE(result.material.has_value());
  }
}

TEST_CASE("a diffuse part of exactly zero is found, and held parameters stay", "[fit][recovery]") {
  const ModelSpec spec = spec_of("torrance-sparrow");
  const Measurement scan =
      synthetic(empty_scan(), spec, std::vector<double>{0.3, 0.0, 0.7}, perfect_interface<double>());
  FitRequest request;
  request.model = spec, request.starts = 2, request.material = "perfect";
  const FitResult free = fit(scan, request);
  CHECK(free.value("kd") == 0);
  CHECK(free.find("kd")->at_bound);
  CHECK(free.value("m") == Approx(0.3).epsilon(1e-6));
  CHECK(free.value("ks") == Approx(0.7).epsilon(1e-6));
  request.held = {{"kd", 0.0}, {"ks", 0.7}};
  const FitResult held = fit(scan, request);
  CHECK(held.find("ks")->held);
  CHECK(held.value("m") == Approx(0.3).epsilon(1e-6));
}

TEST_CASE("95 % intervals hold the truth in 90 to 99 % of noisy repeats", "[fit][recovery][slow]") {
  // 200 repeats at 95 %: outside [180, 198] by chance with probability 0.003 for each parameter; the seeds are fixed.
  constexpr int kRepeats = 200;
  const ModelSpec spec = spec_of("torrance-sparrow");
  const std::vector<double> truth{0.2, 0.05, 0.9};
  const Measurement clean = empty_scan(10);
  const Interface<double> surface = SurfaceMaterial("Au").at(550);
  std::array<std::atomic<int>, 3> inside{};
  tbb::parallel_for(0, kRepeats, [&](int repeat) {
    FitRequest request;
    request.model = spec, request.starts = 1, request.material = "Au", request.hold_out = HoldOut::none;
    const FitResult result = fit(synthetic(clean, spec, truth, surface, 0.05, 1000 + repeat), request);
    for (std::size_t i = 0; i < truth.size(); ++i)
      inside[i] += result.parameters[i].lo95 <= truth[i] && truth[i] <= result.parameters[i].hi95;
  });
  for (std::size_t i = 0; i < truth.size(); ++i) {
    INFO(spec.info().parameters[i].name << ": " << inside[i]);
    CHECK(inside[i] >= 0.90 * kRepeats);
    CHECK(inside[i] <= 0.99 * kRepeats);
  }
}

TEST_CASE("wavelengths share their parameters, and a relative scan has its own unit", "[fit][recovery]") {
  const ModelSpec spec = spec_of("beckmann-kirchhoff");
  const std::vector<double> truth{0.15, 2.5, 0.02, 0.8};
  Measurement scan = empty_scan(10);
  const Measurement red = [&] {
    Measurement other = scan;
    for (ScanPoint& p : other.points) p.wavelength_nm = 633;
    return synthetic(other, spec, truth, SurfaceMaterial("Au").at(633));
  }();
  scan = synthetic(scan, spec, truth, SurfaceMaterial("Au").at(550));
  scan.points.insert(scan.points.end(), red.points.begin(), red.points.end());
  FitRequest request;
  request.model = spec, request.starts = 2, request.material = "Au";
  const FitResult two = fit(scan, request);
  CHECK(two.wavelength_nm == std::vector<double>{550, 633});
  CHECK(worst_error(two.values(), truth) < 1e-6);
  CHECK(warns(two, "shared by 2 wavelengths"));

  const std::vector<double> rough{0.2, 0.1, 0.9};
  Measurement relative = synthetic(empty_scan(), spec_of("torrance-sparrow"), rough, perfect_interface<double>());
  relative.quantity = "relative";
  for (ScanPoint& p : relative.points) p.f_per_sr *= 12345;
  request.model = spec_of("torrance-sparrow"), request.material = "perfect";
  const FitResult unit = fit(relative, request);
  CHECK(unit.value("m") == Approx(0.2).epsilon(1e-6));
  CHECK(unit.value("ks") == Approx(0.9 * 12345).epsilon(1e-6));
  CHECK(warns(unit, "the scan is relative"));
}
