// A table of nodes on disk: back bit for bit, and refused when it is not what it says.
#include "energy/node_file.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "catch.h"
#include "cli/json_of.h"

using namespace gonio;
using namespace gonio::test;

namespace {

std::string refusal(const std::filesystem::path& path) {
  try {
    read_node_table(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a table of nodes comes back bit for bit; a changed one is refused by name", "[energy][nodes]") {
  const Scratch scratch;
  ModelSpec spec;
  spec.id = ModelId::torrance_sparrow;
  set_shadowing(spec, "v-cavity");
  const NodeTable table(spec, {8, 8});
  const std::string path = scratch.path("N.exr");
  write_node_table(table, path);
  const NodeTable back = read_node_table(path);
  CHECK(back.spec().shadowing == Shadowing::v_cavity);
  for (std::size_t cell = 0; cell < table.cells(); ++cell) CHECK(back.numbers(cell) == table.numbers(cell));
  CHECK(read_file(scratch.path("N.csv")).starts_with("theta_deg,m,E\n"));

  const std::string bytes = read_file(path);
  std::string other = bytes;
  other.replace(other.find("v-cavity"), 8, "smithnon");
  scratch.file("other.exr", other);
  CHECK(refusal(scratch.path("other.exr")).find("other.exr: ") != std::string::npos);
  scratch.file("cut.exr", bytes.substr(0, bytes.size() / 2));
  CHECK(refusal(scratch.path("cut.exr")).find("OpenEXR") != std::string::npos);
  scratch.file("text.exr", "no image");
  CHECK(refusal(scratch.path("text.exr")).find("OpenEXR") != std::string::npos);
  CHECK(refusal(scratch.path("missing.exr")).find("cannot be read") != std::string::npos);

  // Other numbers under the same checksum.
  NodeTable changed(spec, {8, 8}, std::vector<NodeTable::Numbers>(64));
  write_node_table(changed, scratch.path("zero.exr"));
  std::string forged = read_file(scratch.path("zero.exr"));
  const auto sum_of = [](const std::string& file) {
    return file.find("checksum") + 8 + 1 + 6 + 1 + 4;
  };  // name, type, size
  forged.replace(sum_of(forged), 16, bytes.substr(sum_of(bytes), 16));
  scratch.file("forged.exr", forged);
  CHECK(refusal(scratch.path("forged.exr")).find("checksum") != std::string::npos);
}

TEST_CASE("table nodes writes a table and looks E up in it", "[cli][nodes]") {
  const Scratch scratch;
  const std::string path = scratch.path("N.exr");
  CHECK(run_gonio({"table", "nodes", "torrance-sparrow", "--out", path}).status == 0);
  const auto json = json_of({"table", "nodes", path, "--set", "m=0.3", "--n", "1.5", "--angles", "0,60"});
  const auto limits =
      json_of({"table", "limits", "torrance-sparrow", "--set", "m=0.3", "--n", "1.5", "--angles", "0,60"});
  for (int i = 0; i < 2; ++i)
    CHECK(json["E"][i]["E"].get<double>() == Approx(limits["E"][i]["E"].get<double>()).margin(1e-4));
  check_refused(scratch, {"table", "nodes", path, "--n", "1.5"}, "m is not given");
  check_refused(scratch, {"table", "nodes", path, "--set", "m=3", "--n", "1.5"}, "outside the table");
  check_refused(scratch, {"table", "nodes", "ggx", "--out", scratch.path("G.exr")}, "Gaussian slopes");
  check_refused(scratch, {"table", "nodes", "torrance-sparrow"}, "--out");
}
