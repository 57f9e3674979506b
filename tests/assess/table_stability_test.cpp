// What `gonio assess stability tables` says of the bundled tables, on fewer places; and that its page is written.
#include "assess/table_stability.h"

#include <unistd.h>

#include "base/files.h"
#include "catch.h"
#include "energy/energy_tables.h"

using namespace gonio;
namespace fs = std::filesystem;

TEST_CASE("Table stability: within the bound inside the box, far off beyond it", "[assess][tables]") {
  const EnergyTable* table = bundled_energy_table(lobe_family("ggx-smith-correlated"));
  REQUIRE(table);
  for (const WorstOfSurfaces& one : table_map(*table, 9, 7).cells) CHECK(one.error <= EnergyTable::kError);
  for (const TableEdge& one : table_edges(*table, 6)) {
    INFO(one.name);
    CHECK(one.worst.error <= EnergyTable::kError);
  }
  const std::vector<BeyondBox> beyond = beyond_box(*table, 2, 6);
  REQUIRE(beyond.size() == 4);
  CHECK(beyond[0].error > 0.01);  // alpha 0.001
  CHECK(beyond[1].error <= EnergyTable::kError);
  CHECK(beyond[2].error <= EnergyTable::kError);
  CHECK(beyond[3].error > 0.01);  // alpha 10
}

TEST_CASE("Table stability: what the nodes do not hold is refused, and would err", "[assess][tables]") {
  const EnergyTable* table = bundled_energy_table(lobe_family("beckmann-smith-correlated"));
  REQUIRE(table);
  for (const SurfaceBeyond& one : surfaces_beyond({table}, 3)) {
    INFO(one.name << ": nodes " << one.node_error << ", table " << one.table_error);
    if (one.node_error <= kMostNodeError) CHECK(one.table_error <= EnergyTable::kError);
    if (one.table_error > EnergyTable::kError) CHECK(one.node_error > kMostNodeError);
  }
}

TEST_CASE("Table stability: the page", "[assess][tables]") {
  const fs::path folder = fs::temp_directory_path() / ("gonio-table-stability-" + std::to_string(::getpid()));
  const TableStabilityOptions few{4, 3, 3, 2, 2, {"ggx-v-cavity", "cosine-power"}};
  write_table_stability(
      folder, [](const std::string&) {}, false, few);
  for (const char* file : {"maps.svg", "beyond.svg"})
    CHECK(read_file(folder / file).find("</svg>") != std::string::npos);
  CHECK(read_file(folder / "README.md").find("| cosine-power |") != std::string::npos);
  for (const char* file : {"maps.csv", "edges.csv", "beyond.csv", "surfaces.csv"})
    CHECK(fs::is_regular_file(folder / file));
  fs::remove_all(folder);
}
