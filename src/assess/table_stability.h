#pragma once
// Where the bundled tables of directional reflectance err: maps between the grid's places, edges, and what would happen beyond what they hold.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "assess/table_truth.h"
#include "energy/energy_table.h"

namespace gonio {

/// A place and the error there, the worst of the common surfaces.
struct WorstOfSurfaces {
  TablePlace place{1, 1};
  double error = 0;
  std::size_t surface = 0;
};

/// Errors row by row: alpha upwards, from grazing to the normal; cells even in the grid's own coordinates.
struct TableMap {
  const EnergyTable* table;
  std::size_t columns, rows;
  std::vector<WorstOfSurfaces> cells;
};
TableMap table_map(const EnergyTable& table, std::size_t columns, std::size_t rows);

/// Largest errors along a line of the box: of an incidence over all widths, or of a width over all incidences.
struct TableEdge {
  std::string name;
  WorstOfSurfaces worst;
};
std::vector<TableEdge> table_edges(const EnergyTable& table, std::size_t places);

/// Beyond the box, where a table gives its first or last row: largest error over the incidence. The library integrates there.
struct BeyondBox {
  double alpha, error;
};
std::vector<BeyondBox> beyond_box(const EnergyTable& table, std::size_t widths, std::size_t incidences);

/// A surface that the fixed cosines may not hold: largest errors against the adaptive quadrature of E, which sees R.
struct SurfaceBeyond {
  std::string name;
  double node_error;         ///< of R
  double table_error = 0;    ///< of E, were a table used
  double library_error = 0;  ///< of E as LobeEnergy gives it: by tables, or integrated where they are refused
  double stated = 0;         ///< LobeEnergy::error()
  double judge_error = 0;    ///< estimated, of the quadrature that judges
};
std::vector<SurfaceBeyond> surfaces_beyond(const std::vector<const EnergyTable*>& tables, std::size_t places_a_side);

struct TableStabilityOptions {
  std::size_t map_columns = 96, map_rows = 36, edge_places = 32, widths = 9, surface_places_a_side = 12;
  std::vector<std::string_view> families{};  ///< all where empty
};

/// The page: README.md, SVG maps, edges.csv, beyond.csv, surfaces.csv; maps.csv too unless `published`. InputError where gonio has no tables.
void write_table_stability(const std::filesystem::path& folder, const std::function<void(const std::string&)>& progress,
                           bool published = false, const TableStabilityOptions& options = {});

}  // namespace gonio
