#pragma once
// Tables of directional reflectance: what a value costs and how wrong it is, on several grids and by several interpolations, beside the
// quadratures, sampling and the tables of renderers.
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "assess/table_truth.h"
#include "energy/energy_table.h"

namespace gonio {

/// Places with the truth of every common surface.
struct JudgedPlaces {
  const LobeFamily* family;
  std::vector<TablePlace> places;
  std::vector<std::vector<double>> e;  ///< [place][surface]

  JudgedPlaces(const LobeFamily& of, std::size_t count);
};

/// One way to E of one surface. Error: of a place, the worst of the common surfaces.
struct TableSpeedRow {
  std::string family, way, setting;
  double kib = 0;  ///< of the numbers it keeps for one surface (a table of every material: for all)
  double ns = 0;   ///< a value, of one surface, one thread
  ErrorSpread error{};
  TablePlace worst{1, 1};
};

/// Lookups on one grid: Lagrange's cubic (the library's), linear and Catmull-Rom between the same numbers.
std::vector<TableSpeedRow> grid_rows(const EnergyTable& table, const JudgedPlaces& judged);
/// A table of one width, and the table of every material asked value by value.
std::vector<TableSpeedRow> other_table_rows(const EnergyTable& table, const JudgedPlaces& judged);

/// Adaptive quadrature of E and of the lobe's measure at tolerances 1e-3 to 1e-6, at the first `count` places.
std::vector<TableSpeedRow> quadrature_rows(const JudgedPlaces& judged, std::size_t count);
/// Means of f·cos/pdf over 1e2 to 1e5 directions that the BRDF's sampler draws, several seeds, the surfaces in turn.
std::vector<TableSpeedRow> sampling_rows(const JudgedPlaces& judged, std::size_t count);

/// White facets, alpha up to 1: tables as renderers make them, even in cos θ and in alpha or its root, bilinear.
std::vector<TableSpeedRow> renderer_rows(const JudgedPlaces& judged, std::span<const std::size_t> sides);
/// This project's for the same places and facets.
TableSpeedRow white_row(const EnergyTable& table, const JudgedPlaces& judged);

/// How many fixed cosines hold R of the database's solids and liquids.
struct NodeCountRow {
  std::size_t nodes, surfaces = 0, beyond = 0;  ///< beyond kMostNodeError
  double kib = 0;                               ///< of a table of every material on the default grid
  double largest = 0, median = 0, p99 = 0;      ///< of the surfaces' largest errors of R
};
NodeCountRow node_count_row(std::size_t nodes, std::span<const Interface<double>> surfaces);

struct TableSpeedOptions {
  std::vector<std::string_view> families{"beckmann-smith-correlated", "ggx-smith-correlated", "pseudo-realistic"};
  std::vector<EnergyGrid> grids{{24, 28}, {32, 36}, {44, 52}, {60, 68}, {88, 100}};  ///< `widest` is the family's
  std::vector<std::size_t> renderer_sides{16, 32};
  std::size_t places = 4000, integrated = 200, sampled = 24;
  double database_step_nm = 20;
};

/// The page: README.md, CSV tables, SVG charts.
void write_table_speed(const std::filesystem::path& folder, const std::function<void(const std::string&)>& progress,
                       const TableSpeedOptions& options = {});

}  // namespace gonio
