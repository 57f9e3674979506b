#include "assess/brdf_speed_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assess/brdf_speed_cases.h"
#include "base/files.h"
#include "fit/gnuplot.h"

namespace gonio {
namespace {

struct Style {
  const char *path, *colour;
  int point;
  bool named;  ///< variants are written beside the lanes' points; one number at a time they err alike
};
constexpr Style kStyles[] = {{"float lanes", "#d95f02", 7, true},
                             {"double lanes", "#1b9e77", 5, true},
                             {"float", "#e6ab02", 6, false},
                             {"double", "#7570b3", 4, false}};
constexpr double kPoor = 1e-3;

std::string csv_of(const std::vector<SpeedRow>& rows) {
  std::string csv =
      "model,shadowing,variant,path,ns,largest_relative_error,percentile_999,mean,judged_against,delta_e_2000_mean,"
      "delta_e_2000_largest\n";
  for (const SpeedRow& r : rows)
    csv += fmt::format("{},{},{},{},{:.4g},{:.3e},{:.3e},{:.3e},{} in 50 digits,{:.3g},{:.3g}\n", r.spec.info().name,
                       r.spec.info().shadowings.empty() ? "" : name_of(r.spec.shadowing), r.spec.variant(), r.path,
                       r.ns, r.largest, r.percentile_999, r.mean, exact_form(r.spec).variant(), r.visible.mean,
                       r.visible.largest);
  return csv;
}

double shown(double error) { return std::clamp(error, 1e-17, 10.0); }

/// Error against cost of one model's variants on the four paths, the Pareto front as a line.
std::string pareto_chart(const std::vector<SpeedRow>& all, ModelId id, const std::string& title) {
  std::vector<SpeedRow> rows;
  std::copy_if(all.begin(), all.end(), std::back_inserter(rows), [&](const SpeedRow& r) { return r.spec.id == id; });
  std::string data = "$front << EOD\n",
              plot = "$front using 1:2 with steps lc rgb '#999999' lw 2 title 'nothing is both faster and better'";
  for (const SpeedRow& r : pareto_front(rows)) data += fmt::format("{:.4g} {:.3e}\n", r.ns, shown(r.largest));
  data += "EOD\n";
  int block = 0;
  for (const Style& style : kStyles) {
    std::string points, good, poor;  // names of what is right, and, aslant, of what is wrong by a part or more
    for (const SpeedRow& r : rows) {
      if (r.path != style.path) continue;
      const std::string row = fmt::format("{:.4g} {:.3e} \"{}\"\n", r.ns, shown(r.largest), r.spec.variant());
      points += row;
      (r.largest < kPoor ? good : poor) += row;
    }
    const std::string nothing = "NaN NaN \"\"\n";
    data += fmt::format("$p{0} << EOD\n{1}EOD\n$g{0} << EOD\n{2}EOD\n$w{0} << EOD\n{3}EOD\n", block, points,
                        good.empty() ? nothing : good, poor.empty() ? nothing : poor);
    plot += fmt::format(", $p{} using 1:2 with points pt {} ps 1.1 lc rgb '{}' title '{}'", block, style.point,
                        style.colour, style.path);
    if (style.named)
      plot += fmt::format(
          ", $g{0} using 1:2:3 with labels left offset 0.6,0.3 font ',10' tc rgb '{1}' notitle, $w{0} using 1:2:3 with "
          "labels left rotate by -50 offset 0.2,-0.7 font ',10' tc rgb '{1}' notitle",
          block, style.colour);
    ++block;
  }
  return gnuplot_svg(data + fmt::format("set title '{}'\nset logscale xy\nset format y '10^{{%T}}'\nset grid lc rgb "
                                        "'#dddddd'\nset key outside top center "
                                        "horizontal\nset xlabel 'ns an evaluation, one thread'\nset ylabel 'largest "
                                        "relative error against the exact form in "
                                        "50 digits'\nset yrange [1e-17:30]\nset xrange [*:*] writeback\nset offsets "
                                        "graph 0, graph 0.12, 0, 0\nplot {}\n",
                                        gnuplot_text(title), plot),
                     1100, 640);
}

/// ns of each model's default, a row each.
std::string models_chart(const std::vector<SpeedRow>& rows) {
  std::vector<std::string> names;
  for (const SpeedRow& r : rows)
    if (r.spec.form == 0 && r.path == "float lanes") names.emplace_back(r.spec.info().name);
  std::string data, tics, plot;
  for (std::size_t n = 0; n < names.size(); ++n)
    tics += fmt::format("{}\"{}\" {}", n == 0 ? "" : ", ", names[n], names.size() - n);
  int block = 0;
  for (const Style& style : kStyles) {
    data += fmt::format("$p{} << EOD\n", block);
    for (const SpeedRow& r : rows)
      if (r.spec.form == 0 && r.path == style.path) {
        const auto at = std::find(names.begin(), names.end(), r.spec.info().name);
        data += fmt::format("{:.4g} {}\n", r.ns, names.size() - static_cast<std::size_t>(at - names.begin()));
      }
    data += "EOD\n";
    plot += fmt::format("{}$p{} using 1:2 with points pt {} ps 1.1 lc rgb '{}' title '{}'", block == 0 ? "" : ", ",
                        block, style.point, style.colour, style.path);
    ++block;
  }
  return gnuplot_svg(
      data + fmt::format("set logscale x\nset grid lc rgb '#dddddd'\nset key outside top center samplen 1 font ',12' "
                         "horizontal\nset ytics ({}) font ',11'\nset "
                         "yrange [0.3:{}.7]\nset xlabel 'ns an evaluation, one thread'\nplot {}\n",
                         tics, names.size(), plot),
      900, 140 + 22 * static_cast<int>(names.size()));
}

std::string diffraction_chart(const std::vector<DiffractionCost>& costs, const FacetedCosts& c) {
  std::string data = "$d << EOD\n";
  for (const DiffractionCost& d : costs)
    data += fmt::format("{:.3g} {:.4g} {:.4g}\n", d.g, d.float_lanes / c.float_lanes, d.double_lanes / c.double_lanes);
  return gnuplot_svg(data +
                         "EOD\nset logscale x\nset format x '10^{%T}'\nset grid lc rgb '#dddddd'\nset key top "
                         "right\nset yrange [0:*]\nset xlabel "
                         "'g at the normal'\nset ylabel 'cost / cost of torrance-sparrow'\nplot $d using 1:2 with "
                         "linespoints pt 7 lc rgb '#d95f02' "
                         "title 'float lanes', 4 lc rgb '#d95f02' dt 2 title 'aim 4', $d using 1:3 with linespoints pt "
                         "5 lc rgb '#1b9e77' title "
                         "'double lanes', 8 lc rgb '#1b9e77' dt 2 title 'aim 8'\n",
                     800, 460);
}

std::string csv_of(const std::vector<DiffractionCost>& costs, const FacetedCosts& c) {
  std::string csv =
      "g,float_lanes_ns,double_lanes_ns,float_lanes_over_torrance_sparrow,double_lanes_over_torrance_sparrow\n";
  for (const DiffractionCost& d : costs)
    csv += fmt::format("{:.3g},{:.4g},{:.4g},{:.3g},{:.3g}\n", d.g, d.float_lanes, d.double_lanes,
                       d.float_lanes / c.float_lanes, d.double_lanes / c.double_lanes);
  return csv;
}

struct Aim {
  const char *what, *aim;
  double value;
};

std::string ratios_table(const FacetedCosts& c, const std::vector<DiffractionCost>& diffraction,
                         const std::vector<SpeedRow>& rows) {
  double worst_float = 0, worst_double = 0, he_lanes = 0;
  for (const DiffractionCost& d : diffraction)
    worst_float = std::max(worst_float, d.float_lanes / c.float_lanes),
    worst_double = std::max(worst_double, d.double_lanes / c.double_lanes);
  for (const SpeedRow& r : rows)
    if (r.spec.id == ModelId::he_1991 && r.spec.form == 0 && r.path == "float lanes") he_lanes = r.ns;
  const Aim ratios[] = {
      {"torrance-sparrow, double lanes, times as fast as the plain loop", "at least 12", c.plain / c.double_lanes},
      {"torrance-sparrow, float lanes, times as fast as the plain loop", "at least 32", c.plain / c.float_lanes},
      {"value and 3 derivatives, double lanes, times as fast as ceres::Jet", "at least 10", c.jet / c.dual_lanes},
      {"16 wavelengths of one pair (lanes of double) over one wavelength of it", "at most 3",
       c.one_pair_16 / c.one_pair},
      {"16 wavelengths of one pair (lanes of float) over one wavelength of it", "at most 3",
       c.one_pair_16f / c.one_pair},
      {"16 wavelengths over one, pairs in double lanes", "", c.lanes_16 / c.double_lanes},
      {"16 wavelengths over one, pairs in float lanes", "", c.float_lanes_16 / c.float_lanes},
      {"beckmann-kirchhoff over torrance-sparrow, float lanes, worst g", "at most 4", worst_float},
      {"beckmann-kirchhoff over torrance-sparrow, double lanes, worst g", "at most 8", worst_double},
      {"he-1991, float lanes, ns (published programs 400 to 800)", "at most 20 to 40", he_lanes}};
  std::string text = "| ratio | aim (AVX-512; half of it with AVX2) | measured |\n|---|---|---|\n";
  for (const Aim& r : ratios) text += fmt::format("| {} | {} | {:.3g} |\n", r.what, r.aim, r.value);
  const OperationCount& o = c.operations;
  text += fmt::format(
      "\nThe plain loop takes {:.1f} ns ({:.1f} million a second); torrance-sparrow {:.2f} ns in double lanes, {:.2f} "
      "in float lanes. One evaluation, "
      "counted by a number\ntype that counts: {} additions, {} multiplications, {} fused, {} divisions, {} roots, {} "
      "choices, {} exponential (what does not depend "
      "on the pair included, about 15).\nCeiling measured beside it: {:.1f} fused multiply-adds a ns in double lanes, "
      "{:.1f} in float lanes; the "
      "multiplier's share alone ({} and {} slots) would take {:.2f} and {:.2f} ns.\n",
      c.plain, 1e3 / c.plain, c.double_lanes, c.float_lanes, o.add, o.multiply, o.fused, o.divide, o.root, o.choose,
      o.exponential, c.fma_per_ns_double, c.fma_per_ns_float, o.multiplier_slots(false), o.multiplier_slots(true),
      o.multiplier_slots(false) / c.fma_per_ns_double, o.multiplier_slots(true) / c.fma_per_ns_float);
  return text;
}

std::string schlick_text(const std::vector<SpeedRow>& rows) {
  const SchlickClaim s = schlick_claim();
  std::string text = fmt::format(
      "## Schlick's claims\n\nMaillot's thesis quotes Schlick 1992: his rational D for Beckmann's has a mean error of "
      "1.8 % and is 29 times as fast. Measured over "
      "alpha 0.05 to 0.7 and all angles:\n\n| | claimed | measured |\n|---|---|---|\n| mean error, share of the peak | "
      "1.8 % | {:.2f} % |\n| standard deviation of it | "
      "not given | {:.2f} % |\n| largest | not given | {:.1f} % |\n| mean relative error where D > 1e-3 of its peak | "
      "not given | {:.0f} % |\n| largest relative error "
      "there | not given | {:.0f} % |\n| share of these angles where it is 0 | not given | {:.0f} % |\n| times as "
      "fast, scalar double | 29 | {:.1f} |\n| times as fast, "
      "float lanes | | {:.1f} |\n\nThe mean hides the rest: on a gold sphere (m = {:.2f}) the eye sees\n\n| variant | "
      "mean ΔE_2000 | largest |\n|---|---|---|\n",
      100 * s.mean, 100 * s.deviation, 100 * s.largest, 100 * s.relative_mean, 100 * s.relative_largest,
      100 * s.share_of_zeros, s.speed_scalar, s.speed_lanes, middle_values(model("torrance-sparrow"))[0]);
  for (const SpeedRow& r : rows)
    if (r.spec.id == ModelId::torrance_sparrow && r.path == "double" && r.spec.form != 0)
      text += fmt::format("| {} | {:.2g} | {:.2g} |\n", r.spec.variant(), r.visible.mean, r.visible.largest);
  return text;
}

std::string page(const FacetedCosts& c, const std::vector<DiffractionCost>& diffraction,
                 const std::vector<SpeedRow>& rows) {
  return fmt::format(
             "# What an evaluation costs, and what it loses\n\nOne thread, {} lanes; the least time of several runs "
             "over 512 pairs of directions held near the core, the "
             "reduction of the unit vectors\nincluded. Errors are the largest relative ones over the box that the fit "
             "searches, against 50 digits at the numbers received, "
             "where f exceeds\n1e-6 of its peak (float) or 1e-290 (double). Another machine has other times; ratios "
             "and errors carry over better.\n\n",
             DoubleLanes::arch_type::name()) +
         ratios_table(c, diffraction, rows) +
         "\nThe diffraction series costs most where the index of its largest term is below 12 (float) or 26 (double): "
         "up to 30 or "
         "64 terms; above, one\n"
         "estimate and its correction. Lanes that need terms are put side by side before they are summed: "
         "diffraction.svg.\n\n"
         "![Variants of "
         "torrance-sparrow](faceted.svg)\n\n![Variants of beckmann-kirchhoff](kirchhoff.svg)\n\n"
         "Variants that cut the series (10, 40 terms), its limits and the Gauss rule are right somewhere and wrong by "
         "any factor elsewhere: their largest error over "
         "the box\nis what the chart shows (cut at 10). `gonio assess stability brdf` maps "
         "where.\n\n![Beckmann-Kirchhoff over g](diffraction.svg)\n\n![Every model](models.svg)\n\n" +
         schlick_text(rows) + "\nEvery row: costs.csv; diffraction.csv.\n";
}

}  // namespace

void write_brdf_speed(const std::filesystem::path& folder, const std::function<void(const std::string&)>& progress) {
  make_folder(folder);
  progress("ratios");
  const FacetedCosts c = faceted_costs();
  const std::vector<DiffractionCost> diffraction = diffraction_costs();
  const std::vector<SpeedRow> rows = speed_rows(progress);
  write_file(folder / "costs.csv", csv_of(rows));
  write_file(folder / "diffraction.csv", csv_of(diffraction, c));
  write_file(folder / "faceted.svg",
             pareto_chart(rows, ModelId::torrance_sparrow, "Torrance-Sparrow: variants of F, D, G on four paths"));
  write_file(folder / "kirchhoff.svg", pareto_chart(rows, ModelId::beckmann_kirchhoff,
                                                    "Beckmann-Kirchhoff: ways to sum the series on four paths"));
  write_file(folder / "diffraction.svg", diffraction_chart(diffraction, c));
  write_file(folder / "models.svg", models_chart(rows));
  write_file(folder / "README.md", page(c, diffraction, rows));
}

}  // namespace gonio
