#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "assess/table_speed.h"
#include "base/files.h"
#include "fit/gnuplot.h"
#include "materials/surfaces.h"

namespace gonio {
namespace {

using Rows = std::vector<TableSpeedRow>;

struct Series {
  const char *way, *colour;
  int point;
};
constexpr Series kWays[]{{"table, cubic", "#1b9e77", 7},
                         {"table, Catmull-Rom", "#7570b3", 9},
                         {"table, linear", "#d95f02", 5},
                         {"table of one width, cubic", "#1b9e77", 6},
                         {"table of every material, cubic", "#1b9e77", 4},
                         {"quadrature of E", "#e7298a", 13},
                         {"quadrature of the lobe", "#666666", 11},
                         {"sampling", "#377eb8", 3}};
constexpr Series kRendererWays[]{{"gonio", "#1b9e77", 7},
                                 {"bilinear, even in the root of alpha", "#e6ab02", 9},
                                 {"bilinear, even in alpha", "#d95f02", 5}};

struct Axis {
  const char* label;
  double TableSpeedRow::*of;
  const char* range;  ///< gnuplot's, of x and y
};
constexpr Axis kTime{
    "ns a value, one thread", &TableSpeedRow::ns,
    "set format x '10^{%T}'\nset xrange [1:1e9]\nset xtics 100\nset yrange [1e-10:1]\nset ytics 100\n"},
    kSize{"KiB of one surface", &TableSpeedRow::kib,
          "set xrange [0.7:64]\nset xtics (1, 2, 4, 8, 16, 32, 64)\nset yrange [1e-6:1]\n"};

/// A panel a family, side by side: largest error against time or size; rows that keep no numbers have no size.
std::string chart(const Rows& rows, const std::vector<std::string_view>& families, std::span<const Series> ways,
                  const Axis& axis, const std::string& title, int height) {
  std::string script = fmt::format(
      "set multiplot layout 1,{} title '{}' margins 0.075,0.985,0.31,0.86 spacing 0.05\nset logscale xy\nset format y "
      "'10^{{%T}}'\nset grid lc rgb '#dddddd'\nset xlabel '{}'\n{}unset key\n",
      families.size(), title, axis.label, axis.range);
  int block = 0;
  for (std::size_t f = 0; f < families.size(); ++f) {
    std::string plot;
    for (const Series& one : ways) {
      std::string data;
      for (const TableSpeedRow& r : rows)
        if (r.family == families[f] && r.way == one.way && r.*axis.of > 0)
          data += fmt::format("{:.4g} {:.4g}\n", r.*axis.of, std::max(r.error.largest, 1e-10));
      if (data.empty()) continue;
      script += fmt::format("$b{} << EOD\n{}EOD\n", block, data);
      plot += fmt::format("{}$b{} using 1:2 with linespoints pt {} ps 0.9 lw 1.5 lc rgb '{}' title '{}'",
                          plot.empty() ? "" : ", ", block++, one.point, one.colour, one.way);
    }
    // One legend below all panels, written by the middle one.
    if (f == families.size() / 2)
      script += "set key at screen 0.5, screen 0.04 center bottom maxrows 3 samplen 2 width 1 font ',11'\n";
    script += fmt::format("set ylabel '{}'\nset title '{}'\nplot {}\nunset key\n", f == 0 ? "largest error of E" : "",
                          gnuplot_text(std::string(families[f])), plot);
  }
  return gnuplot_svg(script + "unset multiplot\n", 400 * static_cast<int>(families.size()), height);
}

std::string csv_of(const Rows& rows) {
  std::string csv = "family,way,setting,kib,ns_a_value,largest_error,median_error,worst_theta_deg,worst_alpha\n";
  for (const TableSpeedRow& r : rows)
    csv += fmt::format("{},\"{}\",{},{:.4g},{:.4g},{:.2e},{:.2e},{:.4f},{:.4g}\n", r.family, r.way, r.setting, r.kib,
                       r.ns, r.error.largest, r.error.median, r.worst.theta_deg(), r.worst.alpha);
  return csv;
}

std::string csv_of(const std::vector<NodeCountRow>& rows) {
  std::string csv = "cosines,surfaces,beyond_2e-5,largest_error,p99_error,median_error,kib\n";
  for (const NodeCountRow& r : rows)
    csv += fmt::format("{},{},{},{:.2e},{:.2e},{:.2e},{:.4g}\n", r.nodes, r.surfaces, r.beyond, r.largest, r.p99,
                       r.median, r.kib);
  return csv;
}

const TableSpeedRow* row_of(const Rows& rows, std::string_view family, std::string_view way, std::string_view setting) {
  for (const TableSpeedRow& r : rows)
    if (r.family == family && r.way == way && r.setting == setting) return &r;
  return nullptr;
}

/// One line a way and setting: size and time of the first family, the largest errors of all.
std::string table_of(const Rows& rows, const std::vector<std::string_view>& families) {
  std::string text = "| way | setting | KiB | ns a value |", line = "|---|---|---|---|";
  for (const std::string_view family : families) text += fmt::format(" {} |", family), line += "---|";
  text += "\n" + line + "\n";
  for (const TableSpeedRow& first : rows) {
    if (first.family != families.front()) continue;
    const std::string kib = first.kib > 0 ? fmt::format("{:.3g}", first.kib) : "-";
    const std::string ns = first.ns < 1e4 ? fmt::format("{:.2g}", first.ns) : fmt::format("{:.1e}", first.ns);
    text += fmt::format("| {} | {} | {} | {} |", first.way, first.setting, kib, ns);
    for (const std::string_view family : families) {
      const TableSpeedRow* r = row_of(rows, family, first.way, first.setting);
      text += r ? fmt::format(" {:.1e} |", r->error.largest) : " |";
    }
    text += "\n";
  }
  return text;
}

std::string table_of(const std::vector<NodeCountRow>& rows) {
  std::string text =
      "| cosines | surfaces beyond 2e-5 | share | 99 % below | median | table of every material, KiB "
      "|\n|---|---|---|---|---|---|\n";
  for (const NodeCountRow& r : rows)
    text += fmt::format("| {} | {} of {} | {:.3g} % | {:.1e} | {:.1e} | {:.0f} |\n", r.nodes, r.beyond, r.surfaces,
                        100 * static_cast<double>(r.beyond) / static_cast<double>(std::max<std::size_t>(r.surfaces, 1)),
                        r.p99, r.median, r.kib);
  return text;
}

/// The row with the largest error of all families; nullptr where the run holds none.
const TableSpeedRow* worst_of(const Rows& rows, std::string_view way, std::string_view setting) {
  const TableSpeedRow* worst = nullptr;
  for (const TableSpeedRow& r : rows)
    if (r.way == way && r.setting == setting && (!worst || r.error.largest > worst->error.largest)) worst = &r;
  return worst;
}

std::string setting_of(const EnergyGrid& grid) { return fmt::format("{} x {}", grid.rows, grid.columns); }

/// What the numbers say, where the run holds them all.
std::string summary(const Rows& rows) {
  const std::string setting = setting_of({});
  const auto cubic = worst_of(rows, "table, cubic", setting), linear = worst_of(rows, "table, linear", setting),
             catmull = worst_of(rows, "table, Catmull-Rom", setting),
             slopes = worst_of(rows, "quadrature of E", "1e-06"), sampling = worst_of(rows, "sampling", "1e+05");
  if (!cubic || !slopes || !sampling) return "";
  const double error = cubic->error.largest;
  return fmt::format(
      "The default grid ({}) with Lagrange's cubic errs by at most {:.1e} in {:.2g} ns. Between the same numbers "
      "Catmull-Rom errs\n"
      "{:.1f} times as much and linear {:.0f} times. The quadrature of E is right to {:.0e} and takes {:.0f} µs a "
      "value; 1e5 directions that\n"
      "the lobe's own sampler draws take {:.0f} ms and still err by {:.0e}.\n\n",
      setting, error, cubic->ns, catmull->error.largest / error, linear->error.largest / error, slopes->error.largest,
      slopes->ns * 1e-3, sampling->ns * 1e-6, sampling->error.largest);
}

std::string renderer_summary(const Rows& rows) {
  const auto ours = worst_of(rows, "gonio", "24 x 28"), even = worst_of(rows, "bilinear, even in alpha", "32 x 32"),
             root = worst_of(rows, "bilinear, even in the root of alpha", "32 x 32");
  if (!ours || !even || !root) return "";
  return fmt::format(
      "With 1024 numbers they err by up to {:.1e} (even in alpha; at {:.2f}°, median {:.1e}) and {:.1e} (in its root; "
      "at {:.2f}°, median\n"
      "{:.1e}), in {:.2g} ns: next to grazing E turns within their first cell. 672 numbers placed as here and looked "
      "up by cubics err by\n"
      "{:.1e} (median {:.1e}) in {:.2g} ns.\n\n",
      even->error.largest, even->worst.theta_deg(), even->error.median, root->error.largest, root->worst.theta_deg(),
      root->error.median, root->ns, ours->error.largest, ours->error.median, ours->ns);
}

std::string page(const Rows& rows, const Rows& white, const std::vector<NodeCountRow>& nodes,
                 const TableSpeedOptions& o) {
  std::string text = fmt::format(R"(# What a table of E costs, and how wrong it is

Directional reflectance of one surface. Tables are judged at {} random places (even in θ, in cos θ and in ln cos θ; even in ln alpha
from 0.01), the quadratures at {} of them, sampling at {}; the error of a place is the worst of {} surfaces from water to silver (sampling:
of one of them, four seeds), against the measure of the lobe to 1e-7. KiB: of the numbers kept for one surface (a table of every material:
for all). Times are those of one thread of a machine of {} processors ({} lanes) that other work shared, the least of several, for many
values at once in tables and for one at a time elsewhere.

)",
                                 o.places, o.integrated, o.sampled, common_surfaces().size(),
                                 std::thread::hardware_concurrency(), FloatLanes::arch_type::name());
  text += summary(rows) + table_of(rows, o.families) + R"(
The last columns: largest error of E. Size and time are the first family's; each family's, medians and worst places: ways.csv.

![error against time](time.svg)

![error against size](size.svg)

## Tables as renderers make them

White facets, alpha up to 1, even in cos θ and in alpha or its root, bilinear: what the usual compensation for lost energy looks up. For
coloured facets renderers scale it by a mean reflectance, an error that comes on top.

)";
  text += renderer_summary(white) + table_of(white, o.families) +
          fmt::format(R"(
![tables of renderers](white.svg)

## How many cosines

A table of every material keeps weights of R at fixed cosines. Largest error of R between them, of the database's solids and liquids,
every {:g} nm between 280 and 1100 nm; E errs by no more than about that. What lies beyond 2e-5 is integrated instead.

)",
                      o.database_step_nm);
  return text + table_of(nodes);
}

void add(Rows& to, Rows rows) { to.insert(to.end(), rows.begin(), rows.end()); }

}  // namespace

void write_table_speed(const std::filesystem::path& folder, const std::function<void(const std::string&)>& progress,
                       const TableSpeedOptions& options) {
  make_folder(folder);
  Rows rows, white;
  for (const std::string_view name : options.families) {
    progress(std::string(name));
    const JudgedPlaces judged(lobe_family(name), options.places);
    add(white, renderer_rows(judged, options.renderer_sides));
    Rows others;
    for (EnergyGrid grid : options.grids) {
      grid.widest = judged.family->widest;
      const EnergyTable table(*judged.family, grid);
      add(rows, grid_rows(table, judged));
      white.push_back(white_row(table, judged));
      if (grid.columns == EnergyGrid{}.columns) others = other_table_rows(table, judged);
    }
    add(rows, others), add(rows, quadrature_rows(judged, options.integrated)),
        add(rows, sampling_rows(judged, options.sampled));
  }
  std::stable_sort(rows.begin(), rows.end(), [](auto& a, auto& b) {
    const auto place = [](const TableSpeedRow& r) {
      return std::find_if(std::begin(kWays), std::end(kWays), [&](const Series& s) { return s.way == r.way; });
    };
    return place(a) < place(b);
  });
  progress("fixed cosines");
  std::vector<Interface<double>> surfaces;
  for (const NamedSurface& one : database_surfaces(options.database_step_nm)) surfaces.push_back(one.interface);
  std::vector<NodeCountRow> nodes;
  for (const std::size_t count : {8, 12, 16, 20, 24}) nodes.push_back(node_count_row(count, surfaces));
  write_file(folder / "ways.csv", csv_of(rows));
  write_file(folder / "white.csv", csv_of(white));
  write_file(folder / "cosines.csv", csv_of(nodes));
  Rows tables;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(tables),
               [](auto& r) { return r.way.starts_with("table, "); });
  write_file(folder / "time.svg", chart(rows, options.families, kWays, kTime, "Largest error of E against time", 560));
  write_file(folder / "size.svg", chart(tables, options.families, kWays, kSize,
                                        "Largest error of E against the size of one surface''s table", 560));
  write_file(folder / "white.svg", chart(white, options.families, kRendererWays, kSize,
                                         "White facets, alpha up to 1: largest error of E against size", 560));
  write_file(folder / "README.md", page(rows, white, nodes, options));
}

}  // namespace gonio
