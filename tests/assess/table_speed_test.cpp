// What `gonio assess speed tables` says of tables, on fewer places; and that its page is written.
#include "assess/table_speed.h"

#include <unistd.h>

#include "base/files.h"
#include "catch.h"
#include "energy/energy_tables.h"
#include "materials/surfaces.h"

using namespace gonio;
namespace fs = std::filesystem;

TEST_CASE("Table speed: between the same numbers cubics lose least; the bundled grid holds its bound",
          "[assess][tables]") {
  for (const char* name : {"beckmann-smith-correlated", "pseudo-realistic"}) {
    const EnergyTable* table = bundled_energy_table(lobe_family(name));
    REQUIRE(table);
    const JudgedPlaces judged(table->family(), 300);
    const auto rows = grid_rows(*table, judged);
    INFO(name << ": cubic " << rows[0].error.largest << ", linear " << rows[1].error.largest << ", Catmull-Rom "
              << rows[2].error.largest);
    CHECK(rows[0].error.largest <= EnergyTable::kError);
    CHECK(rows[1].error.largest > 5 * rows[0].error.largest);
    CHECK(rows[2].error.largest > 2 * rows[0].error.largest);
    for (const TableSpeedRow& other : other_table_rows(*table, judged))
      CHECK(other.error.largest == Approx(rows[0].error.largest).margin(2e-6));
    const std::size_t side = 16;
    for (const TableSpeedRow& even : renderer_rows(judged, {&side, 1}))
      CHECK(even.error.largest > 5 * white_row(*table, judged).error.largest);
  }
}

TEST_CASE("Table speed: quadratures are as good as asked, sampling is not", "[assess][tables]") {
  const JudgedPlaces judged(lobe_family("ggx-smith-correlated"), 8);
  for (const TableSpeedRow& one : quadrature_rows(judged, 8)) {
    INFO(one.way << " " << one.setting << ": " << one.error.largest);
    CHECK(one.error.largest <= std::stod(one.setting));
  }
  const auto samples = sampling_rows(judged, 2);
  CHECK(samples.back().error.largest < 0.02);
  CHECK(samples.back().ns > 100 * samples.front().ns);
}

TEST_CASE("Table speed: twenty cosines counted here are the library's", "[assess][tables]") {
  std::vector<Interface<double>> surfaces;
  std::size_t beyond = 0;
  const Lobe<double> lobe = lobe_families().front().lobe(0.5);
  for (const NamedSurface& one : database_surfaces(200)) {
    surfaces.push_back(one.interface);
    beyond += node_error(lobe, one.interface, reflectance_at_nodes(lobe, one.interface)) > kMostNodeError;
  }
  const NodeCountRow twenty = node_count_row(kCosNodes, surfaces), twelve = node_count_row(12, surfaces);
  CHECK(twenty.beyond == beyond);
  CHECK(twelve.median > 100 * twenty.median);
}

TEST_CASE("Table speed: the page", "[assess][tables]") {
  const fs::path folder = fs::temp_directory_path() / ("gonio-table-speed-" + std::to_string(::getpid()));
  TableSpeedOptions few;
  few.families = {"ggx-v-cavity"}, few.grids = {{8, 10}, {12, 16}}, few.renderer_sides = {6};
  few.places = 20, few.integrated = 4, few.sampled = 1, few.database_step_nm = 400;
  write_table_speed(
      folder, [](const std::string&) {}, few);
  for (const char* file : {"time.svg", "size.svg", "white.svg"})
    CHECK(read_file(folder / file).find("</svg>") != std::string::npos);
  CHECK(read_file(folder / "README.md").find("| table, cubic | 12 x 16 |") != std::string::npos);
  for (const char* file : {"ways.csv", "white.csv", "cosines.csv"}) CHECK(fs::is_regular_file(folder / file));
  fs::remove_all(folder);
}
