#include "assess/fit_speed_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "assess/timing.h"

namespace gonio {
namespace {

constexpr std::array kMetrics{Metric::log, Metric::linear, Metric::cuberoot};
constexpr std::array kDerivatives{Derivatives::lanes, Derivatives::jet, Derivatives::numeric};
constexpr int kDefaultStarts = 16;  // of gonio fit
/// Four models of different cost, beside the peer's four (which are not named).
constexpr std::array<std::string_view, 4> kFourModels{"lambert", "torrance-sparrow", "ggx", "beckmann-kirchhoff"};

double now_ms(bool own) {
  timespec t{};
  clock_gettime(own ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &t);
  return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

/// Milliseconds, the least of several runs: other work on the machine only adds. On one thread the thread's own time, which
/// leaves out what it waited for a processor.
double least_ms(int repeats, int threads, const std::function<void()>& run) {
  double least = INFINITY;
  in_threads(threads, [&] {
    for (int repeat = 0; repeat < repeats; ++repeat) {
      const double from = now_ms(threads == 1);
      run();
      least = std::min(least, now_ms(threads == 1) - from);
    }
  });
  return least;
}

double whole_fit_ms(const FitSamples& samples, int starts) {
  FitRequest request = samples.request;
  request.starts = starts;
  return least_ms(3, 1, [&] { keep(fit(samples.scan, request)); });
}

FitSpeedRow sum_of(const std::vector<FitSpeedRow>& rows) {
  FitSpeedRow sum = rows[0];
  sum.model = std::to_string(rows.size()) + " models", sum.ms = 0, sum.parameter_error = sum.rms = NAN;
  for (const FitSpeedRow& row : rows) sum.ms += row.ms;
  return sum;
}

FitBar one_model(const std::string& what, const FitSamples& samples, int starts) {
  FitBar bar{what, 0, 0, "", {}, {}, 1, NAN};
  bar.one = timed_fit(what, samples, starts, 1), bar.two = timed_fit(what, samples, starts, 2);
  return bar;
}

}  // namespace

FitSpeedRow timed_fit(const std::string& size, const FitSamples& samples, int starts, int threads,
                      Derivatives derivatives, double tolerance, int repeats) {
  FitSpeedRow row{size,
                  samples.problem.model.name(),
                  samples.problem.metric,
                  derivatives,
                  starts,
                  threads,
                  tolerance,
                  samples.problem.points.size()};
  ManyStarts found;
  row.ms = least_ms(repeats, threads, [&] { found = solve_starts(samples.problem, starts, derivatives, tolerance); });
  row.rms = rms_of(samples.problem, found.best);
  row.parameter_error = parameter_error(samples, found.best.x);
  row.agreeing = found.agreeing;
  return row;
}

std::vector<FitSpeedRow> metric_rows() {
  std::vector<FitSpeedRow> rows;
  for (const char* name : {"torrance-sparrow", "ggx", "beckmann-kirchhoff"})
    for (const Metric metric : kMetrics) {
      const FitSamples samples = fit_samples({name, metric, 500, 16});
      for (const Derivatives derivatives : kDerivatives)
        rows.push_back(
            timed_fit("500 x 16", samples, 1, 1, derivatives, kSearch, derivatives == Derivatives::lanes ? 7 : 1));
    }
  return rows;
}

std::vector<FitSpeedRow> tolerance_rows(const std::string& name) {
  const FitSamples data = fit_samples({"cook-torrance-1981-two-widths", Metric::cuberoot, 500, 4});
  FitSamples samples = with_model(data, {model(name).id});
  samples.truth = solve_starts(samples.problem, 1, Derivatives::lanes, 1e-16).best.x;
  std::vector<FitSpeedRow> rows;
  for (const Derivatives derivatives : kDerivatives)
    for (const double tolerance : {1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12})
      rows.push_back(timed_fit("500 x 4 two widths", samples, 1, 1, derivatives, tolerance,
                               derivatives == Derivatives::lanes ? 7 : 1));
  return rows;
}

std::vector<FitSpeedRow> start_rows(const std::string& name, bool search) {
  constexpr int kSeeds = 24;
  const FitSamples samples = fit_samples({name, Metric::log, 500, 1, 0.05});
  const double least = solve_starts(samples.problem, 128, Derivatives::lanes, kSearch, 4000).best.cost;
  std::vector<FitSpeedRow> rows;
  for (const int starts : {1, 2, 4, 8, 16, 32}) {
    FitSpeedRow row{search ? "500 x 1 searched" : "500 x 1 solver alone", name};
    row.starts = starts, row.samples = samples.problem.points.size();
    double worst = 0;
    row.ms = INFINITY;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      ManyStarts found;
      row.ms = std::min(row.ms, least_ms(1, 1, [&] {
                          found = solve_starts(samples.problem, starts, Derivatives::lanes, kSearch, seed, search);
                        }));
      worst = std::max(worst, found.best.cost);
      row.missed += double(found.best.cost > 1.0201 * least) / kSeeds;
      row.agreeing += found.agreeing;
      row.rms = rms_of(samples.problem, found.best);
    }
    row.parameter_error = std::sqrt(std::max(worst / least, 1.0)) - 1;
    rows.push_back(row);
  }
  return rows;
}

std::vector<FitSamples> every_model_of(const FitSamples& samples) {
  std::vector<FitSamples> all;
  for (const ModelInfo& info : models())
    if (info.id != ModelId::mirror) all.push_back(with_model(samples, {info.id}));  // the mirror's lobe is a delta
  return all;
}

std::vector<FitSpeedRow> model_rows(const std::vector<FitSamples>& every) {
  std::vector<FitSpeedRow> rows;
  for (const FitSamples& samples : every)
    rows.push_back(timed_fit("20000", samples, kDefaultStarts, 1, Derivatives::lanes, kSearch, 1));
  return rows;
}

std::vector<FitBar> fit_bars(const std::vector<FitSpeedRow>& every_model,
                             const std::function<void(const std::string&)>& progress) {
  std::vector<FitBar> bars;
  const auto add = [&](FitBar bar, double bar_ms, double peer_ms, const std::string& peer, double per) {
    bar.bar_ms = bar_ms, bar.peer_ms = peer_ms, bar.peer = peer, bar.per = per;
    bars.push_back(bar);
    progress(bar.what);
  };
  const FitSamples large = fit_samples({"torrance-sparrow", Metric::log, 100000});
  FitBar one_start = one_model("100,000 samples, one lobe, 1 start", large, 1);
  one_start.whole_ms = whole_fit_ms(large, 1);
  add(one_start, 60, 500, "0.50 s", 1);
  FitBar sixteen = one_model("100,000 samples, one lobe, 16 starts", large, kDefaultStarts);
  sixteen.whole_ms = whole_fit_ms(large, kDefaultStarts);
  add(sixteen, 60, 500, "0.50 s", 1);

  const std::vector<FitSamples> every = every_model_of(fit_samples({"torrance-sparrow", Metric::log, 20000}));
  std::vector<FitSpeedRow> two;
  double whole = 0;
  for (const FitSamples& one : every) {
    two.push_back(timed_fit("20000", one, kDefaultStarts, 2, Derivatives::lanes, kSearch, 1));
    FitRequest request = one.request;
    whole += least_ms(1, 1, [&] { keep(fit(one.scan, request)); });
  }
  FitBar all{"20,000 samples, every model, 16 starts each", 0, 0, "", sum_of(every_model), sum_of(two), 1, whole};
  add(all, 2000, 28900, "28.9 s (four models)", 1);
  FitBar four = all;
  four.what = "20,000 samples, four models, 16 starts each", four.one.ms = four.two.ms = 0, four.whole_ms = NAN;
  for (std::size_t m = 0; m < every_model.size(); ++m)
    if (std::ranges::find(kFourModels, every_model[m].model) != kFourModels.end())
      four.one.ms += every_model[m].ms, four.two.ms += two[m].ms;
  add(four, 2000, 28900, "28.9 s (four models)", 1);

  const FitSamples small = fit_samples({"torrance-sparrow", Metric::log, 500, 16});
  FitBar start = one_model("500 x 16 wavelengths, shared kd and ks, a start", small, 8);
  start.whole_ms = whole_fit_ms(small, 8) / 8;
  add(start, 1.5, 89, "89 ms", 8);
  FitCase own{"torrance-sparrow", Metric::log, 500, 16};
  own.own_scales = true;
  add(one_model("500 x 16 wavelengths, kd and ks of each, a start", fit_samples(own), 8), 1.5, 89, "89 ms", 8);

  const FitSamples many = fit_samples({"torrance-sparrow", Metric::log, 2000, 16});
  FitBar starts = one_model("2,000 x 16 wavelengths, 32 starts", many, 32);
  starts.whole_ms = whole_fit_ms(many, 32);
  add(starts, 200, 0, "", 1);
  return bars;
}

}  // namespace gonio
