#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "assess/fit_speed_rows.h"
#include "base/files.h"
#include "fit/gnuplot.h"

namespace gonio {
namespace {

struct Style {
  Derivatives derivatives;
  const char* colour;
  int point;
  const char* label;  ///< where gnuplot puts it
};
constexpr std::array kStyles{Style{Derivatives::lanes, "#1b9e77", 7, "left offset 0.7,0"},
                             Style{Derivatives::jet, "#d95f02", 5, "right offset -0.7,0"},
                             Style{Derivatives::numeric, "#7570b3", 9, "left offset 0.7,0"}};

std::string csv_of(const std::vector<FitSpeedRow>& rows) {
  std::string csv =
      "size,model,metric,derivatives,starts,threads,tolerance,samples,ms,rms,largest_ln_parameter_error,"
      "starts_at_best,share_of_sets_that_miss\n";
  for (const FitSpeedRow& r : rows)
    csv += fmt::format("{},{},{},{},{},{},{:.0e},{},{:.4g},{:.6g},{:.3e},{},{:.3g}\n", r.size, r.model,
                       name_of(r.metric), name_of(r.derivatives), r.starts, r.threads, r.tolerance, r.samples, r.ms,
                       r.rms, r.parameter_error, r.agreeing, r.missed);
  return csv;
}

/// Rows of one model and kind of derivatives: ms, error, and a label.
std::string block_of(const std::vector<FitSpeedRow>& rows, const std::string& model, Derivatives derivatives,
                     const std::function<std::string(const FitSpeedRow&)>& label) {
  std::string data;
  for (const FitSpeedRow& r : rows)
    if (r.model == model && r.derivatives == derivatives)
      data += fmt::format("{:.4g} {:.4g} \"{}\"\n", r.ms, std::max(r.parameter_error, 1e-9), label(r));
  return data.empty() ? "NaN NaN \"\"\n" : data;
}

/// Panels side by side, one a model: error against time, a colour a kind of derivatives.
std::string panels_chart(const std::vector<FitSpeedRow>& rows, const std::vector<std::string>& names,
                         const std::string& title, const std::string& ylabel, bool lines,
                         const std::function<std::string(const FitSpeedRow&)>& label) {
  std::string script = fmt::format(
      "set multiplot layout 1,{} title '{}'\nset logscale xy\nset format y '10^{{%T}}'\nset grid lc rgb "
      "'#dddddd'\nset key bottom left samplen 1 font ',11'\nset xlabel 'ms a fit, one thread'\nset ylabel "
      "'{}'\nset offsets graph 0.06, graph 0.3, graph 0.15, graph 0.2\n",
      names.size(), title, ylabel);
  int block = 0;
  for (const std::string& name : names) {
    std::string plot;
    for (const Style& style : kStyles) {
      script += fmt::format("$b{} << EOD\n{}EOD\n", block, block_of(rows, name, style.derivatives, label));
      plot += fmt::format(
          "{0}$b{1} using 1:2 with {2} pt {3} lw 1.5 lc rgb '{4}' title '{5}', $b{1} using 1:2:3 with labels {6} "
          "font ',10' tc rgb '{4}' notitle",
          plot.empty() ? "" : ", ", block, lines ? "linespoints" : "points", style.point, style.colour,
          name_of(style.derivatives), style.label);
      ++block;
    }
    script += fmt::format("set title '{}'\nplot {}\n", gnuplot_text(name), plot);
  }
  return gnuplot_svg(script + "unset multiplot\n", 420 * static_cast<int>(names.size()), 520);
}

/// A panel a model: which share of the fits misses the least residual, against their time.
std::string starts_chart(const std::vector<FitSpeedRow>& rows, const std::vector<std::string>& names) {
  std::string script = fmt::format(
      "set multiplot layout 1,{}\nset logscale x\nset grid lc rgb '#dddddd'\nset key top right samplen 2 font "
      "',11'\nset xlabel 'ms a fit, one thread (numbers: starts)'\nset ylabel 'share of fits that miss the least "
      "residual'\nset yrange [-0.06:0.6]\nset offsets graph 0.1, graph 0.1, 0, 0\n",
      names.size());
  for (std::size_t n = 0; n < names.size(); ++n) {
    for (const bool searched : {true, false}) {
      script += fmt::format("${}{} << EOD\n", searched ? "s" : "a", n);
      for (const FitSpeedRow& r : rows)
        if (r.model == names[n] && r.size.ends_with("searched") == searched)
          script += fmt::format("{:.4g} {:.3f} {}\n", r.ms, r.missed, r.starts);
      script += "EOD\n";
    }
    script += fmt::format(
        "set title '{1}'\nplot $a{0} using 1:2 with linespoints pt 6 dt 2 lw 1.5 lc rgb '#d95f02' title 'solver "
        "alone', "
        "$a{0} using 1:2:3 with labels center offset 0,-0.9 font ',10' tc rgb '#d95f02' notitle, $s{0} using 1:2 with "
        "linespoints pt 7 lw 1.5 lc rgb '#1b9e77' title 'with the search', $s{0} using 1:2:3 with labels center offset "
        "0,0.9 font ',10' tc rgb '#1b9e77' notitle\n",
        n, gnuplot_text(names[n]));
  }
  return gnuplot_svg(script + "unset multiplot\n", 1260, 420);
}

std::string models_table(std::vector<FitSpeedRow> rows) {
  std::sort(rows.begin(), rows.end(), [](auto& a, auto& b) { return a.ms > b.ms; });
  std::string text = "| model | ms (16 starts) | rms of ln f | starts at the best minimum |\n|---|---|---|---|\n";
  for (const FitSpeedRow& r : rows)
    text += fmt::format("| {} | {:.3g} | {:.4g} | {} of {} |\n", r.model, r.ms, r.rms, r.agreeing, r.starts);
  return text;
}

std::string bars_chart(const std::vector<FitBar>& bars) {
  std::string data = "$m << EOD\n", tics;
  for (std::size_t b = 0; b < bars.size(); ++b) {
    const auto y = bars.size() - b;
    const auto shown = [](double ms) { return ms > 0 ? fmt::format("{:.4g}", ms) : std::string("NaN"); };
    data += fmt::format("{} {:.4g} {:.4g} {:.4g} {} {}\n", y, bars[b].one_ms(), bars[b].two_ms(), bars[b].bar_ms,
                        shown(bars[b].peer_ms), shown(bars[b].whole_ms));
    tics += fmt::format("{}\"{}\" {}", b == 0 ? "" : ", ", bars[b].what, y);
  }
  return gnuplot_svg(
      data +
          fmt::format("EOD\nset logscale x\nset grid lc rgb '#dddddd'\nset key outside top center horizontal samplen "
                      "1 width -2 font ',12'\nset ytics ({})\nset yrange [0.4:{}.6]\nset xlabel 'ms'\nplot $m using "
                      "4:1 with points pt 2 "
                      "ps 1.6 lw 2 lc rgb '#cc0000' title 'bar', $m using 2:1 with points pt 7 ps 1.2 lc rgb "
                      "'#1b9e77' title '1 thread', $m using 3:1 with points pt 6 ps 1.2 lw 2 lc rgb '#1b9e77' title "
                      "'2 threads', $m using 6:1 with points pt 4 ps 1.2 lc rgb '#7570b3' title 'whole "
                      "fit', $m using 5:1 with points pt 9 ps 1.3 lc rgb '#d95f02' title 'peer'\n",
                      tics, bars.size()),
      1050, 460);
}

std::string bars_csv(const std::vector<FitBar>& bars) {
  std::string csv =
      "what,bar_ms,peer_ms,one_thread_ms,two_threads_ms,whole_fit_one_thread_ms,rms,largest_ln_parameter_error\n";
  for (const FitBar& b : bars)
    csv += fmt::format("\"{}\",{},{},{:.4g},{:.4g},{:.4g},{:.4g},{:.3g}\n", b.what, b.bar_ms, b.peer_ms, b.one_ms(),
                       b.two_ms(), b.whole_ms, b.one.rms, b.one.parameter_error);
  return csv;
}

std::string number_or_dash(double x) { return std::isfinite(x) && x > 0 ? fmt::format("{:.3g}", x) : "-"; }

std::string bars_table(const std::vector<FitBar>& bars) {
  std::string text =
      "| samples | bar, ms | met | 1 thread, ms | 2 threads, ms | whole `gonio fit`, ms | peer | rms of residuals | "
      "largest error of a parameter |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const FitBar& b : bars) {
    const bool one = b.one_ms() < b.bar_ms, two = b.two_ms() < b.bar_ms;
    text += fmt::format("| {} | {} | {} | {:.3g} | {:.3g} | {} | {} | {} | {} |\n", b.what, b.bar_ms,
                        one   ? "yes"
                        : two ? "on 2 threads"
                              : "**no**",
                        b.one_ms(), b.two_ms(), number_or_dash(b.whole_ms), b.peer.empty() ? "-" : b.peer,
                        number_or_dash(b.one.rms), number_or_dash(b.one.parameter_error));
  }
  return text;
}

std::string metrics_table(const std::vector<FitSpeedRow>& rows) {
  std::string text =
      "| model | metric | derivatives | ms a start | rms of residuals | largest error of a parameter |\n"
      "|---|---|---|---|---|---|\n";
  for (const FitSpeedRow& r : rows)
    text += fmt::format("| {} | {} | {} | {:.3g} | {:.6g} | {:.2e} |\n", r.model, name_of(r.metric),
                        name_of(r.derivatives), r.ms, r.rms, r.parameter_error);
  return text;
}

std::string page(const std::vector<FitBar>& bars, const std::vector<FitSpeedRow>& metrics,
                 const std::vector<FitSpeedRow>& every) {
  return fmt::format(
             R"(# What a fit costs, and how near the truth it comes

Samples of a known surface (gold, 2 % noise of ln f) in memory; timed is the fit of them: points put into lanes, starts,
solves. The whole `gonio fit` with its preparation, uncertainty and verdict stands beside it. Figures of one thread are the
thread's own time, the least of several runs; those of two threads are the clock's, on a machine of {} processors ({} lanes)
that other work shared: where both were taken, two threads gain nothing, and every figure may be some tens of per cent too
large. The peer's times are quoted, not measured here. An error of a parameter is |ln(found/truth)|.

)",
             std::thread::hardware_concurrency(), DoubleLanes::arch_type::name()) +
         bars_table(bars) + R"(
The four models: lambert, torrance-sparrow, ggx, beckmann-kirchhoff (which four the peer's figure means is not known).

![bars](bars.svg)

Squares: the whole of `gonio fit`, 1 thread.

## Derivatives and metrics

500 directions × 16 wavelengths, kd and ks shared, one start, one thread. Ceres has one residual block a point and DENSE_QR;
its start is brought near the minimum by the same search in lanes, whose time is included. Where the residuals agree, what is
left of the parameters is the noise's doing, and the metric's: the noise is relative, as the logarithm takes it to be.

)" + metrics_table(metrics) +
         R"(
![metrics](metrics.svg)

## Accuracy against time

Samples (500 × 4) of a lobe with two widths, fitted with one: how far the parameters are from the minimum's when the solver
stops at a relative decrease of the cost of 1e-1 to 1e-12 (numbers: its exponent). The minimum is what lanes reach at 1e-16.

![tolerance](tolerance.svg)

## Starts

Share of fits whose residual (rms) exceeds by more than 1 % the least that 128 other starts found, over 24 sets of starts; 500
samples with 5 % noise, 1 to 32 starts. "Solver alone" leaves out the search on a grid that `gonio fit` puts before
every start.

![starts](starts.svg)

## Every model

20,000 samples of torrance-sparrow fitted with every model but the mirror, 16 starts, one thread. Starts at the best minimum:
of those on the 3,000 samples that decide. The time of all is nearly that of the one with the most parameters.

)" + models_table(every) +
         "\nEvery row: bars.csv, metrics.csv, tolerance.csv, starts.csv (the error column holds the worst excess of "
         "the residual), "
         "models.csv.\n";
}

}  // namespace

void write_fit_speed(const std::filesystem::path& folder, const std::function<void(const std::string&)>& progress) {
  make_folder(folder);
  progress("every model");
  const std::vector<FitSpeedRow> every =
      model_rows(every_model_of(fit_samples({"torrance-sparrow", Metric::log, 20000})));
  const std::vector<FitBar> bars = fit_bars(every, progress);
  progress("derivatives and metrics");
  const std::vector<FitSpeedRow> metrics = metric_rows();
  const std::vector<std::string> compared{"torrance-sparrow", "ggx", "beckmann-kirchhoff"};
  const std::vector<std::string> several{"torrance-sparrow", "beckmann-kirchhoff", "cook-torrance-1981-two-widths"};
  std::vector<FitSpeedRow> tolerances, starts;
  const auto add = [](std::vector<FitSpeedRow>& to, const std::vector<FitSpeedRow>& rows) {
    to.insert(to.end(), rows.begin(), rows.end());
  };
  progress("tolerances");
  for (const std::string& name : compared) add(tolerances, tolerance_rows(name));
  progress("starts");
  for (const std::string& name : several)
    for (const bool search : {true, false}) add(starts, start_rows(name, search));
  write_file(folder / "bars.csv", bars_csv(bars));
  write_file(folder / "metrics.csv", csv_of(metrics));
  write_file(folder / "tolerance.csv", csv_of(tolerances));
  write_file(folder / "starts.csv", csv_of(starts));
  write_file(folder / "models.csv", csv_of(every));
  write_file(folder / "bars.svg", bars_chart(bars));
  write_file(folder / "metrics.svg",
             panels_chart(metrics, compared, "500 x 16 samples, 2 % noise: one start", "largest error of a parameter",
                          false, [](const FitSpeedRow& r) {
                            return std::string(r.derivatives == Derivatives::lanes ? name_of(r.metric) : "");
                          }));
  write_file(folder / "tolerance.svg",
             panels_chart(tolerances, compared, "Distance from the minimum at the tolerance the solver stops at",
                          "largest |ln(parameter/at the minimum)|", true,
                          [](const FitSpeedRow& r) { return fmt::format("{:.0f}", std::log10(r.tolerance)); }));
  write_file(folder / "starts.svg", starts_chart(starts, several));
  write_file(folder / "README.md", page(bars, metrics, every));
}

}  // namespace gonio
