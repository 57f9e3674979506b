// A table of E on disk: back bit for bit, and refused when it is not what it says.
#include "energy/energy_file.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "catch.h"
#include "cli/json_of.h"
#include "energy/energy_tables.h"

using namespace gonio;
using namespace gonio::test;

namespace {

std::string refusal(const std::filesystem::path& path) {
  try {
    read_energy_table(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a table of E comes back bit for bit; a changed one is refused by name", "[energy][tables]") {
  const Scratch scratch;
  const LobeFamily& family = lobe_family("beckmann-v-cavity");
  const EnergyTable table(family, {.rows = 6, .columns = 6, .widest = family.widest});
  const std::string path = scratch.path("E.exr");
  write_energy_table(table, path);
  const EnergyTable back = read_energy_table(path);
  CHECK(&back.family() == &family);
  for (std::size_t cell = 0; cell < table.cells().size(); ++cell) {
    CHECK(back.cells()[cell].weight == table.cells()[cell].weight);
    CHECK(back.cells()[cell].error == table.cells()[cell].error);
  }
  CHECK_NOTHROW(check_is_current(back));
  CHECK(read_file(scratch.path("E.csv")).starts_with("theta_deg,alpha,E,error\n"));

  const std::string bytes = read_file(path);
  std::string other = bytes;
  const std::size_t name = other.find(family.name);
  other.replace(name, family.name.size(), "beckmann-v-kavity");
  scratch.file("other.exr", other);
  CHECK(refusal(scratch.path("other.exr")).find("other.exr: ") != std::string::npos);
  scratch.file("cut.exr", bytes.substr(0, bytes.size() / 2));
  CHECK(refusal(scratch.path("cut.exr")).find("OpenEXR") != std::string::npos);
  scratch.file("text.exr", "no image");
  CHECK(refusal(scratch.path("text.exr")).find("OpenEXR") != std::string::npos);
  CHECK(refusal(scratch.path("missing.exr")).find("cannot be read") != std::string::npos);

  // A small file that claims a long attribute is refused before anybody makes room for it.
  std::string claims = bytes;
  claims[claims.find("checksum") + 8 + 1 + 6 + 1 + 3] = '\x7f';
  scratch.file("claims.exr", claims);
  CHECK(refusal(scratch.path("claims.exr")).find("no whole OpenEXR file") != std::string::npos);

  // Another checksum than its numbers'.
  std::string forged = bytes;
  char& digit = forged[forged.find("checksum") + 8 + 1 + 6 + 1 + 4];  // name, type, size
  digit = digit == '0' ? '1' : '0';
  scratch.file("forged.exr", forged);
  CHECK(refusal(scratch.path("forged.exr")).find("checksum") != std::string::npos);

  // Whole, but made of another lobe: stale.
  std::vector<EnergyTable::Cell> cells(table.cells().begin(), table.cells().end());
  for (EnergyTable::Cell& cell : cells) cell.weight[0] += 0.001F;
  const EnergyTable stale(family, table.grid(), cells);
  write_energy_table(stale, scratch.path("stale.exr"));
  CHECK_THROWS_WITH(check_is_current(read_energy_table(scratch.path("stale.exr"))),
                    Catch::Contains("beckmann-v-cavity: a stale table"));
}

TEST_CASE("table writes a table, lookup finds E in it and in the bundled ones", "[cli][tables][slow]") {
  const Scratch scratch;
  const std::string path = scratch.path("E.exr");
  CHECK(run_gonio({"table", "torrance-sparrow", "--set", "shadowing=v-cavity", "--out", path}).status == 0);
  const auto limits = json_of({"table", "limits", "torrance-sparrow", "--set", "m=0.3", "--set", "shadowing=v-cavity",
                               "--n", "1.5", "--angles", "0,60"});
  for (const auto& json : {json_of({"table", "lookup", path, "--set", "m=0.3", "--n", "1.5", "--angles", "0,60"}),
                           json_of({"table", "lookup", "torrance-sparrow", "--set", "m=0.3", "--set",
                                    "shadowing=v-cavity", "--n", "1.5", "--angles", "0,60"})})
    for (int i = 0; i < 2; ++i)
      CHECK(json["E"][i]["E"].get<double>() == Approx(limits["E"][i]["E"].get<double>()).margin(1e-4));
  check_refused(scratch, {"table", "lookup", "ward-1992", "--set", "alpha=0.2", "--angles", "89"}, "without bound");
  CHECK(json_of({"table", "lookup", "ward-1992", "--set", "alpha=0.2", "--angles", "60"})["E_mean"].is_null());
  check_refused(scratch, {"table", "limits", "ward-1992", "--set", "alpha=0.2", "--spectrum"}, "without bound");
  check_refused(scratch, {"table", "lookup", path, "--n", "1.5"}, "width is not given");
  check_refused(scratch, {"table", "lookup", path, "--set", "m=3", "--n", "1.5"}, "outside the table");
  check_refused(scratch, {"table", "ward-1992", "--out", scratch.path("W.exr")}, "has no table");
  check_refused(scratch, {"table", "torrance-sparrow"}, "--out");
  const auto check = json_of({"table", "check", path, "--denser", "1", "--random", "20"});
  CHECK(check["random"]["error"].get<double>() <= 1e-4);
}
