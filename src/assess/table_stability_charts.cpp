#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "assess/map_outline.h"
#include "assess/table_stability.h"
#include "base/error.h"
#include "base/files.h"
#include "energy/energy_tables.h"
#include "fit/gnuplot.h"

namespace gonio {
namespace {

constexpr double kLeast = 1e-8;  // smaller errors are the floats that tables keep

double shown(double error) { return std::max(error, kLeast); }

/// 0 at the normal, 1 at grazing: the columns' own coordinate, upside down.
double height_of(const EnergyGrid& grid, double cos_theta) {
  return 1 - grid.column_of(cos_theta) / static_cast<double>(grid.columns - 1);
}

std::string angle_tics(const EnergyGrid& grid) {
  std::string tics;
  for (const double theta : {0.0, 30.0, 60.0, 80.0, 88.0, 89.5, 89.9, 89.99})
    tics += fmt::format("{}\"{:g}\" {:.4f}", tics.empty() ? "" : ", ", theta, height_of(grid, cos_deg(theta)));
  return tics;
}

std::string map_panel(const TableMap& map, std::size_t number) {
  const EnergyGrid& grid = map.table->grid();
  const double half_x = 0.5 / static_cast<double>(map.rows), half_y = 0.5 / static_cast<double>(map.columns);
  const double lo = std::log10(kNarrowestAlpha), hi = std::log10(grid.widest), span = hi - lo;
  const MapAxis x{"", lo + half_x * span, hi - half_x * span}, y{"", half_y, 1 - half_y};
  const auto cell = [&](std::size_t at) -> const WorstOfSurfaces& {  // row by row of the picture: y upwards, x along
    const std::size_t column = map.columns - 1 - at / map.rows, row = at % map.rows;
    return map.cells[row * map.columns + column];
  };
  std::string script = fmt::format("$m{} << EOD\n", number);
  for (std::size_t at = 0; at < map.cells.size(); ++at)
    script += fmt::format("{:.5g} {:.5g} {:.2f}\n", std::log10(cell(at).place.alpha),
                          height_of(grid, cell(at).place.cos_theta), std::log10(shown(cell(at).error)));
  script += fmt::format(
      "EOD\n$o{} << EOD\n{}EOD\n", number,
      map_outline(map.rows, map.columns, x, y, [&](std::size_t at) { return cell(at).error > EnergyTable::kError; }));
  return script + fmt::format(
                      "set title '{0}'\nset xrange [{2}:{3}]\nset ytics ({4})\nplot $m{1} using 1:2:3 with image, "
                      "$o{1} using 1:2:3:4 "
                      "with vectors nohead lw 1.5 lc rgb '#000000'\n",
                      gnuplot_text(std::string(map.table->family().name)), number, lo, hi, angle_tics(grid));
}

std::string maps_chart(const std::vector<TableMap>& maps) {
  const std::size_t across = std::min<std::size_t>(3, maps.size()), down = (maps.size() + across - 1) / across;
  std::string script = fmt::format(
      "set multiplot layout {},{} title 'Largest error of E, common logarithm (outlined: beyond 1e-4)'\nunset key\n"
      "set palette defined (-8 '#f7fbff', -6.5 '#9ecae1', -5.5 '#4292c6', -4.9 '#fee391', -4.4 '#fe9929', -4 "
      "'#cc4c02')\n"
      "set cbrange [-8:-4]\nset yrange [0:1]\nset xlabel 'alpha' offset 0,0.4\nset ylabel 'incidence, degrees' offset "
      "1,0\n"
      "set tics out nomirror\nset xtics ('0.01' -2, '0.03' -1.523, '0.1' -1, '0.3' -0.523, '1' 0, '2.8' 0.452)\n",
      down, across);
  for (std::size_t m = 0; m < maps.size(); ++m) script += map_panel(maps[m], m);
  return gnuplot_svg(script + "unset multiplot\n", 400 * static_cast<int>(across), 330 * static_cast<int>(down) + 30);
}

constexpr std::array kColours{"#1b9e77", "#d95f02", "#7570b3", "#e7298a", "#66a61e",
                              "#e6ab02", "#a6761d", "#666666", "#377eb8", "#000000"};

using BeyondOf = std::vector<std::vector<BeyondBox>>;

/// Left: below the first row; right: above the last.
std::string beyond_chart(const std::vector<TableMap>& maps, const BeyondOf& beyond) {
  std::string script =
      "set multiplot layout 1,2 title 'Error of E where a table gives its first or last row' margins "
      "0.08,0.985,0.33,0.88 spacing "
      "0.09\nset logscale xy\nset format y '10^{%T}'\nset grid lc rgb '#dddddd'\nset yrange [1e-6:1]\nset xlabel "
      "'alpha'\nset ylabel "
      "'largest error'\nunset key\n";
  std::string plot[2];
  for (std::size_t f = 0; f < beyond.size(); ++f)
    for (const int above : {0, 1}) {
      script += fmt::format("$b{}_{} << EOD\n", f, above);
      const std::size_t half = beyond[f].size() / 2;
      for (std::size_t i = above * half; i < (above + 1) * half; ++i)
        script += fmt::format("{:.4g} {:.3g}\n", beyond[f][i].alpha, shown(beyond[f][i].error));
      script += "EOD\n";
      plot[above] += fmt::format("{}$b{}_{} using 1:2 with linespoints pt {} ps 0.8 lw 1.5 lc rgb '{}' title '{}'",
                                 f == 0 ? "" : ", ", f, above, f + 1, kColours[f % kColours.size()],
                                 gnuplot_text(std::string(maps[f].table->family().name)));
    }
  script += "set xrange [0.00095:0.0105]\nset xtics (0.001, 0.002, 0.005, 0.01)\nplot " + plot[0] + "\n";
  script +=
      "set xrange [1.3:10.5]\nset xtics (1.5, 2, 3, 5, 10)\nset ylabel ''\nset key at screen 0.5, screen 0.02 center "
      "bottom maxrows 4 samplen 2 width 1 font ',11'\n";
  return gnuplot_svg(script + "plot " + plot[1] + "\nunset multiplot\n", 1000, 520);
}

std::string maps_csv(const std::vector<TableMap>& maps) {
  std::string csv = "family,theta_deg,alpha,error,surface\n";
  for (const TableMap& map : maps)
    for (const WorstOfSurfaces& one : map.cells)
      csv += fmt::format("{},{:.5f},{:.5g},{:.1e},\"{}\"\n", map.table->family().name, one.place.theta_deg(),
                         one.place.alpha, shown(one.error), common_surfaces()[one.surface].name);
  return csv;
}

using EdgesOf = std::vector<std::vector<TableEdge>>;

std::string edges_csv(const std::vector<TableMap>& maps, const EdgesOf& edges) {
  std::string csv = "family,edge,largest_error\n";
  for (std::size_t f = 0; f < maps.size(); ++f)
    for (const TableEdge& one : edges[f])
      csv += fmt::format("{},{},{:.1e}\n", maps[f].table->family().name, one.name, shown(one.worst.error));
  return csv;
}

std::string beyond_csv(const std::vector<TableMap>& maps, const BeyondOf& beyond) {
  std::string csv = "family,alpha,largest_error\n";
  for (std::size_t f = 0; f < maps.size(); ++f)
    for (const BeyondBox& one : beyond[f])
      csv += fmt::format("{},{:.4g},{:.1e}\n", maps[f].table->family().name, one.alpha, shown(one.error));
  return csv;
}

std::string surfaces_csv(const std::vector<SurfaceBeyond>& surfaces) {
  std::string csv = "surface,node_error,error_were_a_table_used,error_as_given,stated,error_of_judge\n";
  for (const SurfaceBeyond& one : surfaces)
    csv += fmt::format("\"{}\",{:.1e},{:.1e},{:.1e},{:.1e},{:.1e}\n", one.name, shown(one.node_error),
                       shown(one.table_error), shown(one.library_error), one.stated, shown(one.judge_error));
  return csv;
}

/// Of a map and of its table's edges.
WorstOfSurfaces worst_of(const TableMap& map, const std::vector<TableEdge>& edges) {
  std::vector<WorstOfSurfaces> all = map.cells;
  for (const TableEdge& one : edges) all.push_back(one.worst);
  return *std::max_element(all.begin(), all.end(), [](auto& a, auto& b) { return a.error < b.error; });
}

std::string worst_table(const std::vector<TableMap>& maps, const EdgesOf& edges) {
  std::string text = "| family | largest error | θ, degrees | alpha | surface |\n|---|---|---|---|---|\n";
  for (std::size_t f = 0; f < maps.size(); ++f) {
    const WorstOfSurfaces worst = worst_of(maps[f], edges[f]);
    text += fmt::format("| {} | {:.1e} | {:.4f} | {:.3g} | {} |\n", maps[f].table->family().name, worst.error,
                        worst.place.theta_deg(), worst.place.alpha, common_surfaces()[worst.surface].name);
  }
  return text;
}

std::string edges_table(const std::vector<TableMap>& maps, const EdgesOf& edges) {
  std::string text = "| family |", line = "|---|";
  for (const TableEdge& one : edges.front()) text += fmt::format(" {} |", one.name), line += "---|";
  text += "\n" + line + "\n";
  for (std::size_t f = 0; f < maps.size(); ++f) {
    text += fmt::format("| {} |", maps[f].table->family().name);
    for (const TableEdge& one : edges[f]) text += fmt::format(" {:.1e} |", shown(one.worst.error));
    text += "\n";
  }
  return text;
}

std::string surfaces_table(const std::vector<SurfaceBeyond>& surfaces) {
  std::string text =
      "| surface | R at the nodes | a table is used | E, were it used | E as gonio gives it | stated | judge |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const SurfaceBeyond& one : surfaces) {
    const char* mark = one.library_error > one.stated ? "**" : "";
    text += fmt::format("| {} | {:.1e} | {} | {:.1e} | {}{:.1e}{} | {:.0e} | {:.1e} |\n", one.name,
                        shown(one.node_error), one.node_error <= kMostNodeError ? "yes" : "no", shown(one.table_error),
                        mark, shown(one.library_error), mark, one.stated, shown(one.judge_error));
  }
  return text;
}

struct Page {
  std::vector<TableMap> maps;
  EdgesOf edges;
  BeyondOf beyond;
  std::vector<SurfaceBeyond> surfaces;
};

std::string readme(const Page& page, const TableStabilityOptions& o, bool published) {
  std::string text =
      fmt::format(R"(# Where the tables of E err

The {} tables that come with gonio, at {} × {} places between those of their grids, against the measure of the lobe to 1e-7: the worst of
{} surfaces from white facets and water to silver and n 1.4, k 7.5. Tables promise {:g}. The band from grazing at narrow lobes to the
normal at wide ones is where a lobe meets the horizon; the line next to 45° has only families with V-cavities: their E has a kink there.

![maps](maps.svg)

The worst place of each map and of the edges below:

)",
                  page.maps.size(), o.map_columns, o.map_rows, common_surfaces().size(), EnergyTable::kError);
  text += worst_table(page.maps, page.edges);
  text += fmt::format(R"(
## Edges

Largest error of an incidence over all widths, and of a width over all incidences ({} places each). From cos θ 1e-6 on (89.99994°)
tables give their last column.

)",
                      o.edge_places);
  text += edges_table(page.maps, page.edges) + R"(
## Beyond the widths

Below alpha 0.01 and above the last alpha a table gives its first and last rows. The library never asks it there, but integrates: this
is why.

![beyond the widths](beyond.svg)

## Surfaces that twenty cosines do not hold

A table is refused where R differs from its polynomial by more than 2e-5. Errors: of R between the nodes; of E, were a table used
nevertheless; of E as gonio gives it (bold: beyond what it states), integrated at the columns of the grid where tables are refused.
Judge: the adaptive quadrature of E, which sees R, with the error it estimates.

)" + surfaces_table(page.surfaces);
  return text + (published ? "\n`gonio assess stability tables` also writes the maps as a table.\n"
                           : "\nmaps.csv: every place of the maps.\n");
}

std::vector<const EnergyTable*> tables_of(const TableStabilityOptions& options) {
  std::vector<const EnergyTable*> tables;
  for (const LobeFamily& family : lobe_families()) {
    const auto& asked = options.families;
    if (!asked.empty() && std::find(asked.begin(), asked.end(), family.name) == asked.end()) continue;
    tables.push_back(bundled_energy_table(family));
    if (!tables.back())
      throw input_error("no table of {} beside gonio; expected tables/{}.exr (gonio table make)", family.name,
                        family.name);
  }
  return tables;
}

}  // namespace

void write_table_stability(const std::filesystem::path& folder, const std::function<void(const std::string&)>& progress,
                           bool published, const TableStabilityOptions& options) {
  const std::vector<const EnergyTable*> tables = tables_of(options);
  make_folder(folder);
  Page page;
  for (const EnergyTable* table : tables) {
    progress(std::string(table->family().name));
    page.maps.push_back(table_map(*table, options.map_columns, options.map_rows));
    page.edges.push_back(table_edges(*table, options.edge_places));
    page.beyond.push_back(beyond_box(*table, options.widths, options.edge_places));
  }
  page.surfaces = surfaces_beyond(tables, options.surface_places_a_side);
  write_file(folder / "maps.svg", maps_chart(page.maps));
  write_file(folder / "beyond.svg", beyond_chart(page.maps, page.beyond));
  write_file(folder / "edges.csv", edges_csv(page.maps, page.edges));
  write_file(folder / "beyond.csv", beyond_csv(page.maps, page.beyond));
  write_file(folder / "surfaces.csv", surfaces_csv(page.surfaces));
  if (!published) write_file(folder / "maps.csv", maps_csv(page.maps));
  write_file(folder / "README.md", readme(page, options, published));
}

}  // namespace gonio
