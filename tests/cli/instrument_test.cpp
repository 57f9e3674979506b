// gonio table instrument: what an instrument reports.
#include <nlohmann/json.hpp>

#include "catch.h"
#include "cli/json_of.h"

using namespace gonio::test;
using Json = nlohmann::ordered_json;

namespace {

std::vector<std::string> instrument(std::vector<std::string> model, std::vector<std::string> more) {
  std::vector<std::string> all{"table", "instrument"};
  all.insert(all.end(), model.begin(), model.end());
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

TEST_CASE("table instrument: geometries by name and by number", "[cli][instrument]") {
  const std::vector<std::string> polished{"he-1991",    "--set", "sigma0_um=0.02", "--set", "correlation_um=3",
                                          "--material", "Al",    "--at",           "633"};
  const Json included = json_of(instrument(polished, {"--geometry", "8:di"})),
             excluded = json_of(instrument(polished, {"--geometry", "8:de"}));
  CHECK(included["kind"] == "directional-hemispherical");
  CHECK(included["coherent_reflectance_factor"].get<double>() > 0.7);
  CHECK(excluded["coherent_reflectance_factor"] == 0.0);
  CHECK(excluded["collector"]["stop"]["half_angle_deg"] == 4.0);
  CHECK(excluded["collector"]["stop"]["phi_deg"] == 180.0);
  CHECK(excluded["reflectance"].get<double>() < included["reflectance"].get<double>());
  // The same by numbers, and as table scatter says it.
  const Json numbers =
      json_of(instrument(polished, {"--theta-i", "8", "--axis", "normal", "--half-angle", "90", "--stop", "4"}));
  CHECK(numbers["reflectance"] == excluded["reflectance"]);
  CHECK(numbers["geometry"].is_null());
  const Json scatter =
      json_of({"table", "scatter", "he-1991", "--set", "sigma0_um=0.02", "--set", "correlation_um=3", "--material",
               "Al", "--at", "633", "--theta-i", "8", "--axis", "normal", "--stop", "4"});
  CHECK(scatter["reflectance"].get<double>() == Approx(excluded["reflectance"].get<double>()).epsilon(2e-6));
  const Json back = json_of(instrument(polished, {"--geometry", "de:8"}));
  CHECK(back["reflectance"].is_null());
  CHECK(back["reflectance_factor"].get<double>() ==
        Approx(excluded["reflectance_factor"].get<double>()).epsilon(2e-6));  // reciprocity

  const std::vector<std::string> white{"lambert", "--set", "kd=0.8"};
  const Json cones = json_of(
      instrument(white, {"--geometry", "45:0", "--source-half-angle", "2", "--half-angle", "5", "--phi-i", "20"}));
  CHECK(cones["reflectance_factor"].get<double>() == Approx(0.8).epsilon(1e-9));
  CHECK(cones["source"]["phi_deg"] == 20.0);
  const double sine = std::sin(5 * std::acos(-1.0) / 180);
  CHECK(cones["reflectance"].get<double>() == Approx(0.8 * sine * sine).epsilon(1e-9));
}

TEST_CASE("table instrument refuses what is no geometry, and says what it understood", "[cli][instrument]") {
  const Scratch scratch;
  const std::vector<std::string> ggx{"ggx", "--set", "alpha=0.1"};
  check_refused(scratch, instrument(ggx, {"--geometry", "8:sphere"}), "side \"sphere\"");
  check_refused(scratch, instrument(ggx, {"--geometry", "8:di", "--half-angle", "5"}), "aperture already");
  check_refused(scratch, instrument(ggx, {"--geometry", "8:di", "--stop", "5"}), "--stop");
  check_refused(scratch, instrument(ggx, {"--geometry", "8:di", "--theta-i", "5"}), "--theta-i");
  check_refused(scratch, instrument(ggx, {"--axis", "up"}), "--axis");
  check_refused(scratch, instrument(ggx, {"--theta-i", "90"}), "89.99");
  check_refused(scratch, instrument({"mirror"}, {"--geometry", "20:20"}), "infinite");
  const Outcome text = run_gonio(instrument(ggx, {"--geometry", "8:de", "--stop", "3"}));
  CHECK(text.status == 0);
  CHECK(text.out.find("the hemisphere, less 3 degrees about (8, 180)") != std::string::npos);
  CHECK(text.out.find("reflectance factor") != std::string::npos);
}
