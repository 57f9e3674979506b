// The maps tell what published forms lose, and that ours do not: at places whose failure is known beforehand.
#include "assess/brdf_stability.h"

#include "assess/brdf_published.h"
#include "brdf/classical.h"
#include "catch.h"
#include "cli/command.h"

using namespace gonio;

namespace {

const StabilitySweep& sweep(std::string_view name) {
  for (const StabilitySweep& one : stability_sweeps())
    if (one.name == name) return one;
  throw std::runtime_error("no such sweep");
}

}  // namespace

TEST_CASE("Stability: ours hold on every map; the published forms fail on all but one", "[assess]") {
  for (const StabilitySweep& one : stability_sweeps()) {
    const StabilityMap map = stability_map(one, 9, 8);
    std::array<int, 4> failing{};
    for (const StabilityCell& cell : map.cells)
      for (std::size_t panel = 0; panel < 4; ++panel) failing[panel] += fails(one, cell, panel);
    INFO(one.name << ": " << failing[0] << " " << failing[1] << " " << failing[2] << " " << failing[3]);
    CHECK(failing[1] == 0);
    CHECK(failing[3] == 0);
    if (one.name != "absorption") CHECK(failing[0] > 0);
  }
}

TEST_CASE("Stability: the traps show as what they are", "[assess]") {
  // He: no number with the eye at the exact normal. Ten terms: nothing left of the lobe at g = 1e6. acos at alpha =
  // 1e-4: tens of per cent in float.
  const StabilityMap he = stability_map(sweep("he"), 2, 2), ten = stability_map(sweep("series-10"), 2, 2),
                     rough = stability_map(sweep("roughness"), 2, 3);
  CHECK(std::isinf(he.cells[2].error[2]));
  CHECK(ten.cells[1].error[2] == Approx(1));
  CHECK(rough.cells[4].error[0] > 0.1);
}

TEST_CASE("Published forms are those of the books where nothing is lost: they agree with ours", "[assess]") {
  const UnitVector<double> i = normalised(0.3, -0.2, 0.8), o = normalised(-0.4, 0.1, 0.7);
  const auto w = reduce(i.x, i.y, i.z, o.x, o.y, o.z);
  const Interface<double> gold{0.96, 6.7};
  const double f = TorranceSparrow<double>{0.4, Shadowing::smith_separable}.shape(w) * gold.reflectance(w.cos_d);
  CHECK(published::torrance_sparrow(0.4, i, o, gold.n, gold.k) == Approx(f).epsilon(1e-12));
  CHECK(published::kirchhoff(0.05, 1.0, 0.55, i, o, 40) ==
        Approx((BeckmannKirchhoff<double>{0.05, 1.0}.shape(w, 0.55))).epsilon(1e-11));
  CHECK(published::he(0.05, 1.0, 0.55, i, o, 40) ==
        Approx((HeTorrance<double>{0.05, 1.0}.shape(w, 0.55))).epsilon(1e-11));
  CHECK(published::anisotropic_beckmann(0.3, 0.5, i, o) ==
        Approx((AnisotropicBeckmann<double>{0.3, 0.5, Shadowing::none}.shape(w))).epsilon(1e-12));
}

TEST_CASE("Stability: the line beside a worst point evaluates it again", "[assess][cli]") {
  ErrorOptions options;
  options.points.sets = 4, options.measure.worst = 1;
  options.wanted = [](const ModelSpec& spec) { return spec.id == ModelId::ggx || spec.id == ModelId::sgd_2012; };
  for (const CaseError& found : brdf_errors(options)) {
    const bool single = found.path == "float lanes";
    if (found.path == "double lanes") continue;
    const PointError& worst = found.worst.front();
    const std::string line = eval_line(found.spec, worst.point, single ? "float" : "double");
    // printf 'ROWS' | gonio ARGUMENTS
    const std::size_t from = line.find('\'') + 1, to = line.find('\'', from), start = line.find("gonio ") + 6;
    std::string rows = line.substr(from, to - from);
    for (std::size_t at; (at = rows.find("\\n")) != std::string::npos;) rows.replace(at, 2, "\n");
    std::vector<std::string> arguments;
    for (std::size_t at = start; at < line.size();) {
      const std::size_t end = std::min(line.find(' ', at), line.size());
      arguments.push_back(line.substr(at, end - at));
      at = end + 1;
    }
    const test::Outcome outcome = test::run_gonio(arguments, rows);
    INFO(line << "\n" << outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(std::stod(outcome.out.substr(outcome.out.rfind(',') + 1)) == Approx(worst.f).epsilon(single ? 1e-6 : 1e-14));
  }
}

TEST_CASE("gonio eval takes unit vectors, and refuses what is none", "[cli]") {
  const std::vector<std::string> arguments{"eval", "ggx", "--set", "alpha_x=0.2", "--set", "alpha_y=0.1"};
  const auto value = [](const test::Outcome& outcome) {
    return std::stod(outcome.out.substr(outcome.out.rfind(',') + 1));
  };
  const test::Outcome vectors = test::run_gonio(arguments, "ix,iy,iz,ox,oy,oz\n0.6,0,0.8,-0.8,0,0.6\n");
  const test::Outcome angles =
      test::run_gonio(arguments, "theta_i_deg,theta_o_deg,phi_deg\n36.86989764584402,53.13010235415598,180\n");
  REQUIRE(vectors.status == 0);
  CHECK(value(vectors) == Approx(value(angles)).epsilon(1e-12));
  for (const char* rows :
       {"ix,iy,iz,ox,oy,oz\n0.6,0,0.9,0,0,1\n", "ix,iy,iz,ox,oy,oz\n0.6,0,-0.8,0,0,1\n", "ix,iy,iz,ox,oy\n0,0,1,0,0\n",
        "ix,iy,iz,ox,oy,oz\n", "ix,iy,iz,ox,oy,oz\nnan,0,1,0,0,1\n"}) {
    const test::Outcome refused = test::run_gonio(arguments, rows);
    INFO(rows << refused.err);
    CHECK(refused.status == 2);
    CHECK(refused.out.empty());
  }
}
